// A slider for one number of the scene, such as the weight of the selected block or the place of a push. The bands on it
// show the values for which the step stands: the library changes only this number, and examines the scene.

import { html, legible, set, trim } from "./dom.js";
import { entityOf } from "./edit.js";
import { list } from "./scene.js";
import { roundStep } from "./snap.js";

/** @typedef {import("./store.js").Store} Store */
/** @typedef {{ label: string, path: (string | number)[], unit: string }} Numbered */
/** @typedef {{ state: string, from: number, to: number }} Interval */

/** The keys that are numbers, with their units. @type {[string, string][]} */
const KEYS = [["weight", ""], ["mass", " kg"], ["density", " kg/m³"], ["friction", ""], ["torque", ""]];
/** The keys that are pairs. @type {[string, string, string, string][]} */
const PAIRS = [["at", "place, x", "place, y", ""], ["force", "force to the right", "force upwards", ""]];

/**
 * The numbers of the selected body and of its loads; without a selection, those of all loads.
 * @param {any} scene @param {any | null} body @returns {Numbered[]}
 */
export function numbersOf(scene, body) {
  /** @type {Numbered[]} */
  const found = [];
  const add = (/** @type {string} */ name, /** @type {(string | number)[]} */ path, /** @type {any} */ entity) => {
    for (const [key, unit] of KEYS) if (typeof entity?.[key] === "number") found.push({ label: `${name}: ${key}`, path: [...path, key], unit });
    for (const [key, x, y, unit] of PAIRS) {
      if (!Array.isArray(entity?.[key]) || entity[key].length !== 2) continue;
      [x, y].forEach((label, axis) => typeof entity[key][axis] === "number" && found.push({ label: `${name}: ${label}`, path: [...path, key, axis], unit }));
    }
  };
  if (body) add(body.list === "ground" ? "Ground" : `Block ${legible(body.id)}`, [body.list, body.index], entityOf(scene, body));
  list(scene?.loads).forEach((load, index) => {
    if (!body || load?.block === body.id) add(`Push on ${legible(String(load?.block ?? index + 1))}`, ["loads", index], load);
  });
  return found;
}

/** The name of a number for the library: `loads[0].at[1]`. @param {(string | number)[]} path */
export const nameOf = (path) => path.map((part, at) => (typeof part === "number" ? `[${part}]` : at ? `.${part}` : part)).join("");

/** @param {any} scene @param {(string | number)[]} path */
export const valueAt = (scene, path) => path.reduce((value, part) => value?.[part], scene);

/** The ends of the slider for a number: as far to both sides as the number is large; amounts begin at 0. @param {Numbered} number @param {number} value @returns {[number, number]} */
export function rangeOf({ path }, value) {
  const reach = roundStep(Math.max(2 * Math.abs(value), 1));
  const isAmount = typeof path.at(-1) === "string" && path.at(-1) !== "torque";
  return isAmount ? [0, path.at(-1) === "friction" ? Math.max(1.2, value) : reach] : [roundTo(value - reach, reach), roundTo(value + reach, reach)];
}

/** @param {number} value @param {number} reach */
const roundTo = (value, reach) => Number((Math.round(value / reach * 100) * reach / 100).toPrecision(12));

/** The values for which it stands, in words. @param {Interval[]} intervals */
export function inWords(intervals) {
  const stands = intervals.filter((interval) => interval.state === "holds");
  if (stands.length === 0) return "stands at no value of this slider";
  if (stands.length === 1 && intervals.length === 1) return "stands at every value of this slider";
  return `stands from ${stands.map(({ from, to }) => `${trim(from)} to ${trim(to)}`).join(", and from ")}`;
}

