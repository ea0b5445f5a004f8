// Worker and runtime out of the page's own text: nothing is fetched, and nothing is made before it is needed.

import type { Engine, Port } from "./network";

/** From the elements that `myograph view` puts into pages with a network. */
export function pageEngine(page: Document): Engine {
  const text = (id: string) => {
    const found = page.getElementById(id)?.textContent;
    if (!found) throw new Error(`the page has no element '${id}'`);
    return found.trim();
  };
  return {
    port: () => {
      const address = URL.createObjectURL(new Blob([text("myograph-worker")], { type: "text/javascript" }));
      const worker = new Worker(address);
      return worker as unknown as Port;
    },
    wasm: () => text("myograph-wasm"),
  };
}
