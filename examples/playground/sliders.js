// Sliders for friction, tilt, kernel and loads. A band on each slider shows the values for which the structure
// stands: the margin that the library computes if all other values stay the same.

import { html, trim } from "./dom.js";
import { setFriction, setTilt, tiltOf } from "./edit.js";
import { list } from "./scene.js";
import { roundStep } from "./snap.js";

/** @typedef {[number | null, number | null] | null | "withheld" | undefined} Interval */
/**
 * @typedef {object} Parameter
 * @property {string} id
 * @property {string} label
 * @property {string} help
 * @property {number} low @property {number} high @property {number} step @property {string} unit
 * @property {(store: Store) => number} read
 * @property {(store: Store, value: number) => void} write
 * @property {(intervals: any, store: Store) => Interval} interval in values of the slider
 * @property {(store: Store) => boolean} [usable]
 */
/** @typedef {import("./store.js").Store} Store */

/** @type {Parameter[]} */
const PARAMETERS = [
  {
    id: "friction", label: "Friction", help: "How rough the joints are: 0 is ice, 0.7 is stone on stone.", low: 0, high: 1.2, step: 0.01, unit: "",
    read: ({ scene }) => (typeof scene.friction === "number" ? scene.friction : 0.7),
    write: (store, value) => store.edit("friction", (scene) => setFriction(scene, value)),
    interval: (intervals) => intervals.friction,
  },
  {
    id: "tilt", label: "Tilt", help: "Turns gravity, as if the ground were tilted.", low: -45, high: 45, step: 0.5, unit: "°",
    read: ({ scene }) => tiltOf(scene),
    write: (store, value) => store.edit("tilt", (scene) => setTilt(scene, value)),
    // The library gives the tilt relative to the current direction of gravity.
    interval: ({ tilt }, { scene }) => (Array.isArray(tilt) ? /** @type {Interval} */ (tilt.map((end) => (end === null ? null : end + tiltOf(scene)))) : tilt),
  },
  {
    id: "kernel", label: "Safety kernel", help: "Forces keep away from the ends of a joint: 0 uses all of it, 1 only its middle.", low: 0, high: 1, step: 0.01, unit: "",
    read: ({ scene }) => (typeof scene.kernel === "number" ? scene.kernel : 0),
    write: (store, value) => store.edit("kernel", (scene) => { scene.kernel = value; }),
    interval: (intervals) => intervals.kernel,
  },
  {
    id: "load", label: "Loads", help: "Multiplies all loads. Select a block and press Push to add one.", low: 0, high: 5, step: 0.05, unit: "×",
    read: (store) => store.factor,
    write: (store, value) => store.setFactor(value),
    interval: ({ load_factor: interval }, { factor }) => (Array.isArray(interval) && factor > 0 ? /** @type {Interval} */ (interval.map((end) => (end === null ? null : end * factor))) : interval),
    usable: ({ loads }) => list(loads).length > 0,
  },
];

export class Sliders {
  /** @param {HTMLElement} parent @param {Store} store */
  constructor(parent, store) {
    this.store = store;
    this.rows = PARAMETERS.map((parameter) => this.row(parent, parameter));
  }

  /** @param {HTMLElement} parent @param {Parameter} parameter */
  row(parent, parameter) {
    const id = `slider-${parameter.id}`;
    const input = html("input", { id, type: "range", min: parameter.low, max: parameter.high, step: parameter.step, "aria-describedby": `${id}-note ${id}-help` });
    const output = html("output", { for: id });
    const band = html("div", { class: "band" });
    const note = html("p", { id: `${id}-note`, class: "note" });
    const help = html("p", { id: `${id}-help`, class: "help" }, parameter.help);
    const track = html("div", { class: "track" }, html("div", { class: "bands", "aria-hidden": "true" }, band), input);
    const row = html("div", { class: "slider" }, html("label", { for: id }, parameter.label), output, track, note, help);
    input.addEventListener("input", () => parameter.write(this.store, Number(input.value)));
    parent.append(row);
    return { parameter, row, input, output, band, note, interval: /** @type {Interval} */ (undefined) };
  }

  /** Shows the values of the scene. */
  refresh() {
    for (const entry of this.rows) {
      const { parameter, input, output } = entry;
      const usable = parameter.usable?.(this.store) ?? true;
      const value = parameter.read(this.store);
      // If the value is outside the range of the slider, extend the range.
      input.max = String(Math.max(Number(input.max), value));
      input.min = String(Math.min(parameter.low, value));
      if (Number(input.value) !== value) input.value = String(value);
      input.disabled = !usable || !this.store.parses;
      entry.row.classList.toggle("unused", !usable);
      output.textContent = usable ? (value === 0 ? `0${parameter.unit}` : amount(value, parameter.unit)) : "–";
      this.mark(entry);
    }
  }

  /** @param {any | null} margins those of the library, or null while they are unknown */
  showMargins(margins) {
    for (const entry of this.rows) {
      // At load factor 0, the library gets no loads and finds no interval of the factor. Keep the last interval.
      if (entry.parameter.id === "load" && this.store.factor === 0 && margins) continue;
      entry.interval = margins ? entry.parameter.interval(margins.intervals ?? {}, this.store) : undefined;
      this.stretch(entry);
      this.mark(entry);
    }
  }

  /** Extends the range of a slider to include the limit, unless the user is moving the slider. @param {Sliders["rows"][number]} entry */
  stretch({ parameter, input, interval }) {
    const end = Array.isArray(interval) ? interval[1] : null;
    if (parameter.id !== "load" || document.activeElement === input) return;
    const high = end === null || end < parameter.high ? parameter.high : roundStep(1.3 * end);
    input.max = String(Math.max(high, Number(input.value)));
    input.step = String(high / 100);
  }

  /** @param {Sliders["rows"][number]} entry */
  mark({ parameter, input, band, note, interval }) {
    const usable = parameter.usable?.(this.store) ?? true;
    const known = usable && Array.isArray(interval);
    band.hidden = !known;
    note.textContent = usable ? words(interval, parameter) : "";
    note.classList.toggle("never", interval === null);
    if (!known) return;
    const [low, high] = /** @type {[number | null, number | null]} */ (interval);
    const share = (/** @type {number} */ value) => Math.min(1, Math.max(0, (value - Number(input.min)) / (Number(input.max) - Number(input.min))));
    const [left, right] = [low === null ? 0 : share(low), high === null ? 1 : share(high)];
    band.style.left = `${100 * left}%`;
    band.style.width = `${100 * Math.max(0, right - left)}%`;
  }
}

/** Formats a value. An angle gets the word left or right. @param {number} value @param {string} unit */
const amount = (value, unit) => (unit === "°" ? `${trim(Math.abs(value))}° ${value < 0 ? "left" : "right"}` : `${trim(value)}${unit}`);

/** @param {Interval} interval @param {Parameter} parameter */
function words(interval, { unit, low: least }) {
  if (interval === null) return "stands at no value";
  if (!Array.isArray(interval)) return "";
  const [low, high] = interval;
  const from = low === null || (low <= least && least >= 0) ? null : amount(low, unit);
  const to = high === null ? null : amount(high, unit);
  if (from && to) return `stands from ${from} to ${to}`;
  if (from) return `stands from ${from}`;
  if (to) return `stands up to ${to}`;
  return "stands at every value";
}
