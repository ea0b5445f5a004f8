// Small helpers that make elements of the page.

type Attributes = Record<string, string | number | boolean>;

/** An element with attributes and children; text is never read as HTML. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== false) element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children);
  return element;
}

export function button(text: string, title: string, act: () => void): HTMLButtonElement {
  const element = make("button", { type: "button", title }, text);
  element.addEventListener("click", act);
  return element;
}

/** The element of the frame with this id. */
export function found(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no element '${id}'`);
  return element;
}

export function section(heading: string, ...children: Node[]): HTMLElement {
  return make("section", {}, make("h2", {}, heading), ...children);
}

export function choice(label: string, options: [string, string][], act: (value: string) => void): HTMLSelectElement {
  const select = make("select", { "aria-label": label }, ...options.map(([value, text]) => make("option", { value }, text)));
  select.addEventListener("change", () => act(select.value));
  return select;
}

export function check(label: string, act: (on: boolean) => void): HTMLLabelElement {
  const box = make("input", { type: "checkbox" });
  box.addEventListener("change", () => act(box.checked));
  return make("label", { class: "check" }, box, label);
}
