// Everything together: what people do changes the arm, and the arm changes what they see.

import { Arm, DIFFERENCE } from "./arm";
import { lookupTable, channels } from "./colours";
import type { Blob64, FieldChoice, PageData } from "./data";
import { button, check, choice, found, make, section } from "./dom";
import { showLegend } from "./legend";
import { pageEngine } from "./network/engine";
import { Network } from "./network/network";
import { type Drawer, type NetworkPanel, makeNetworkPanel } from "./network/panel";
import { showPicked } from "./picked";
import { type Player, makePlayer } from "./player";
import { type Part, download, glb, stl } from "./saving";
import { type Pick, View } from "./scene";
import { type Sliders, makeSliders } from "./sliders";
import { showTimes } from "./times";

const WARM = 12;

export class Page {
  readonly arm: Arm;
  readonly view: View;
  private readonly sliders: Sliders;
  private readonly player: Player | null;
  private readonly cases: HTMLSelectElement | null;
  private readonly fields: HTMLSelectElement;
  private readonly networkPanel: NetworkPanel | null;
  private readonly angle = make("output", { class: "angle" });
  private picked: Pick | null = null;
  private ghost = true;

  constructor(private readonly data: PageData, blob: Blob64, context: WebGL2RenderingContext) {
    this.arm = new Arm(data, blob);
    this.arm.network = data.network && new Network(data.network, blob, pageEngine(document), () => this.heard());
    this.arm.predict(data.muscles.map(() => 0), 0);
    this.view = new View(context, this.arm, blob);
    this.sliders = makeSliders(data, (activation, load) => {
      this.player?.stop();
      this.ask(activation, load);
    });
    const movement = data.movement && { ...data.movement, activation: blob.floats(data.movement.activation) };
    this.player = movement && makePlayer(movement, (activation) => this.follow(activation, this.arm.load));
    const named: [string, string][] = data.truth.map((truth, i) => [String(i), truth.name]);
    this.cases = named.length ? choice("case of the truth", [["", "none"], ...named], (value) => this.compare(value)) : null;
    this.fields = choice("colour", data.fields.map((field) => [field.key, field.label]), (key) => this.show(key));
    const { network } = this.arm;
    this.networkPanel = network && makeNetworkPanel(
      network, this.arm.drawn[network.told.body]!.muscle.name, (by) => this.drawBy(by), (points) => this.view.points(points));
    this.build();
    this.listen();
    this.show(data.fields[0]!.key);
  }

  /** Move sliders and arm there; a movement stops, a comparison with the truth ends. */
  set(activation: ArrayLike<number>, load: number): void {
    this.player?.stop();
    this.follow(activation, load);
  }

  private follow(activation: ArrayLike<number>, load: number): void {
    this.sliders.set(activation, load);
    this.ask(activation, load);
  }

  /** Colour by this field. */
  show(key: string): void {
    const field = this.data.fields.find((each) => each.key === key);
    if (!field) throw new Error(`unknown field '${key}': expected ${this.data.fields.map((each) => each.key).join(", ")}`);
    this.fields.value = key;
    this.arm.show(key, this.arm.truth);
    this.view.colours(key, field.low, field.high);
    this.refresh();
  }

  /** Draw the network's muscle as the modes or as the network say. */
  drawBy(by: Drawer): void {
    this.arm.drawNetwork(by !== "modes");
    if (by === "difference") this.show(DIFFERENCE);
    else if (this.arm.field === DIFFERENCE) this.show(this.data.fields[0]!.key);
    else this.refresh();
  }

  /** Compare with this case of the truth, by its number; none for an empty word. */
  compare(number: string): void {
    const truth = this.data.truth[Number(number)];
    if (number === "" || !truth) {
      this.truth(null);
      return;
    }
    this.player?.stop();
    this.sliders.set(truth.activation, truth.hand_load);
    this.arm.predict(truth.activation, truth.hand_load);
    this.truth(Number(number));
  }

  pick(pick: Pick | null): void {
    this.picked = pick;
    this.view.mark(pick);
    this.refresh();
  }

  /** Predict a few times: the first time is mostly the browser's, which compiles what it runs. */
  warm(): void {
    for (let i = 0; i < WARM; i++) this.arm.predict(this.arm.activation, this.arm.load);
    this.refresh();
  }

  private heard(): void {
    this.arm.answered();
    this.refresh();
  }

  private ask(activation: ArrayLike<number>, load: number): void {
    if (this.arm.truth) this.truth(null);
    this.arm.predict(activation, load);
    this.refresh();
  }

  private truth(number: number | null): void {
    const truth = number === null ? null : this.data.truth[number]!;
    if (this.cases) this.cases.value = number === null ? "" : String(number);
    this.arm.show(this.arm.field, truth);
    const shown = truth && this.ghost ? this.arm.drawn.map(({ muscle }, body) => muscle.ghost(truth, body)) : null;
    this.view.ghost(shown);
    this.refresh();
  }

