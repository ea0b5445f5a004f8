"""The page in a real browser, from disk: Debian's chromium, without a display or a graphics card."""

import json
import os
import re
import shutil
import struct
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.inference.low_rank import read_low_rank_arm
from myograph.inference.shipped import models_folder
from myograph.view.page import PageArm, filled_page, page_content, read_arm_models
from tests.export.test_gltf import VALIDATE
from tests.view.page.arm import APART, make_arm, whole_content
from tests.view.page.opening import opened

FRAME_MS, OPEN_MS = 16, 2000
RELATIVE = 1e-4
ARM = "myograph.page.arm"


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    return make_arm(tmp_path_factory.mktemp("arm") / "arm")


@pytest.fixture(scope="module")
def address(models, template, tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    path = folder / "page.html"
    path.write_text(filled_page(template, whole_content(models, folder)), encoding="utf-8")
    return path.as_uri()


@pytest.fixture(scope="module")
def shipped(template, tmp_path_factory):
    """The page of the arm that comes with the package."""
    folder = models_folder() / "arm"
    if not folder.is_dir():
        pytest.skip("this installation has no arm of its own")
    content = page_content(PageArm(read_arm_models(folder, built_in_arm())))
    path = tmp_path_factory.mktemp("shipped") / "page.html"
    path.write_text(filled_page(template, content), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def page(browser, address):
    return opened(browser, address)


@pytest.fixture(autouse=True)
def at_rest(request):
    if "page" in request.fixturenames:
        page = request.getfixturevalue("page")
        page.evaluate("myograph.page.set([0, 0, 0, 0, 0], 0), myograph.page.show('muscle'), myograph.page.pick(null)")


def picture(page):
    """The arm as drawn; two frames later, for it is drawn when the browser has time."""
    page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return page.locator("#view").screenshot()


def test_it_opens_from_disk_without_a_word_or_a_request(page):
    asked = [word for word in page.said if not word.startswith("data:")]
    assert asked == []
    assert page.title() == "left arm"


def check_numbers(page, muscles, activation, load):
    """All that the page shows of these muscles is what Python says."""
    page.evaluate("([a, n]) => myograph.page.set(a, n)", [activation.tolist(), load])
    offered = page.evaluate(f"{ARM}.data.fields.map(field => field.key)")
    ask = f"""keys => {ARM}.drawn.map(({{ muscle }}) => ({{ position: Array.from(muscle.position),
        ...Object.fromEntries(keys.map(key => [key, Array.from(muscle.values(key, null))])) }}))"""
    keys = [key for key in offered if key not in ("muscle", "error", "stress_error")]
    for muscle, found in zip(muscles.values(), page.evaluate(ask, keys), strict=True):
        wanted = python_says(muscle, activation, load)
        skin = np.unique(muscle.skin)
        for key in ("position", *keys):
            mine, theirs = wanted[key][skin].ravel(), found[key][: wanted[key][skin].size]
            np.testing.assert_allclose(theirs, mine, atol=RELATIVE * np.abs(mine).max(), rtol=0, err_msg=key)
    angle = np.degrees(muscles["biceps"].elbow_angle(activation, load))
    assert page.evaluate(f"{ARM}.angleDegrees") == pytest.approx(angle, rel=RELATIVE)


def python_says(muscle, activation, load):
    place, factor = muscle.place(activation, load), muscle.half_width_90
    fields, deviations = muscle.at_place(place), muscle.deviations(place)
    return {
        **fields,
        "displacement": np.linalg.norm(fields["position"] - muscle.at(np.zeros(5))["position"], axis=1),
        "deviation": factor.get("position", 1) * deviations["position"],
        "stress_deviation": factor.get("von_mises", 1) * deviations["von_mises"],
    }


@pytest.mark.parametrize("number", range(20))
def test_its_numbers_are_those_of_python(page, models, number):
    generator = np.random.default_rng(number)
    check_numbers(page, models.muscles, generator.random(5), float(generator.uniform(0, 20)))


def test_a_slider_moved_by_the_keyboard_changes_the_picture(page):
    before = picture(page)
    slider = page.get_by_role("slider", name="biceps")
    slider.focus()
    page.keyboard.press("End")
    assert page.evaluate(f"{ARM}.activation[2]") == 1
    assert picture(page) != before


def test_another_colour_changes_picture_and_legend(page):
    before = picture(page)
    page.get_by_label("colour").select_option("von_mises")
    assert picture(page) != before
    assert "von Mises stress [MPa]" in page.locator("#legend").inner_text()


def test_keys_turn_the_view(page):
    def place():
        return page.evaluate("myograph.page.view.camera.position.toArray()")

    before, drawn = place(), picture(page)
    page.locator("#view").focus()
    page.keyboard.press("ArrowLeft")
    turned = place()
    assert np.linalg.norm(turned) == pytest.approx(np.linalg.norm(before), rel=0.2)
    assert np.abs(np.subtract(turned, before)).max() > 50
    assert picture(page) != drawn
    page.keyboard.press("+")
    assert np.abs(np.subtract(place(), turned)).max() > 50
    page.keyboard.press("0")
    np.testing.assert_allclose(place(), before, atol=1e-6)


def test_the_badge_tells_what_is_outside_of_training(page):
    badge = page.locator("#badge")
    assert not badge.is_visible()
    page.get_by_role("slider", name="triceps").fill("0.8")
    assert "triceps 0.80 (trained 0.00 to 0.50)" in badge.inner_text()
    page.get_by_role("button", name="relaxed").click()
    assert not badge.is_visible()
    page.get_by_role("slider", name="load").fill("25")
    assert "load 25.0 N (trained 0.0 to 20.0 N)" in badge.inner_text()


def test_a_case_of_the_truth_shows_its_ghost_and_the_error(page):
    page.get_by_label("colour").select_option("error")
    assert "known at the cases of the truth only" in page.locator("#legend").inner_text()
    without = picture(page)
    page.get_by_label("case of the truth").select_option(index=2)
    assert "truth 71.6°" in page.locator(".angle").inner_text()
    errors = page.evaluate(f"Array.from({ARM}.drawn[2].muscle.values('error', {ARM}.truth))")
    np.testing.assert_allclose(errors, APART, atol=1e-3)
    with_ghost = picture(page)
    assert with_ghost != without
    page.get_by_label("ghost of the truth").uncheck()
    assert picture(page) != with_ghost
    page.get_by_label("ghost of the truth").check()
    page.get_by_role("slider", name="biceps").fill("0.5")
    assert page.get_by_label("case of the truth").input_value() == ""


def test_a_click_tells_the_values_of_a_node(page):
    place = page.evaluate(
        """() => { const box = document.getElementById('view').getBoundingClientRect();
        for (let y = 0.1; y < 0.9; y += 0.02) for (let x = 0.1; x < 0.9; x += 0.02) {
            const at = [box.left + x * box.width, box.top + y * box.height];
            if (myograph.page.view.pick(...at)) return at; } }"""
    )
    page.mouse.click(*place)
    text = page.locator("#picked").inner_text()
    assert re.search(r"node \d+", text)
    assert "von Mises stress" in text
    page.locator("#picked").get_by_role("button", name="close").click()
    assert not page.locator("#picked").is_visible()


def test_a_movement_plays_and_stops_at_a_touch_of_a_slider(page):
    page.get_by_role("button", name="play").click()
    time.sleep(0.4)
    assert 0 < page.evaluate(f"{ARM}.activation[0]") <= 1
    page.get_by_role("slider", name="biceps").fill("0.25")
    stopped = page.evaluate(f"{ARM}.activation")
    time.sleep(0.2)
    assert page.evaluate(f"{ARM}.activation") == stopped
    page.get_by_label("time of the movement").fill("1")
    assert page.evaluate(f"{ARM}.activation") == pytest.approx([1] * 5, abs=2e-3)


def test_the_shown_state_is_saved_for_other_programs(page):
    triangles = page.evaluate(f"{ARM}.drawn.reduce((sum, d) => sum + d.surface.triangles.length / 3, 0)")
    with page.expect_download() as told:
        page.get_by_role("button", name="STL").click()
    solid = told.value.path().read_bytes()
    assert struct.unpack_from("<I", solid, 80)[0] == triangles == (len(solid) - 84) / 50
    with page.expect_download() as told:
        page.get_by_role("button", name="glTF").click()
    scene = told.value.path().read_bytes()
    assert scene[:4] == b"glTF"
    assert struct.unpack_from("<II", scene, 4) == (2, len(scene))


def test_the_khronos_validator_finds_nothing_in_what_is_saved(page):
    folder = os.environ.get("MYOGRAPH_GLTF_VALIDATOR", str(Path(__file__).parents[3] / "web" / "node_modules"))
    if shutil.which("node") is None or not (Path(folder) / "gltf-validator").is_dir():
        pytest.skip("no gltf-validator here: npm install gltf-validator, and MYOGRAPH_GLTF_VALIDATOR=.../node_modules")
    page.evaluate("myograph.page.set([0.2, 0.9, 0.7, 0.1, 0.3], 2), myograph.page.show('von_mises')")
    with page.expect_download() as told:
        page.get_by_role("button", name="glTF").click()
    command = ["node", "-e", VALIDATE, str(told.value.path())]
    done = subprocess.run(command, env={**os.environ, "NODE_PATH": folder}, capture_output=True, text=True, check=True)
    report = json.loads(done.stdout)
    found = {kind: report["issues"][f"num{kind}"] for kind in ("Errors", "Warnings", "Infos", "Hints")}
    assert found == dict.fromkeys(found, 0), report["issues"]["messages"]
    assert report["info"]["totalVertexCount"] == page.evaluate(
        f"{ARM}.drawn.reduce((n, d) => n + d.surface.vertices, 0)"
    )


def test_light_and_dark(page):
    def paper():
        return page.evaluate("getComputedStyle(document.body).backgroundColor")

    light = paper()
    page.get_by_role("button", name="◐").click()
    assert paper() != light
    page.get_by_role("button", name="◐").click()
    assert paper() == light


def test_a_phone_shows_all_of_it_and_understands_touch(browser, address):
    page = opened(browser, address, has_touch=True, is_mobile=True, device_scale_factor=2, color_scheme="dark")
    page.set_viewport_size({"width": 390, "height": 844})
    page.evaluate("new Promise(done => setTimeout(done, 300))")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    assert page.locator("#view").bounding_box()["height"] > 350
    slider = page.get_by_role("slider", name="triceps")
    slider.tap()
    assert page.evaluate(f"{ARM}.activation[4]") == pytest.approx(0.5, abs=0.05)
    overlap = page.evaluate(
        """() => { const box = id => document.getElementById(id).getBoundingClientRect();
        const a = box('legend'), b = box('readout');
        return a.right > b.left && a.bottom > b.top && b.bottom > a.top; }"""
    )
    assert not overlap
    page.context.close()


def test_graphics_that_are_taken_away_and_given_back(page):
    lose = """() => { const gl = document.getElementById('view').getContext('webgl2');
        window.taken = gl.getExtension('WEBGL_lose_context'); window.taken.loseContext(); }"""
    before = picture(page)
    page.evaluate(lose)
    page.wait_for_selector("#sentence:not([hidden])")
    assert "taken the graphics away" in page.locator("#sentence").inner_text()
    page.evaluate("window.taken.restoreContext()")
    page.wait_for_selector("#sentence", state="hidden")
    assert picture(page) == before


def test_without_javascript_it_says_so(browser, address):
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(address)
    assert "turned off here" in page.locator("noscript").inner_text()
    context.close()


def test_without_webgl_it_says_so_in_words(chromium, address):
    browser = chromium("--disable-3d-apis")
    page = browser.new_page()
    page.goto(address)
    page.wait_for_selector("html[data-state=failed]")
    assert "needs WebGL" in page.locator("#sentence").inner_text()
    browser.close()


def test_without_an_arm_it_says_how_to_make_one(browser, template, tmp_path):
    path = tmp_path / "empty.html"
    path.write_text(template, encoding="utf-8")
    page = browser.new_page()
    page.goto(path.as_uri())
    page.wait_for_selector("html[data-state=failed]")
    assert "myograph view --out page.html" in page.locator("#sentence").inner_text()


def test_numbers_of_the_shipped_arm_are_those_of_python(browser, shipped):
    page, muscles = opened(browser, shipped.as_uri()), read_low_rank_arm(models_folder() / "arm")
    for activation in np.random.default_rng(3).random((20, 5)):
        check_numbers(page, muscles, activation, 0.0)
    assert "von_mises" in page.evaluate(f"{ARM}.data.fields.map(field => field.key)")
    page.context.close()


def test_the_shipped_arm_is_small_opens_soon_and_follows_at_once(browser, shipped):
    """Frames by the lower quartile of 80, opening by the best of three: other work of the machine is not the page's.

    Nor is the start of WebGL in software, which takes chromium up to two seconds where there is no graphics card.
    """
    assert shipped.stat().st_size < 6e6
    assert 'id="myograph-wasm"' not in shipped.read_text(encoding="utf-8")
    readiness, frames = [], {}
    for _ in range(3):
        page = opened(browser, shipped.as_uri())
        readiness.append(page.evaluate("myograph.readyAfter - myograph.webgl"))
        measure = f"""field => {{ const times = []; {ARM}.show(field, null);
            for (let i = 0; i < 80; i++) {{
                {ARM}.predict([i / 80, 0.5, 0.8, 0.2, 0.3], 0);
                times.push({ARM}.milliseconds);
            }}
            return times.sort((a, b) => a - b)[20]; }}"""
        frames = {field: page.evaluate(measure, field) for field in ("muscle", "von_mises", "deviation")}
        page.context.close()
    assert max(frames.values()) < FRAME_MS, frames
    assert min(readiness) < OPEN_MS, readiness
