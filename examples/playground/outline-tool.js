// Draws a polygon corner by corner, with the pointer or with a cross that the keyboard moves.

import { set, svg } from "./dom.js";
import { length, subtract } from "./geometry.js";

/** @typedef {import("./geometry.js").Point} Point */

/** A click within this many pixels of the first corner closes the polygon. */
const CLOSE = 12;

export class OutlineTool {
  /**
   * @param {import("./stage.js").Stage} stage
   * @param {{ toWorld: (x: number, y: number) => Point, snap: (p: Point) => Point, step: () => number, say: (text: string) => void, done: (polygon: Point[] | null) => void }} page
   */
  constructor(stage, page) {
    this.stage = stage;
    this.page = page;
    this.active = false;
    /** @type {Point[]} */
    this.corners = [];
    /** @type {Point} */
    this.cursor = [0, 0];
    const options = { capture: true };
    stage.root.addEventListener("pointerdown", (event) => this.active && event.isPrimary && this.press(event), options);
    stage.root.addEventListener("pointermove", (event) => this.active && this.follow(event), options);
    stage.root.addEventListener("keydown", (event) => this.active && this.key(event), options);
  }

  start() {
    this.active = true;
    this.corners = [];
    this.cursor = this.page.snap(this.stage.view.centre);
    this.stage.root.classList.add("drawing");
    this.stage.root.focus({ preventScroll: true });
    this.page.say("Click the corners of the block, the first one again to close it. With the keyboard: arrow keys move the cross, Space sets a corner, Enter closes, Escape stops.");
    this.draw();
  }

  /** @param {boolean} keep */
  finish(keep) {
    this.active = false;
    this.stage.root.classList.remove("drawing");
    this.stage.layers.draft.replaceChildren();
    this.page.done(keep && this.corners.length >= 3 ? this.corners : null);
  }

  /** @param {PointerEvent} event */
  press(event) {
    event.stopPropagation();
    event.preventDefault();
    this.follow(event);
    const first = this.corners[0];
    if (first && length(subtract(this.cursor, first)) * this.stage.view.zoom < CLOSE) return this.finish(true);
    this.setCorner();
  }

  /** @param {PointerEvent} event */
  follow(event) {
    this.cursor = this.page.snap(this.page.toWorld(event.clientX, event.clientY));
    this.draw();
  }

  setCorner() {
    const last = this.corners.at(-1);
    if (last && length(subtract(last, this.cursor)) === 0) return;
    this.corners.push(this.cursor);
    this.page.say(`Corner ${this.corners.length} set.${this.corners.length > 2 ? " Click the first corner again, or press Enter, to close the block." : ""}`);
    this.draw();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    /** @type {Record<string, Point>} */
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = arrows[event.key];
    const step = this.page.step() * (event.shiftKey ? 4 : 1);
    if (arrow) this.cursor = [this.cursor[0] + arrow[0] * step, this.cursor[1] + arrow[1] * step];
    else if (event.key === " ") this.setCorner();
    else if (event.key === "Enter") return this.take(event, () => this.finish(true));
    else if (event.key === "Escape") return this.take(event, () => this.finish(false));
    else if (event.key === "Backspace") this.corners.pop();
    else return;
    this.take(event, () => this.draw());
  }

  /** @param {KeyboardEvent} event @param {() => void} action */
  take(event, action) {
    event.preventDefault();
    event.stopPropagation();
    action();
  }

  draw() {
    const { view } = this.stage;
    const [x, y] = view.toPixels(this.cursor);
    const line = [...this.corners, this.cursor].map((p) => view.toPixels(p).map((c) => c.toFixed(1)).join(" ")).join("L");
    const dots = this.corners.map((p, i) => {
      const [cx, cy] = view.toPixels(p);
      return svg("circle", { cx, cy, r: i === 0 ? 6 : 4 });
    });
    const cross = svg("path", { class: "cross", d: `M${x - 10} ${y}h20M${x} ${y - 10}v20` });
    const draft = svg("path", { d: this.corners.length > 0 ? `M${line}` : "" });
    set(draft, { class: "draft" });
    this.stage.layers.draft.replaceChildren(draft, ...dots, cross);
  }
}
