// What the colours mean: names of the muscles, or a bar with numbers and a unit.

import { type Arm, DIFFERENCE } from "./arm";
import { lookupTable, written } from "./colours";
import type { FieldChoice } from "./data";
import { make } from "./dom";
import { sentence } from "./network/panel";

export function showLegend(place: HTMLElement, arm: Arm, field: FieldChoice): void {
  if (field.key === "muscle") {
    const names = arm.drawn.map(({ muscle }) =>
      make("span", { class: "name" }, make("i", { class: "swatch", style: `background: ${muscle.colour}` }), muscle.name));
    place.replaceChildren(make("div", { class: "names" }, ...names));
    return;
  }
  if (!arm.drawn.some((drawn) => drawn.known)) {
    const { network } = arm;
    const why = field.key === DIFFERENCE && network
      ? network.problem || sentence(network) : "known at the cases of the truth only; choose one of them.";
    place.replaceChildren(make("p", {}, `${field.label}: ${why}`));
    return;
  }
  const middle = (field.low + field.high) / 2;
  const below = field.low > 0 ? "≤ " : "";
  const ticks = [`${below}${written(field.low)}`, written(middle), `≥ ${written(field.high)}`].map((text) => make("span", {}, text));
  place.replaceChildren(
    make("div", { class: "what", title: field.meaning }, `${field.label} [${field.unit}]`),
    make("div", { class: "bar", style: `background: ${gradient(field.key)}` }),
    make("div", { class: "ticks" }, ...ticks),
  );
}

function gradient(key: string): string {
  const table = lookupTable(key);
  const stops = Array.from({ length: 12 }, (_, i) => {
    const at = 4 * Math.round((i / 11) * 255);
    return `rgb(${table[at]}, ${table[at + 1]}, ${table[at + 2]})`;
  });
  return `linear-gradient(to right, ${stops.join(", ")})`;
}
