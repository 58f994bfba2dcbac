// Combines stage, document and solver: a structure that users can drag and that shows its verdict immediately. The
// playground adds its tools. Another page, such as a report, can use the workbench alone:
//
//     const bench = new Workbench(svg, { solver: new Solver() });
//     bench.addEventListener("answer", ({ detail }) => { heading.textContent = detail.words.title; });
//     bench.store.open(text);

import { Controller } from "./controller.js";
import { afterPause } from "./dom.js";
import { Fall } from "./fall.js";
import { bounds } from "./geometry.js";
import { standing } from "./scene.js";
import { Stage } from "./stage.js";
import { Store } from "./store.js";
import { faultyBodies, inWords } from "./verdict.js";

export class Workbench extends EventTarget {
  /**
   * @param {SVGSVGElement} root
   * @param {{ solver: import("./solver.js").Solver, snap?: () => boolean, forces?: () => boolean }} options
   */
  constructor(root, { solver, snap = () => true, forces = () => false }) {
    super();
    this.solver = solver;
    this.forces = forces;
    this.store = new Store();
    this.stage = new Stage(root);
    this.fall = new Fall(this.stage);
    this.controller = new Controller(this.store, this.stage, { snap, redraw: () => this.draw() });
    /** @type {any | null} the newest answer for the shown step */
    this.result = null;
    /** @type {Set<string>} */
    this.faulty = new Set();
    this.stale = true;
    this.scheduled = 0;
    /** The scene and step whose fall was shown last, because each fall is shown only once. */
    this.shown = "";
    this.fallLater = afterPause(350, () => this.fallOnce());
    this.store.addEventListener("scene", (event) => this.changed(/** @type {CustomEvent} */ (event).detail ?? {}));
    this.store.addEventListener("selection", () => this.draw());
    this.stage.resize();
    new ResizeObserver(() => this.resized()).observe(root);
  }

  /** Requests a drawing before the next frame of the screen. Several requests lead to a single drawing. */
  draw() {
    this.scheduled ||= requestAnimationFrame(() => {
      this.scheduled = 0;
      const { scene, resolved, frame, selected } = this.store;
      this.stage.draw({ scene, resolved, frame, selected, result: this.result, faulty: this.faulty, stale: this.stale, forces: this.forces() });
      this.controller.afterDrawing();
      this.dispatchEvent(new Event("drawn"));
    });
  }

  /** @param {{ fit?: boolean, from?: string }} detail */
  changed({ fit, from }) {
    this.fall.stop();
    // While a block is moved, the last answer stays visible until the next one arrives, so that nothing flickers.
    this.stale = from !== "drag" && from !== "edit";
    if (this.stale) this.result = null;
    const unseen = (from === "text" || from === "undo") && !this.stage.view.shows(bounds(this.store.resolved.bodies.flatMap((body) => body.outline)));
    if (fit || unseen) this.stage.fit(this.store.resolved);
    this.draw();
    this.solve();
  }

  /** Requests the verdict. While blocks are dragged, this happens as often as the worker can answer. */
  async solve() {
    const { store } = this;
    const reply = await this.solver.verdict(store.dragging ? JSON.stringify(store.scene) : store.text, store.frame);
    if (!reply) return;
    this.result = reply.value?.frames?.at(-1) ?? null;
    this.faulty = faultyBodies(reply.problems ?? []);
    this.stale = false;
    const words = inWords(reply, standing(store.resolved, store.frame).filter((body) => body.list === "blocks").length);
    this.dispatchEvent(new CustomEvent("answer", { detail: { reply, words } }));
    this.draw();
    this.fallLater();
  }

  /** Shows the motion of the blocks once when a structure begins to fall. */
  fallOnce() {
    const now = this.store.text + this.store.frame;
    if (this.store.dragging || this.stale || this.result?.verdict !== "unstable" || this.shown === now) return;
    this.shown = now;
    this.play();
  }

  play() {
    if (this.result) this.fall.play(this.result.mechanism, this.store.resolved, () => this.draw());
  }

  resized() {
    const before = this.stage.view.width;
    this.stage.resize();
    if (Math.abs(this.stage.view.width - before) > 1) this.stage.fit(this.store.resolved);
    this.draw();
  }
}
