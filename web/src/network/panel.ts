// What the panel offers of a network: who draws its muscle, and its points.

import { DIFFERENCE, type Arm } from "../arm";
import { check, choice, make, section } from "../dom";
import type { Network } from "./network";

export type Drawer = "modes" | "network" | "difference";

export interface NetworkPanel {
  element: HTMLElement;
  /** Say what is so. */
  update(arm: Arm): void;
}

/** Which points are shown. */
export interface Points {
  sensors: boolean;
  nodes: boolean;
}

export function makeNetworkPanel(
  network: Network, muscle: string, draw: (by: Drawer) => void, points: (shown: Points) => void,
): NetworkPanel {
  const options: [Drawer, string][] = [
    ["modes", "modes"], ["network", "network"], ["difference", "network, its difference in mm"],
  ];
  const select = choice("who draws the muscle", options, (by) => draw(by as Drawer));
  const state = make("p", { class: "note", "aria-live": "polite" });
  const shown: Points = { sensors: false, nodes: false };
  const toggle = (label: string, which: keyof Points) => check(label, (on) => {
    shown[which] = on;
    points(shown);
  });
  const checks = [
    ...(network.sensors.length ? [toggle(`its ${network.sensors.length / 3} sensors`, "sensors")] : []),
    ...(network.nodes ? [toggle(`its ${network.nodes.length / 3} learned nodes`, "nodes")] : []),
  ];
  return {
    element: section(`Who draws the ${muscle}`, select, state, ...checks),
    update: (arm) => {
      select.value = !arm.networkDrawn ? "modes" : arm.field === DIFFERENCE ? "difference" : "network";
      state.textContent = network.problem || sentence(network);
      state.hidden = !state.textContent;
    },
  };
}

/** Where the network is with its work; empty once it answers. */
export function sentence(network: Network): string {
  if (!network.started) return `The network ${network.told.name} starts when it is first asked.`;
  return network.position ? "" : "The network is starting …";
}
