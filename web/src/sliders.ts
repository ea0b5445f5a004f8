// The five activations and the load at the hand.

import type { PageData } from "./data";
import { make } from "./dom";

export interface Sliders {
  element: HTMLElement;
  /** Put all of them there; nothing is told. */
  set(activation: ArrayLike<number>, load: number): void;
}

/** Sliders that tell every change. */
export function makeSliders(data: PageData, tell: (activation: number[], load: number) => void): Sliders {
  const rows = data.muscles.map((name, i) => row(name, { most: 1, step: 0.01, colour: data.colours[i]! }));
  const most = data.most_load;
  const load = row("load in the hand", { most, step: most / 100, colour: "var(--faint)", unit: "N" });
  const told = () => tell(rows.map((each) => each.input.valueAsNumber), load.input.valueAsNumber);
  const all = [...rows, load];
  all.forEach((each) => each.input.addEventListener("input", () => {
    each.write();
    told();
  }));
  const set = (activation: ArrayLike<number>, newtons: number) => {
    rows.forEach((each, i) => (each.input.value = String(activation[i])));
    load.input.value = String(newtons);
    all.forEach((each, i) => each.write(i < rows.length ? activation[i] : newtons));
  };
  set(data.muscles.map(() => 0), 0);
  return { element: make("div", { class: "sliders" }, ...all.map((each) => each.element)), set };
}

interface Row {
  element: HTMLElement;
  input: HTMLInputElement;
  write: (value?: number) => void;
}

function row(name: string, { most, step, colour, unit = "" }: { most: number; step: number; colour: string; unit?: string }): Row {
  const input = make("input", { type: "range", min: 0, max: most, step, value: 0, style: `--own: ${colour}`, "aria-label": name });
  const output = make("output");
  const write = (value = input.valueAsNumber) => {
    input.style.setProperty("--at", `${(100 * value) / most}%`);
    output.textContent = unit ? `${value.toFixed(1)} ${unit}` : value.toFixed(2);
  };
  const swatch = make("i", { class: "swatch", style: `background: ${colour}` });
  return { element: make("label", { class: "slider" }, make("span", {}, swatch, name), output, input), input, write };
}
