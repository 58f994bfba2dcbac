// Shows the scene as text, which users can edit. The text follows changes on the stage, and problems are marked at their lines.

import { html, afterPause } from "./dom.js";

export class Source {
  /**
   * @param {{ area: HTMLTextAreaElement, gutter: HTMLElement, list: HTMLElement }} parts
   * @param {import("./store.js").Store} store
   */
  constructor(parts, store) {
    this.parts = parts;
    this.store = store;
    /** @type {Map<number, "problem" | "note">} */
    this.marks = new Map();
    this.lines = 0;
    const { area } = parts;
    const typed = afterPause(250, () => store.type(area.value));
    area.addEventListener("input", () => {
      this.drawGutter();
      typed();
    });
    area.addEventListener("scroll", () => { parts.gutter.scrollTop = area.scrollTop; });
    area.addEventListener("blur", () => store.type(area.value));
  }

  /** Shows the text of the scene, unless the user is typing in it. */
  refresh() {
    const { area } = this.parts;
    if (area.value === this.store.text) return;
    const top = area.scrollTop;
    area.value = this.store.text;
    area.scrollTop = top;
    this.drawGutter();
  }

  drawGutter() {
    const { area, gutter } = this.parts;
    const lines = area.value.split("\n").length;
    if (lines === this.lines) return;
    this.lines = lines;
    gutter.replaceChildren(...Array.from({ length: lines }, (_, i) => html("span", { class: this.marks.get(i + 1) ?? null }, String(i + 1))));
    gutter.scrollTop = area.scrollTop;
  }

  /** @param {any[]} problems @param {any[]} notes */
  show(problems, notes) {
    const all = [...problems.map((entry) => ({ ...entry, kind: "problem" })), ...notes.map((entry) => ({ ...entry, kind: "note" }))];
    for (const line of this.marks.keys()) this.parts.gutter.children[line - 1]?.removeAttribute("class");
    this.marks = new Map(all.filter((e) => e.line).reverse().map((e) => [e.line, e.kind]));
    for (const [line, kind] of this.marks) this.parts.gutter.children[line - 1]?.setAttribute("class", kind);
    this.parts.area.setAttribute("aria-invalid", String(problems.length > 0));
    this.parts.list.replaceChildren(...all.slice(0, 50).map((entry) => this.item(entry)));
  }

  /** @param {any} entry @returns {HTMLElement} */
  item({ kind, line, column, message, hint }) {
    const text = `${kind === "note" ? "Note: " : ""}${message}${hint ? ` – ${hint}` : ""}`;
    if (!line) return html("li", { class: kind }, html("bdi", {}, text));
    const button = html("button", { type: "button" }, html("span", { class: "line" }, `Line ${line}`), " ", html("bdi", {}, text));
    button.addEventListener("click", () => this.goTo(line, column ?? 1));
    return html("li", { class: kind }, button);
  }

  /** Puts the caret at a position in the text. @param {number} line from 1 @param {number} column from 1 */
  goTo(line, column) {
    const { area } = this.parts;
    const before = area.value.split("\n").slice(0, line - 1).reduce((sum, text) => sum + text.length + 1, 0);
    area.focus();
    area.setSelectionRange(before + column - 1, before + column - 1);
    area.scrollTop = (line - 4) * parseFloat(getComputedStyle(area).lineHeight);
  }
}
