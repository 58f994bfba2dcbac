// Handles the buttons above the stage: add, hold, load, turn, delete, zoom.

import { byId, html } from "./dom.js";
import { bounds, centroid, signedArea } from "./geometry.js";
import { addBlock, addLoad, gravityOf, toggleHold } from "./edit.js";
import { gridOf } from "./lattice.js";
import { OutlineTool } from "./outline-tool.js";
import { decimalsOf, standing } from "./scene.js";
import { choices, shapeAt } from "./shapes.js";
import { snapPoint } from "./snap.js";

/** @typedef {import("./geometry.js").Point} Point */

export class Toolbar {
  /**
   * @param {import("./store.js").Store} store
   * @param {import("./stage.js").Stage} stage
   * @param {import("./controller.js").Controller} controller
   * @param {{ say: (text: string) => void, snap: () => boolean, redraw: () => void }} page
   */
  constructor(store, stage, controller, page) {
    this.store = store;
    this.stage = stage;
    this.controller = controller;
    this.page = page;
    this.tool = new OutlineTool(stage, {
      toWorld: (x, y) => controller.toWorld(x, y),
      snap: (p) => this.snapped(p),
      step: () => stage.gridStep(store.scene) / 2,
      say: page.say,
      done: (polygon) => this.drawn(polygon),
    });
    /** @type {HTMLSelectElement} */
    this.shape = byId("shape");
    const on = (/** @type {string} */ id, /** @type {() => void} */ action) => byId(id).addEventListener("click", action);
    on("add", () => this.add());
    on("draw", () => (this.tool.active ? this.tool.finish(true) : this.tool.start()));
    on("hold", () => this.hold());
    on("load", () => this.load());
    on("turn-left", () => controller.turn(1));
    on("turn-right", () => controller.turn(-1));
    on("delete", () => this.remove());
    on("zoom-in", () => this.zoom(1.25));
    on("zoom-out", () => this.zoom(0.8));
    on("fit", () => { stage.fit(store.resolved); page.redraw(); });
  }

  /** Updates the list of shapes and the buttons for the selected block. */
  refresh() {
    const all = choices(this.store.scene);
    const ids = all.map(({ id }) => id).join();
    if (this.shape.dataset.ids !== ids) {
      this.shape.dataset.ids = ids;
      this.shape.replaceChildren(...all.map(({ id, label }) => html("option", { value: id }, label)));
    }
    const body = this.store.body(this.store.selected);
    const block = body?.list === "blocks" ? body : null;
    const held = block !== null && this.store.current.holds.some((hold) => hold.block === block.id);
    for (const id of ["hold", "load"]) byId(id).disabled = !block || !this.store.parses;
    for (const id of ["turn-left", "turn-right", "delete"]) byId(id).disabled = !body || !this.store.parses;
    for (const id of ["add", "draw", "shape"]) byId(id).disabled = !this.store.parses;
    byId("hold").setAttribute("aria-pressed", String(held));
    byId("hold").querySelector("span").textContent = held ? "Let go" : "Hold";
    byId("draw").setAttribute("aria-pressed", String(this.tool.active));
  }

  get decimals() {
    return Math.max(3, decimalsOf(this.store.resolved, this.store.scene));
  }

  /** The median size of the blocks, which a new block gets. */
  size() {
    const sides = this.store.resolved.bodies.filter((b) => b.list === "blocks").map(({ outline }) => Math.sqrt(Math.abs(signedArea(outline)))).sort((a, b) => a - b);
    return sides[Math.floor(sides.length / 2)] ?? 60 / this.stage.view.zoom;
  }

  add() {
    const { store, stage } = this;
    const choice = choices(store.scene).find(({ id }) => id === this.shape.value) ?? choices(store.scene)[0];
    // Place the new block above the highest body, where it overlaps nothing. The user then drags it to its place.
    const size = this.size();
    const grid = gridOf(store.scene);
    const top = standing(store.resolved, store.frame).reduce((/** @type {import("./scene.js").Body | null} */ best, body) => (!best || body.box.top > best.box.top ? body : best), null);
    /** @type {Point} */
    const at = top ? [top.centre[0], top.box.top + (grid ? 1.35 * grid.side : 0)] : [0, 0];
    const block = shapeAt(store.scene, choice, at, size * (choice.id === "rectangle" ? 0.75 : 1), this.decimals);
    this.insert(block);
    if (!stage.view.shows(bounds(store.resolved.bodies.flatMap((b) => b.outline)))) stage.fit(store.resolved);
    this.page.redraw();
  }

  /** @param {any} block */
  insert(block) {
    const { store } = this;
    let id = "";
    store.edit("", (scene) => { id = addBlock(scene, block, store.frame); });
    const body = store.resolved.byId.get(id);
    if (!body) return;
    store.select(body.key);
    this.controller.focus(body.key);
    this.page.say(`Block ${id} added and selected. Drag it, or move it with the arrow keys.`);
  }

  /** @param {Point} p @returns {Point} */
  snapped(p) {
    if (!this.page.snap()) return p;
    const corners = standing(this.store.resolved, this.store.frame).flatMap((body) => body.outline);
    const grid = gridOf(this.store.scene) ? 0 : this.stage.gridStep(this.store.scene) / 2;
    return snapPoint(p, [...corners, ...this.tool.corners.slice(0, 1)], { reach: 10 / this.stage.view.zoom, grid });
  }

  /** @param {Point[] | null} polygon */
  drawn(polygon) {
    if (polygon && Math.abs(signedArea(polygon)) > 0) {
      const decimals = this.decimals;
      this.insert({ polygon: polygon.map(([x, y]) => [Number(x.toFixed(decimals)), Number(y.toFixed(decimals))]) });
    } else this.page.say("No block was drawn.");
    this.refresh();
  }

  hold() {
    const { store } = this;
    const body = store.body(store.selected);
    if (body) store.edit("", (scene) => toggleHold(scene, body.id, store.frame, store.current.holds));
  }

  /** Adds a horizontal load at the centroid of the selected block, of about a quarter of its weight. */
  load() {
    const { store } = this;
    const body = store.body(store.selected);
    if (!body) return;
    const { scene } = store;
    const weight = Math.abs(signedArea(body.outline)) * (scene.thickness ?? 1) * (scene.blocks[body.index].density ?? scene.density ?? 1) * Math.hypot(...gravityOf(scene));
    const given = scene.blocks[body.index].weight ?? weight;
    const force = Number((0.25 * (given || 1)).toPrecision(2));
    const at = centroid(body.outline).map((c) => Number(c.toFixed(this.decimals)));
    store.edit("", (changed) => addLoad(changed, { block: body.id, force: [force, 0], at }));
  }

  remove() {
    const body = this.store.body(this.store.selected);
    if (!body) return;
    this.controller.removeBody(body);
    this.page.say(`${body.list === "blocks" ? "Block" : "Ground"} deleted.`);
  }

  /** @param {number} factor */
  zoom(factor) {
    this.stage.view.zoomBy(factor);
    this.page.redraw();
  }
}
