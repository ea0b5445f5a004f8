"""A page whose network is asked in a worker, in a real browser, from disk: the shipped graph element network."""

import json

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.inference.shipped import models_folder
from myograph.view.page import PageArm, filled_page, page_content, read_arm_models, read_network, read_runtime
from tests.view.page.opening import opened

RELATIVE = 1e-4
ARM = "myograph.page.arm"
NETWORK = f"{ARM}.network"
SETTLED = f"""new Promise(done => {{
    const look = () => {NETWORK}.settled || {NETWORK}.problem ? done({NETWORK}.problem) : setTimeout(look, 5);
    look(); }})"""


@pytest.fixture(scope="module")
def asked():
    """The shipped network beside the shipped arm."""
    folder = models_folder()
    if not (folder / "gen-biceps").is_dir() or not (folder / "arm").is_dir():
        pytest.skip("this installation has no models of its own")
    models = read_arm_models(folder / "arm", built_in_arm())
    return PageArm(models, network=read_network(folder / "gen-biceps", models))


@pytest.fixture(scope="module")
def written(asked, template, tmp_path_factory):
    try:
        runtime = read_runtime()
    except InputError as missing:
        pytest.skip(str(missing))
    path = tmp_path_factory.mktemp("network") / "page.html"
    path.write_text(filled_page(template, page_content(asked), runtime), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def page(browser, written):
    """Opened, and its network asked for the first time.

    `page.computed` is what that took of processors [s]: of the page's own thread, and of all threads of its process.
    It is not the clock's time, in which a busy machine may leave the page's thread waiting for most of a second.
    """
    page = opened(browser, written.as_uri())
    page.before = len(page.workers)
    tools = page.context.new_cdp_session(page)
    tools.send("Performance.enable", {"timeDomain": "threadTicks"})
    before = metrics(tools)
    page.evaluate("myograph.page.drawBy('network')")
    page.evaluate(SETTLED)
    page.computed = {name: value - before[name] for name, value in metrics(tools).items()}
    return page


def metrics(tools):
    told = tools.send("Performance.getMetrics")["metrics"]
    return {metric["name"]: metric["value"] for metric in told if metric["name"] in ("ThreadTime", "ProcessTime")}


def test_the_worker_starts_with_the_first_question_and_the_page_goes_on_meanwhile(page):
    assert page.before == 0
    assert len(page.workers) == 1
    assert page.evaluate(f"{NETWORK}.problem") == ""
    assert [word for word in page.said if not word.startswith(("data:", "blob:"))] == []
    assert (
        "9 sensors, placed as the modes say; it was taught on a body of 4005 nodes"
        in page.locator("#panel").inner_text()
    )
    assert 0 < page.computed["ThreadTime"] < page.computed["ProcessTime"] / 5


@pytest.mark.parametrize("number", range(3))
def test_its_answer_is_that_of_python(page, asked, number):
    activation = np.random.default_rng(number).random(5)
    page.evaluate("a => { myograph.page.set(a, 3); myograph.page.drawBy('network'); }", activation.tolist())
    assert page.evaluate(SETTLED) == ""
    found = page.evaluate(
        f"""() => {{ const drawn = {ARM}.drawn[{NETWORK}.told.body];
            return {{ shape: Array.from(drawn.shape), nodes: Array.from(drawn.muscle.nodes),
                      difference: Array.from({NETWORK}.difference) }}; }}"""
    )
    nodes, modes = np.array(found["nodes"]), asked.network.muscle.at(activation, 3.0)["position"]
    wanted = asked.network.positions(activation, 3.0, nodes)
    shape = np.array(found["shape"]).reshape(-1, 3)
    moved = np.abs(wanted - asked.network.rest[nodes]).max()
    np.testing.assert_allclose(shape, wanted, rtol=0, atol=RELATIVE * np.abs(wanted).max())
    np.testing.assert_allclose(shape - wanted, 0, atol=10 * RELATIVE * moved)
    apart = np.linalg.norm(wanted - modes[nodes], axis=1)
    np.testing.assert_allclose(found["difference"], apart, atol=10 * RELATIVE * moved)


def test_the_newest_question_wins_and_none_is_waited_for(page):
    told = page.evaluate(
        f"""() => {{ const before = {NETWORK}.sent, times = [];
            myograph.page.drawBy('network');
            for (let i = 0; i <= 40; i++) {{
                const began = performance.now();
                myograph.page.set([0, 0, i / 40, 0, 0], 0);
                times.push(performance.now() - began);
            }}
            return {{ sent: {NETWORK}.sent - before, typical: times.sort((a, b) => a - b)[10] }}; }}"""
    )
    assert told["sent"] <= 1
    assert told["typical"] < 16
    assert page.evaluate(SETTLED) == ""
    assert page.evaluate(f"{NETWORK}.sent") > 0
    last = page.evaluate(f"Array.from({NETWORK}.position)")
    page.evaluate("myograph.page.set([0, 0, 1, 0, 0], 0)")
    page.evaluate(SETTLED)
    assert page.evaluate(f"Array.from({NETWORK}.position)") == last


def test_who_draws_the_biceps_is_chosen_and_the_corner_tells_its_time(page):
    choice = page.get_by_label("who draws the muscle")
    page.evaluate("myograph.page.set([0.5, 0.5, 1, 0, 0], 0)")
    choice.select_option("difference")
    page.evaluate(SETTLED)
    assert "network minus modes [mm]" in page.locator("#legend").inner_text()
    assert "network" in page.locator("#readout").inner_text()
    assert page.evaluate(f"{ARM}.drawn.filter(drawn => drawn.known).map(drawn => drawn.muscle.name)") == ["biceps"]
    shape = f"JSON.stringify(Array.from({ARM}.drawn[{NETWORK}.told.body].position))"
    by_network = json.loads(page.evaluate(shape))
    choice.select_option("modes")
    by_modes = json.loads(page.evaluate(shape))
    assert 0.05 < np.abs(np.subtract(by_network, by_modes)).max() < 10
    assert "network" not in page.locator("#readout").inner_text()
    page.get_by_label("colour").select_option("difference")
    assert choice.input_value() == "modes"
    page.get_by_label("colour").select_option("muscle")


def test_its_sensors_follow_the_muscle_and_its_learned_nodes_stay(page, asked):
    places = """name => myograph.page.view[name].children.map(dot => dot.position.toArray())"""
    page.evaluate("myograph.page.set([0, 0, 0, 0, 0], 0)")
    at_rest, nodes = page.evaluate(places, "networkSensors"), page.evaluate(places, "graph")
    np.testing.assert_allclose(nodes, asked.network.graph, atol=1e-3)
    np.testing.assert_allclose(at_rest, asked.network.sensors @ asked.network.rest, atol=1e-2)
    page.evaluate("myograph.page.set([0, 0, 1, 0, 0], 0)")
    assert np.abs(np.subtract(page.evaluate(places, "networkSensors"), at_rest)).max() > 5
    assert page.evaluate("myograph.page.view.graph.visible") is False
    page.get_by_label("its 8 learned nodes").check()
    assert page.evaluate("myograph.page.view.graph.visible") is True
    assert page.evaluate(places, "graph") == nodes


def test_a_browser_that_runs_no_webassembly_says_so_and_shows_the_modes(browser, written):
    page = browser.new_page()
    page.add_init_script("window.Worker = function () { throw new Error('no workers here'); }")
    page.goto(written.as_uri())
    page.wait_for_selector("html[data-state=ready]", timeout=60_000)
    page.get_by_label("who draws the muscle").select_option("network")
    assert "cannot run in this browser (no workers here). The modes are shown." in page.locator("#panel").inner_text()
    assert page.evaluate(f"{ARM}.drawn[{NETWORK}.told.body].shape === {ARM}.drawn[{NETWORK}.told.body].muscle.position")
    page.close()