  private refresh(): void {
    this.view.update();
    const field = this.data.fields.find((each) => each.key === this.arm.field) as FieldChoice;
    showLegend(found("legend"), this.arm, field);
    this.networkPanel?.update(this.arm);
    showPicked(found("picked"), this.arm, this.picked, () => this.pick(null));
    const angle = this.arm.angleDegrees;
    this.angle.textContent = angle === null ? "unknown" : `${angle.toFixed(1)}°`;
    const number = this.data.truth.indexOf(this.arm.truth!);
    const truth = number >= 0 ? this.data.truth[number]!.elbow_angle_deg : null;
    if (truth !== null) this.angle.textContent += ` (truth ${truth.toFixed(1)}°)`;
    showTimes(found("readout"), this.arm);
    const outside = this.arm.outside;
    found("badge").hidden = outside.length === 0;
    found("badge").textContent = outside.length ? `Outside what the model was trained on: ${outside.join(", ")}. Do not rely on it.` : "";
  }

  private build(): void {
    const { data } = this;
    const presets = data.presets.map((each) => button(each.name, "set all sliders", () => this.set(each.activation, each.hand_load)));
    const panel = found("panel");
    panel.append(
      make("header", {}, make("h1", {}, data.title), button("◐", "light or dark", toggleTheme)),
      section("Activations", this.sliders.element, make("div", { class: "row" }, make("span", {}, "elbow flexion"), this.angle)),
      section("Presets", make("div", { class: "buttons" }, ...presets)),
      section("Colour", this.fields),
    );
    if (this.networkPanel) panel.append(this.networkPanel.element);
    if (this.cases) {
      const ghost = check("ghost of the truth", (on) => {
        this.ghost = on;
        this.truth(this.arm.truth ? data.truth.indexOf(this.arm.truth) : null);
      });
      (ghost.firstChild as HTMLInputElement).checked = true;
      panel.append(section("Truth to compare with", this.cases, ghost));
    }
    if (this.player) panel.append(section("Movement", this.player.element));
    panel.append(section("View", this.looks()), section("Save what is shown", this.savers()), this.about());
  }

  private looks(): HTMLElement {
    const look = (name: string, turn: number) => button(name, `look from there`, () => this.view.look(turn));
    const looks = [look("side", 0.3), look("front", Math.PI / 2), look("inside", Math.PI - 0.3), look("back", -Math.PI / 2)];
    const sensors = this.arm.drawn.some(({ muscle }) => muscle.sensors.length)
      ? [check("sensors", (on) => this.view.sensors(on))] : [];
    return make("div", {}, make("div", { class: "buttons" }, ...looks), ...sensors);
  }

  private savers(): HTMLElement {
    return make("div", { class: "buttons" },
      button("STL", "surfaces in mm", () => download(this.file("stl"), "arm.stl", "model/stl")),
      button("glTF", "surfaces and colours, one .glb file", () => download(this.file("glb"), "arm.glb", "model/gltf-binary")));
  }

  /** The shown state as a file. */
  file(kind: "stl" | "glb"): ArrayBuffer {
    const field = this.data.fields.find((each) => each.key === this.arm.field)!;
    const table = lookupTable(field.key);
    const parts: Part[] = this.arm.drawn.map((drawn) => {
      const own = channels(drawn.muscle.colour);
      const colour = new Float32Array(drawn.position.length);
      drawn.value.forEach((value, i) => {
        const at = 4 * Math.round(255 * Math.min(1, Math.max(0, (value - field.low) / (field.high - field.low || 1))));
        for (let c = 0; c < 3; c++) colour[3 * i + c] = (drawn.known ? table[at + c]! : own[c]!) / 255;
      });
      const { position, normal, surface, muscle } = drawn;
      return { name: muscle.name, position, normal, triangles: surface.triangles, colour };
    });
    return kind === "stl" ? stl(parts, `myograph ${this.data.title}`) : glb(parts, this.data.title);
  }

  private about(): HTMLElement {
    const rows = Object.entries(this.data.about).flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]);
    const notes = this.data.notes.map((note) => make("p", { class: "note" }, note));
    const details = make("details", {}, make("summary", {}, "About this arm"), make("dl", {}, ...rows));
    return make("footer", {}, ...notes, details);
  }

  private listen(): void {
    const canvas = found("view");
    let down: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
    canvas.addEventListener("pointerup", (event) => {
      if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 5) this.pick(this.view.pick(event.clientX, event.clientY));
    });
    const turn = 0.12;
    const keys: Record<string, () => void> = {
      ArrowLeft: () => this.view.turn(-turn, 0),
      ArrowRight: () => this.view.turn(turn, 0),
      ArrowUp: () => this.view.turn(0, turn),
      ArrowDown: () => this.view.turn(0, -turn),
      "+": () => this.view.turn(0, 0, 1.15),
      "-": () => this.view.turn(0, 0, 1 / 1.15),
      "0": () => this.view.look(0.3),
      " ": () => this.player?.toggle(),
    };
    canvas.addEventListener("keydown", (event) => {
      const act = keys[event.key];
      if (!act || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      act();
    });
  }
}

function toggleTheme(): void {
  const root = document.documentElement;
  const dark = root.dataset["theme"] ? root.dataset["theme"] === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset["theme"] = dark ? "light" : "dark";
}
