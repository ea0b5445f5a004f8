// The corner: milliseconds of the last prediction, of the network where it answers, and a solver's beside them.

import type { Arm } from "./arm";
import { make } from "./dom";

export function showTimes(place: HTMLElement, arm: Arm): void {
  const { network, data: { solve } } = arm;
  const rows = [make("div", { title: "all muscles, with surfaces and normals" }, `prediction ${duration(arm.milliseconds / 1000)}`)];
  if (arm.needsNetwork && network?.milliseconds) {
    rows.push(make("div", { title: `${network.told.name}, its own time in the worker` }, `network ${duration(network.milliseconds / 1000)}`));
  }
  if (solve) rows.push(make("div", { title: solve.told }, `${solve.what} ${duration(solve.seconds)}`));
  place.replaceChildren(...rows);
}

/** Such as '1.3 ms', '190 ms', '27 s'. */
export function duration(seconds: number): string {
  if (seconds >= 1) return `${seconds < 9.95 ? seconds.toFixed(1) : seconds.toFixed(0)} s`;
  const milliseconds = 1000 * seconds;
  return `${milliseconds < 99.95 ? milliseconds.toFixed(1) : milliseconds.toFixed(0)} ms`;
}
