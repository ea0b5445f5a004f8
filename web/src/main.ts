// Opens the page: reads its numbers, builds it, or says in words what is missing.

import { ColorManagement } from "three";
import { readPage } from "./data";
import { found } from "./dom";
import { Page } from "./page";
import "./style.css";

const NO_WEBGL =
  "This page needs WebGL, and this browser gives none. Turn on hardware acceleration in its settings, or open the page in " +
  "another browser; nothing else is needed.";

const LOST = "The browser has taken the graphics away from this page. Reload it if the arm does not come back by itself.";

declare global {
  interface Window {
    /** For scripts: the page, and the times [ms] from opening until it could be used, and that WebGL took of it. */
    myograph?: { page: Page; readyAfter: number; webgl: number };
  }
}

/** The drawing context, kept for pictures of the page; null where the browser has none. */
function webgl(): WebGL2RenderingContext | null {
  const canvas = found("view") as HTMLCanvasElement;
  return canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
}

function say(sentence: string): void {
  found("sentence").textContent = sentence;
  found("sentence").hidden = false;
  document.documentElement.dataset["state"] = "failed";
}

/** Phones take the graphics from pages in the background; three.js draws again when they come back. */
function watch(canvas: HTMLElement, page: Page): void {
  canvas.addEventListener("webglcontextlost", () => {
    found("sentence").textContent = LOST;
    found("sentence").hidden = false;
  });
  canvas.addEventListener("webglcontextrestored", () => {
    found("sentence").hidden = true;
    page.view.update();
  });
}

function open(): void {
  ColorManagement.enabled = false;
  const { data, blob } = readPage(document);
  document.title = data.title;
  const started = performance.now();
  const context = webgl();
  const taken = performance.now() - started;
  if (!context) {
    say(NO_WEBGL);
    return;
  }
  const page = new Page(data, blob, context);
  window.myograph = { page, readyAfter: performance.now(), webgl: taken };
  watch(found("view"), page);
  document.documentElement.dataset["state"] = "ready";
  setTimeout(() => page.warm(), 50);
}

try {
  open();
} catch (problem) {
  say(problem instanceof Error ? problem.message : String(problem));
}