export class NumberSlider {
  /** @param {HTMLElement} parent @param {Store} store @param {(name: string, range: [number, number]) => Promise<any>} ask */
  constructor(parent, store, ask) {
    [this.store, this.ask] = [store, ask];
    /** @type {Numbered[]} */
    this.numbers = [];
    /** The name of the number whose range is shown, and the range. */
    this.shown = "";
    /** @type {[number, number]} */
    this.range = [0, 1];
    this.select = html("select", { id: "number", "aria-describedby": "number-help" });
    this.input = html("input", { id: "slider-number", type: "range", "aria-label": "Value of the number", "aria-describedby": "slider-number-note" });
    this.output = html("output", { for: "slider-number" });
    this.bands = html("div", { class: "bands", "aria-hidden": "true" });
    this.note = html("p", { id: "slider-number-note", class: "note" });
    const help = html("p", { id: "number-help", class: "help" }, "A number of the selected block and its pushes, or of all pushes.");
    this.row = html("div", { class: "slider" }, html("label", { for: "number" }, "Any number"), this.output, this.select, html("div", { class: "track" }, this.bands, this.input), this.note, help);
    parent.append(this.row);
    this.select.addEventListener("change", () => { this.refresh(); this.find(); });
    this.input.addEventListener("input", () => {
      const number = this.number;
      if (number) this.store.edit(`number ${this.shown}`, (scene) => { valueAt(scene, number.path.slice(0, -1))[/** @type {string} */ (number.path.at(-1))] = Number(this.input.value); });
    });
  }

  get number() {
    return this.numbers[this.select.selectedIndex] ?? null;
  }

  /** Shows the numbers and the value of the scene. */
  refresh() {
    const { store } = this;
    const numbers = numbersOf(store.scene, store.body(store.selected));
    const names = (/** @type {Numbered[]} */ of) => of.map(({ path, label }) => nameOf(path) + label).join("\n");
    if (names(numbers) !== names(this.numbers)) {
      this.numbers = numbers;
      this.select.replaceChildren(...numbers.map(({ path, label }) => html("option", { value: nameOf(path) }, label)));
      const kept = numbers.findIndex(({ path }) => nameOf(path) === this.shown);
      this.select.selectedIndex = numbers.length ? Math.max(0, kept) : -1;
    }
    const number = this.number;
    const usable = number !== null && store.parses;
    set(this.row, { class: usable ? "slider" : "slider unused" });
    this.select.disabled = this.input.disabled = !usable;
    // Without a number there is nothing to show, and the figures below stay where they are.
    this.row.hidden = !number;
    if (!number) return this.mark([]);
    const [name, value] = [nameOf(number.path), valueAt(store.scene, number.path)];
    if (name !== this.shown || value < this.range[0] || value > this.range[1]) {
      [this.shown, this.range] = [name, rangeOf(number, value)];
      set(this.input, { min: this.range[0], max: this.range[1], step: roundStep((this.range[1] - this.range[0]) / 200) });
      this.mark([]);
    }
    if (Number(this.input.value) !== value) this.input.value = String(value);
    this.output.textContent = `${trim(value)}${number.unit}`;
  }

  /** Asks for which values it stands. */
  async find() {
    const number = this.number;
    if (!number || !this.store.parses) return this.mark([]);
    const name = this.shown;
    const reply = await this.ask(name, this.range);
    if (reply && this.shown === name) this.mark(reply.value ?? []);
  }

  /** @param {Interval[]} intervals */
  mark(intervals) {
    const [low, high] = this.range;
    const share = (/** @type {number} */ value) => (100 * (value - low)) / (high - low);
    this.bands.replaceChildren(...intervals.filter((interval) => interval.state === "holds").map(({ from, to }) => {
      const band = html("div", { class: "band" });
      [band.style.left, band.style.width] = [`${share(from)}%`, `${share(to) - share(from)}%`];
      return band;
    }));
    this.note.textContent = intervals.length ? inWords(intervals) : "";
    this.note.classList.toggle("never", intervals.length > 0 && !intervals.some((interval) => interval.state === "holds"));
  }
}
