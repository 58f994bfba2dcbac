// Handles pointer and keyboard on the stage: selecting, dragging, moving with arrow keys, deleting and turning.

import { add, length, scale, subtract } from "./geometry.js";
import { loadPoint } from "./arrows.js";
import { makeDraggable } from "./drag.js";
import * as edit from "./edit.js";
import { gridOf, toMetres } from "./lattice.js";
import { decimalsOf, standing } from "./scene.js";
import { snapMove, snapPoint } from "./snap.js";

/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {{ kind: string, name: string, index: number }} Handle */

/** Edges snap to each other if their distance is at most this many pixels. */
const REACH = 11;

/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class Controller {
  /**
   * @param {import("./store.js").Store} store
   * @param {import("./stage.js").Stage} stage
   * @param {{ snap: () => boolean, redraw: () => void }} page
   */
  constructor(store, stage, page) {
    this.store = store;
    this.stage = stage;
    this.page = page;
    /** @type {any} the scene at the beginning of a drag */
    this.base = null;
    /** @type {import("./scene.js").Resolved | null} */
    this.from = null;
    /** @type {Point} the latest displacement of the drag */
    this.last = [0, 0];
    /** @type {Point | null} where the view was when panning began */
    this.panFrom = null;
    /** @type {string | null} the body that gets the focus after the next drawing */
    this.wanted = null;
    const { root } = stage;
    this.stop = makeDraggable(root, {
      pick: (target, event) => this.pick(target, event),
      toWorld: (x, y) => this.toWorld(x, y),
      start: (handle) => this.start(handle),
      move: (handle, by, at, event) => this.move(handle, by, event.altKey),
      end: (handle, kept) => this.end(handle, kept),
      click: (handle) => this.click(handle),
    });
    root.addEventListener("keydown", (event) => this.key(event));
    root.addEventListener("focusin", (event) => this.focused(/** @type {Element} */ (event.target)));
    root.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  /** @param {number} x @param {number} y client coordinates @returns {Point} */
  toWorld(x, y) {
    const { left, top } = this.stage.root.getBoundingClientRect();
    return this.stage.view.toWorld([x - left, y - top]);
  }

  /** @param {Element} target @returns {Handle | null} */
  handleOf(target) {
    const text = target.closest("[data-handle]")?.getAttribute("data-handle");
    if (!text) return null;
    const [kind, name] = [text.slice(0, text.indexOf(":")), text.slice(text.indexOf(":") + 1)];
    return { kind, name, index: Number(name) };
  }

  /** @param {Element} target @param {PointerEvent} event @returns {Handle | null} */
  pick(target, event) {
    const handle = this.handleOf(target);
    if (handle) return handle;
    // A finger on the background scrolls the page; a mouse moves the picture.
    return event.pointerType === "mouse" ? { kind: "view", name: "", index: 0 } : null;
  }

  /** @param {Handle | null} handle */
  click(handle) {
    if (handle?.kind === "body") this.store.select(handle.name);
    else if (!handle || handle.kind === "view") this.store.select(null);
  }

  /** @param {Element} target */
  focused(target) {
    const handle = this.handleOf(target);
    if (handle?.kind === "body") this.store.select(handle.name);
  }

  /** @param {Handle} handle */
  start(handle) {
    this.stage.root.classList.add("dragging");
    if (handle.kind === "view") return void (this.panFrom = this.stage.view.centre);
    this.from = this.store.resolved;
    this.base = this.store.beginDrag();
    this.last = [0, 0];
    if (handle.kind === "body") this.store.select(handle.name);
  }

  /** @param {Handle} handle @param {Point} by metres @param {boolean} free without snapping */
  move(handle, by, free) {
    if (handle.kind === "view") {
      const { view } = this.stage;
      // Move the view so that the point at which the drag began is under the pointer again.
      view.centre = subtract(view.centre, by);
      return this.page.redraw();
    }
    if (this.store.parses) this.store.drag(this.base, (scene) => this.change(scene, handle, by, !free && this.page.snap()));
  }

  /** @param {Handle} handle @param {boolean} kept */
  end(handle, kept) {
    this.stage.root.classList.remove("dragging");
    if (handle.kind === "view") return;
    this.store.endDrag(kept);
    this.base = this.from = null;
  }

  /** Returns the body with this corner, which is the selected body. @param {Handle} handle @param {import("./scene.js").Resolved} from */
  bodyOf(handle, from) {
    const key = handle.kind === "body" ? handle.name : this.store.selected;
    return from.bodies.find((body) => body.key === key) ?? null;
  }

  /**
   * Changes a scene according to a handle that was moved.
   * @param {any} scene @param {Handle} handle @param {Point} by metres since the state `this.from` @param {boolean} snap
   */
  change(scene, handle, by, snap) {
    const from = this.from ?? this.store.resolved;
    const body = this.bodyOf(handle, from);
    const decimals = Math.max(3, decimalsOf(from, scene));
    const reach = REACH / this.stage.view.zoom;
    const grid = snap && !gridOf(scene) ? this.stage.gridStep(scene) / 2 : 0;
    const toPoint = (/** @type {Point} */ p, /** @type {Point[]} */ corners) => (snap ? snapPoint(add(p, by), corners, { reach, grid }) : add(p, by));
    if (handle.kind === "body" && body) {
      const others = standing(from, this.store.frame).filter((other) => other.key !== body.key);
      const move = snap && !body.onLattice ? snapMove(body, by, others, { reach, grid, decimals, last: this.last }) : by;
      this.last = move;
      edit.moveBody(scene, body, move, decimals);
    } else if (handle.kind === "corner" && body) {
      const corners = standing(from, this.store.frame).filter((other) => other.key !== body.key).flatMap((other) => other.outline);
      edit.moveCorner(scene, body, handle.index, toPoint(body.outline[handle.index], corners), decimals);
    } else if (handle.kind === "edge" && body) {
      const [a, b] = [body.outline[handle.index], body.outline[(handle.index + 1) % body.outline.length]];
      edit.addCorner(scene, body, handle.index, toPoint(scale(add(a, b), 0.5), []), decimals);
    } else if (handle.kind === "load") {
      const block = from.byId.get(scene.loads[handle.index].block);
      const at = loadPoint(scene.loads[handle.index], from);
      if (at) edit.moveLoad(scene, handle.index, toPoint(at, block ? [...block.outline, block.centre] : []), decimals);
    } else if (handle.kind === "force") {
      const force = add(scene.loads[handle.index].force, scale(by, 1 / this.stage.loadScale));
      edit.setForce(scene, handle.index, snap ? upright(force) : force);
    } else if (handle.kind === "grip") {
      const hold = from.frames[this.store.frame].holds.find((h) => h.robot === handle.name);
      const block = hold && from.byId.get(hold.block);
      if (hold && block) edit.moveGrip(scene, hold, toPoint(hold.at ?? block.centre, [block.centre]), decimals);
    }
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const handle = this.handleOf(/** @type {Element} */ (event.target));
    if (event.ctrlKey || event.metaKey || !handle) return;
    const arrow = ARROWS[event.key];
    if (arrow) this.nudge(handle, arrow, event);
    else if (event.key === "Delete" || event.key === "Backspace") this.remove(handle);
    else if (event.key === "PageDown" || event.key === "PageUp") this.next(event.key === "PageDown" ? 1 : -1);
    else if (event.key === "r" || event.key === "R") this.turn(event.shiftKey ? -1 : 1);
    else if (event.key === "Escape") this.store.select(null);
    else if (event.key === "Enter" || event.key === " ") this.click(handle);
    else return;
    event.preventDefault();
  }

  /** @param {Handle} handle @param {[number, number]} arrow @param {KeyboardEvent} event */
  nudge(handle, arrow, event) {
    const grid = gridOf(this.store.scene);
    const body = this.bodyOf(handle, this.store.resolved);
    const pixel = 1 / this.stage.view.zoom;
    const step = event.shiftKey ? this.stage.gridStep(this.store.scene) : this.stage.gridStep(this.store.scene) / (event.altKey ? 20 : 4);
    /** @type {Point} */
    let by = scale(arrow, handle.kind === "force" ? (event.shiftKey ? 20 : 4) * pixel : step);
    if (grid && body?.onLattice && handle.kind === "body") by = toMetres(grid, arrow);
    this.store.edit(`move ${handle.kind} ${handle.name}`, (scene) => this.change(scene, handle, by, false));
  }

  /** @param {Handle} handle */
  remove(handle) {
    const body = this.bodyOf(handle, this.store.resolved);
    const decimals = decimalsOf(this.store.resolved, this.store.scene);
    if (handle.kind === "corner" && body) this.store.edit("", (scene) => edit.removeCorner(scene, body, handle.index, decimals));
    else if (handle.kind === "load" || handle.kind === "force") this.store.edit("", (scene) => edit.removeLoad(scene, handle.index));
    else if (handle.kind === "grip") this.release(handle.name);
    else if (body) this.removeBody(body);
  }

  /** @param {import("./scene.js").Body} body */
  removeBody(body) {
    const focused = this.stage.root.contains(document.activeElement);
    this.store.edit("", (scene) => edit.removeBody(scene, body));
    this.store.select(null);
    // The element with the focus was removed. The block that is now at its position in the list gets the focus.
    const left = standing(this.store.resolved, this.store.frame).filter((b) => b.list === body.list);
    const next = left.find((b) => b.index >= body.index) ?? left.at(-1);
    if (focused && next) this.focus(next.key);
  }

  /** @param {string} robot */
  release(robot) {
    const { frame, current } = this.store;
    const holds = current.holds.filter((hold) => hold.robot === robot);
    if (holds[0]) this.store.edit("", (scene) => edit.toggleHold(scene, holds[0].block, frame, holds));
  }

  /** Selects another body. @param {1 | -1} step */
  next(step) {
    const keys = standing(this.store.resolved, this.store.frame).filter((b) => b.list === "blocks").map((body) => body.key);
    const now = keys.indexOf(this.store.selected ?? "");
    const key = keys[(now + step + keys.length) % keys.length];
    this.store.select(key);
    this.focus(key);
  }

  /** Gives a body the focus after it has been drawn. @param {string} key */
  focus(key) {
    this.wanted = key;
    this.page.redraw();
  }

  /** Gives the focus to the requested body, which may have to be drawn first. */
  afterDrawing() {
    if (this.wanted === null) return;
    this.stage.drawn.get(this.wanted)?.group.focus({ preventScroll: true });
    this.wanted = null;
  }

  /** Turns the selected body. @param {1 | -1} sense anticlockwise is 1 */
  turn(sense) {
    const body = this.store.body(this.store.selected);
    const decimals = decimalsOf(this.store.resolved, this.store.scene);
    if (body) this.store.edit(`turn ${body.key}`, (scene) => edit.turnBody(scene, body, 5 * sense, decimals));
  }

  /** @param {WheelEvent} event */
  wheel(event) {
    // Without Ctrl the wheel scrolls the page, as on other pages.
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const { left, top } = this.stage.root.getBoundingClientRect();
    this.stage.view.zoomBy(Math.exp(-event.deltaY / 300), [event.clientX - left, event.clientY - top]);
    this.page.redraw();
  }
}

/** Makes a force that is almost vertical or horizontal exactly vertical or horizontal. @param {Point} force @returns {Point} */
function upright(force) {
  const size = length(force);
  if (Math.abs(force[0]) < 0.06 * size) return [0, force[1]];
  if (Math.abs(force[1]) < 0.06 * size) return [force[0], 0];
  return force;
}
