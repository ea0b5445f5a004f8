// Plays a movement in its own time.

import { make } from "./dom";
import { type Movement, activationAt } from "./movement";

export interface Player {
  element: HTMLElement;
  stop(): void;
  toggle(): void;
}

export function makePlayer(movement: Movement, tell: (activation: number[]) => void): Player {
  const first = movement.times[0]!, last = movement.times[movement.times.length - 1]!;
  const play = make("button", { type: "button", title: "play or pause (space)" }, "▶ play");
  const bar = make("input", {
    type: "range", min: first, max: last, step: (last - first) / 1000, value: first, "aria-label": "time of the movement",
  });
  const clock = make("output", {}, "");
  let running = false, time = first, before = 0;
  const show = () => {
    bar.value = String(time);
    bar.style.setProperty("--at", `${(100 * (time - first)) / (last - first)}%`);
    clock.textContent = `${time.toFixed(2)} s`;
    tell(activationAt(movement, time));
  };
  const step = (now: number) => {
    if (!running) return;
    time += (now - before) / 1000;
    before = now;
    if (time > last) time = first;
    show();
    requestAnimationFrame(step);
  };
  const run = (on: boolean) => {
    running = on;
    play.textContent = on ? "❚❚ pause" : "▶ play";
    before = performance.now();
    if (on) requestAnimationFrame(step);
  };
  play.addEventListener("click", () => run(!running));
  bar.addEventListener("input", () => {
    run(false);
    time = bar.valueAsNumber;
    show();
  });
  clock.textContent = `${time.toFixed(2)} s`;
  const name = make("div", { class: "note" }, movement.name);
  const element = make("div", { class: "player" }, name, make("div", { class: "row" }, play, clock), bar);
  return { element, stop: () => run(false), toggle: () => run(!running) };
}
