// The values of one node.

import type { Arm } from "./arm";
import { written } from "./colours";
import { make } from "./dom";
import type { Pick } from "./scene";

export function showPicked(place: HTMLElement, arm: Arm, pick: Pick | null, close: () => void): void {
  place.hidden = pick === null;
  if (!pick) return;
  const drawn = arm.drawn[pick.body]!;
  const { muscle } = drawn;
  const at = (array: ArrayLike<number>) => [0, 1, 2].map((k) => array[3 * pick.node + k]!.toFixed(1)).join(", ");
  const rows: [string, string][] = [["now", `${at(drawn.shape)} mm`], ["reference", `${at(muscle.reference)} mm`]];
  for (const field of arm.data.fields) {
    const values = field.key === "muscle" ? null : arm.values(drawn, field.key);
    const unit = field.unit === "1" ? "" : ` ${field.unit}`;
    if (values) rows.push([field.label, `${written(values[pick.node]!)}${unit}`]);
  }
  const shut = make("button", { type: "button", title: "close", "aria-label": "close" }, "×");
  shut.addEventListener("click", close);
  const sensor = muscle.sensors.includes(pick.node) ? ", a sensor" : "";
  place.replaceChildren(
    make("div", { class: "head" }, `${muscle.name}, node ${muscle.nodes[pick.node]}${sensor}`, shut),
    make("dl", {}, ...rows.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)])),
  );
}
