// Shows the number of the step of the assembly, and the list of its blocks.

import { html, legible } from "./dom.js";
import { standing } from "./scene.js";

export class Frame {
  /** @param {import("./store.js").Store} store @param {(id: string) => any} byId */
  constructor(store, byId) {
    this.store = store;
    this.bar = byId("steps");
    this.previous = byId("step-previous");
    this.next = byId("step-next");
    this.text = byId("step-title");
    /** @type {HTMLSelectElement} */
    this.blocks = byId("blocks");
    this.previous.addEventListener("click", () => store.showFrame(store.frame - 1));
    this.next.addEventListener("click", () => store.showFrame(store.frame + 1));
    this.blocks.addEventListener("change", () => store.select(this.blocks.value || null));
  }

  refresh() {
    const { store } = this;
    const { frames } = store.resolved;
    this.bar.hidden = frames.length < 2;
    this.previous.disabled = store.frame === 0;
    this.next.disabled = store.frame === frames.length - 1;
    const title = legible(store.current.title);
    this.text.textContent = `Step ${store.frame + 1} of ${frames.length}${title ? `: ${title}` : ""}`;
    const bodies = standing(store.resolved, store.frame).toSorted((a, b) => Number(a.list === "ground") - Number(b.list === "ground"));
    const keys = bodies.map((body) => body.key + body.id).join("\n");
    if (keys !== this.blocks.dataset.keys) {
      this.blocks.dataset.keys = keys;
      this.blocks.replaceChildren(...bodies.map((body) => html("option", { value: body.key }, body.list === "ground" ? `Ground, part ${body.index + 1}` : `Block ${legible(body.id)}`)));
    }
    this.blocks.value = store.selected ?? "";
  }
}
