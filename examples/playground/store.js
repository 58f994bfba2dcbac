// The document: the text of the scene, the parsed scene, the current step, the selection, and the changes that can be
// undone. The text defines the scene. A change on the stage changes the parsed scene and writes the text again. A
// change of the text replaces the parsed scene. All parts that show the scene listen to the events of the document.

import { formatScene } from "./format.js";
import { list, resolve } from "./scene.js";

/** The largest number of changes that can be undone. */
const DEPTH = 200;
/** Changes with the same label within this many milliseconds are undone together, such as those of a held arrow key. */
const TOGETHER = 900;

/**
 * Replaces characters that change the direction of text by escapes such as \u202e. The scene stays the same, and its
 * text cannot be displayed in a misleading order.
 * @param {string} text
 */
const visible = (text) => text.replace(/[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]/g, (c) => `\\u${c.charCodeAt(0).toString(16).padStart(4, "0")}`);

/** @typedef {{ text: string, frame: number, factor: number, loads: any[] }} Entry */

export class Store extends EventTarget {
  constructor() {
    super();
    this.text = "";
    /** @type {any} */
    this.scene = {};
    this.resolved = resolve({});
    this.frame = 0;
    /** @type {string | null} key of the selected body */
    this.selected = null;
    /** Whether the text can be parsed. If not, the stage shows the last scene that could be parsed. */
    this.parses = true;
    /** The factor on the loads. The loads at factor 1 are stored, so that they are not lost at factor 0. */
    this.factor = 1;
    /** @type {any[]} */
    this.loads = [];
    /** @type {Entry[]} */
    this.past = [];
    /** @type {Entry[]} */
    this.future = [];
    this.last = { label: "", at: 0 };
    /** Whether the user is dragging. The text is updated at the end of a drag. */
    this.dragging = false;
  }

  /** @param {"scene" | "selection" | "history"} type @param {any} [detail] */
  emit(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }

  /** Shows another scene. Undo brings back the previous scene. @param {string} text */
  open(text) {
    if (this.text) this.remember("");
    this.frame = 0;
    this.selected = null;
    this.setText(visible(text));
    this.frame = Math.max(0, this.resolved.frames.length - 1);
    this.emit("scene", { fit: true, from: "open" });
    this.emit("selection");
  }

  /** @param {string} text */
  setText(text) {
    this.text = text;
    try {
      const scene = JSON.parse(text);
      this.parses = scene !== null && typeof scene === "object" && !Array.isArray(scene);
      if (this.parses) this.take(scene);
    } catch {
      // The user is typing: the stage keeps the last scene, and the solver reports the problem with its line.
      this.parses = false;
    }
    this.resetLoads();
  }

  /** Sets the text that the user typed. @param {string} text */
  type(text) {
    if (text === this.text) return;
    this.remember("type");
    this.setText(text);
    this.emit("scene", { from: "text" });
  }

  /** @param {any} scene */
  take(scene) {
    this.scene = scene;
    this.resolved = resolve(scene);
    this.frame = Math.min(this.frame, this.resolved.frames.length - 1);
    if (this.selected && !this.body(this.selected)) this.selected = null;
  }

  resetLoads() {
    this.factor = 1;
    this.loads = structuredClone(list(this.scene?.loads));
  }

  /** @param {string | null} key */
  body(key) {
    return this.resolved.bodies.find((body) => body.key === key) ?? null;
  }

  /** The step that is shown. */
  get current() {
    return this.resolved.frames[this.frame];
  }

  /**
   * Changes the scene. If the text cannot be parsed, nothing is changed.
   * @param {string} label changes with the same label in quick succession are undone together
   * @param {(scene: any) => void} change
   */
  edit(label, change) {
    if (!this.parses) return;
    this.remember(label);
    this.apply(structuredClone(this.scene), change);
  }

  /** @param {any} scene @param {(scene: any) => void} change */
  apply(scene, change) {
    const loads = JSON.stringify(scene.loads);
    change(scene);
    this.take(scene);
    if (JSON.stringify(scene.loads) !== loads) this.resetLoads();
    if (!this.dragging) this.text = visible(formatScene(scene));
    this.emit("scene", { from: this.dragging ? "drag" : "edit" });
  }

  /** Begins a drag. Each move of a drag starts from the same scene. @returns {any} that scene */
  beginDrag() {
    this.remember("");
    this.dragging = true;
    return this.scene;
  }

  /** One move of a drag. @param {any} base what `beginDrag` returned @param {(scene: any) => void} change */
  drag(base, change) {
    this.apply(structuredClone(base), change);
  }

  /** @param {boolean} keep whether the change is kept */
  endDrag(keep) {
    this.dragging = false;
    const before = /** @type {Entry} */ (this.past.at(-1));
    if (!keep) return this.restore(/** @type {Entry} */ (this.past.pop()));
    this.text = visible(formatScene(this.scene));
    if (this.text === before.text) this.past.pop();
    this.emit("scene", { from: "edit" });
    this.emit("history");
  }

  /** Multiplies the loads by a factor. @param {number} factor */
  setFactor(factor) {
    if (!this.parses) return;
    this.remember("factor");
    const [loads, scene] = [this.loads, structuredClone(this.scene)];
    scene.loads = loads.map((load) => ({
      ...load,
      ...(load.force ? { force: load.force.map((/** @type {number} */ f) => Number((f * factor).toPrecision(6))) } : {}),
      ...(load.torque ? { torque: Number((load.torque * factor).toPrecision(6)) } : {}),
    }));
    this.take(scene);
    this.text = visible(formatScene(scene));
    [this.factor, this.loads] = [factor, loads];
    this.emit("scene", { from: "edit" });
  }

  /** @param {string} label a change with the label "" is always undone separately */
  remember(label) {
    const now = performance.now();
    const same = label !== "" && label === this.last.label && now - this.last.at < TOGETHER;
    this.last = { label, at: now };
    if (same) return;
    this.past.push(this.entry());
    if (this.past.length > DEPTH) this.past.shift();
    this.future = [];
    this.emit("history");
  }

  /** @returns {Entry} */
  entry() {
    return { text: this.text, frame: this.frame, factor: this.factor, loads: this.loads };
  }

  undo() {
    const entry = this.dragging ? null : this.past.pop();
    if (!entry) return;
    this.future.push(this.entry());
    this.restore(entry);
  }

  redo() {
    const entry = this.dragging ? null : this.future.pop();
    if (!entry) return;
    this.past.push(this.entry());
    this.restore(entry);
  }

  /** @param {Entry} entry */
  restore(entry) {
    this.frame = entry.frame;
    this.setText(entry.text);
    [this.factor, this.loads] = [entry.factor, entry.loads];
    this.last.label = "";
    this.emit("scene", { from: "undo" });
    this.emit("selection");
    this.emit("history");
  }

  /** @param {string | null} key */
  select(key) {
    if (key === this.selected) return;
    this.selected = key;
    this.emit("selection");
  }

  /** @param {number} frame */
  showFrame(frame) {
    this.frame = Math.max(0, Math.min(this.resolved.frames.length - 1, frame));
    this.emit("scene", { from: "frame" });
  }
}
