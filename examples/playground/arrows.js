// Draws arrows on the stage for forces between blocks, missing forces and loads, and marks for the grips of robots.

import { add, dot, length, scale, subtract } from "./geometry.js";
import { legible, newtons, set, svg } from "./dom.js";
import { gravityOf } from "./edit.js";
import { isPoint, list } from "./scene.js";

/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("./stage.js").Picture} Picture */

/** The length of the longest arrow, as a fraction of the smaller side of the stage. */
const LONGEST = 0.17;
/** The minimum length of an arrow in pixels, so that users can see and drag it. */
const SHORTEST = 20;

/**
 * Path data of an arrow from tail to tip, in pixels.
 * @param {Point} tail @param {Point} tip @param {number} width of the shaft
 */
export function arrowPath(tail, tip, width) {
  const along = subtract(tip, tail);
  const size = length(along) || 1;
  /** @type {Point} */
  const u = scale(along, 1 / size);
  /** @type {Point} */
  const n = [-u[1], u[0]];
  const head = Math.min(size * 0.6, 3 + width * 2.6);
  const at = (/** @type {number} */ forward, /** @type {number} */ side) => add(add(tail, scale(u, forward)), scale(n, side)).map((c) => c.toFixed(1)).join(" ");
  const [w, wing] = [width / 2, head * 0.55];
  return `M${at(0, w)}L${at(size - head, w)}L${at(size - head, wing)}L${at(size, 0)}L${at(size - head, -wing)}L${at(size - head, -w)}L${at(0, -w)}Z`;
}

/** The vector that shows a force, in pixels with y down. @param {Point} force @param {number} factor pixels for a newton @returns {Point} */
function inPixels(force, factor) {
  const size = length(force) * factor;
  const stretch = size > 0 && size < SHORTEST ? SHORTEST / size : 1;
  return [force[0] * factor * stretch, -force[1] * factor * stretch];
}

/** @param {Stage} stage */
const longest = (stage) => LONGEST * Math.min(stage.view.width, stage.view.height);

/** Draws the forces between blocks, in the direction in which the weight is transferred to the ground. @param {Stage} stage @param {Picture} picture */
export function drawForces(stage, { scene, result, forces, stale }) {
  const layer = stage.layers.forces;
  if (!forces || !result || stale) return layer.replaceChildren();
  const shown = result.interfaces.filter((/** @type {any} */ i) => length(i.resultant.force) > 0);
  const most = Math.max(...shown.map((/** @type {any} */ i) => length(i.resultant.force)), 1e-300);
  const factor = longest(stage) / most;
  layer.replaceChildren(...shown.filter((/** @type {any} */ i) => length(i.resultant.force) > most * 0.01).map((/** @type {any} */ face) => {
    const at = stage.view.toPixels(face.resultant.at);
    const down = dot(face.resultant.force, gravityOf(scene)) < 0 ? -0.5 : 0.5;
    const half = scale(inPixels(face.resultant.force, factor), down);
    return svg("path", { class: "force", d: arrowPath(subtract(at, half), add(at, half), 2.5) });
  }));
}

/** Draws the missing forces if the structure falls. @param {Stage} stage @param {Picture} picture */
export function drawMissing(stage, { result, stale }) {
  const layer = stage.layers.missing;
  const failures = stale ? [] : list(result?.failures).filter((f) => isPoint(f.at));
  const most = Math.max(...failures.map((f) => (f.force ? length(f.force) : 0)), 1e-300);
  const factor = (0.6 * longest(stage)) / most;
  /** @type {Label[]} */
  const labels = [];
  const marks = failures.flatMap((failure) => {
    const at = stage.view.toPixels(failure.at);
    const point = svg("circle", { class: "missing", cx: at[0], cy: at[1], r: 4.5 });
    if (!failure.force) return [point];
    const force = inPixels(failure.force, factor);
    const pull = failure.kind === "tension";
    labels.push(labelNextTo(pull ? at : add(at, scale(force, 0.6)), force, failure.amount));
    // If a joint opens, the missing force would pull both blocks together. Otherwise, the missing force is drawn on the
    // first body.
    const arrows = pull ? [arrowPath(subtract(at, force), at, 4), arrowPath(add(at, force), at, 4)] : [arrowPath(at, add(at, force), 5)];
    return [...arrows.map((d) => svg("path", { class: "missing", d })), ...(pull ? [] : [point])];
  });
  layer.replaceChildren(...marks, ...legibleLabels(labels).map(({ x, y, text }) => svg("text", { class: "amount missing", x, y, dy: "0.35em" }, text)));
}

/** @typedef {{ x: number, y: number, width: number, text: string, amount: number }} Label centred at a point, in pixels */

/** At most this many amounts are written. */
const MOST_LABELS = 6;
/** Width of a character and height of a line, in pixels. */
const LETTER = { width: 7.5, height: 16 };

/** Returns the label of an amount next to an arrow, on its upper side. @param {Point} at @param {Point} force @param {number} amount @returns {Label} */
function labelNextTo(at, force, amount) {
  const text = newtons(amount);
  const width = LETTER.width * text.length;
  const size = length(force) || 1;
  const up = force[0] > 0 ? -1 : 1;
  const [nx, ny] = [(-force[1] / size) * up, (force[0] / size) * up];
  const distance = 9 + (Math.abs(nx) * width) / 2 + (Math.abs(ny) * LETTER.height) / 2;
  return { x: at[0] + nx * distance, y: at[1] + ny * distance, width, text, amount };
}

/** Returns the labels of the largest amounts that do not cover each other. @param {Label[]} labels */
function legibleLabels(labels) {
  /** @type {Label[]} */
  const kept = [];
  for (const label of labels.toSorted((a, b) => b.amount - a.amount)) {
    const free = kept.every((other) => Math.abs(other.x - label.x) > (other.width + label.width) / 2 || Math.abs(other.y - label.y) > LETTER.height);
    if (free && kept.length < MOST_LABELS) kept.push(label);
  }
  return kept;
}

/** The point at which a load acts. @param {any} load @param {import("./scene.js").Resolved} resolved @returns {Point | null} */
export function loadPoint(load, resolved) {
  return isPoint(load?.at) ? load.at : resolved.byId.get(load?.block)?.centre ?? null;
}

/** Draws the loads. Users drag the tail of an arrow to move the load, and its tip to change the force. @param {Stage} stage @param {Picture} picture */
export function drawLoads(stage, { scene, resolved, frame }) {
  const { placed } = resolved.frames[frame];
  const loads = list(scene?.loads).map((load, index) => ({ load, index, at: loadPoint(load, resolved) }));
  const shown = loads.filter(({ load, at }) => at && placed.has(load.block) && isPoint(load.force)).slice(0, 200);
  if (!stage.root.classList.contains("dragging")) {
    const most = Math.max(...shown.map(({ load }) => length(load.force)), 0);
    if (most > 0) stage.loadScale = longest(stage) / most / stage.view.zoom;
  }
  reuse(stage.layers.loads, shown, ({ load, index, at }, group) => {
    const tail = stage.view.toPixels(/** @type {Point} */ (at));
    const tip = add(tail, inPixels(load.force, stage.loadScale * stage.view.zoom));
    const [arrow, grip, end, label] = group.children;
    const amount = newtons(length(load.force));
    set(arrow, { class: "load", d: arrowPath(tail, tip, 5) });
    set(grip, { class: "handle load", cx: tail[0], cy: tail[1], r: 5.5, "data-handle": `load:${index}`, role: "button", tabindex: 0, "aria-label": `Load ${index + 1} on block ${legible(load.block)}: where it acts` });
    set(end, { class: "handle force-tip", cx: tip[0], cy: tip[1], r: 8, "data-handle": `force:${index}`, role: "button", tabindex: 0, "aria-label": `Load ${index + 1} on block ${legible(load.block)}: ${amount}, its size and direction` });
    set(label, { class: "amount load", x: tip[0], y: tip[1], dy: tip[1] < tail[1] - 4 ? -12 : 22 });
    if (label.textContent !== amount) label.textContent = amount;
  }, () => svg("g", {}, svg("path"), svg("circle"), svg("circle"), svg("text", { "aria-hidden": "true" })));
}

/** Draws the robots that hold a block. @param {Stage} stage @param {Picture} picture */
export function drawRobots(stage, { resolved, frame }) {
  const shown = resolved.frames[frame].holds.filter((hold) => resolved.byId.has(hold.block));
  reuse(stage.layers.robots, shown, (hold, group) => {
    const [x, y] = stage.view.toPixels(hold.at ?? /** @type {any} */ (resolved.byId.get(hold.block)).centre);
    const name = legible(hold.robot);
    set(group, { class: "robot handle", transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`, "data-handle": `grip:${hold.robot}`, role: "button", tabindex: 0, "aria-label": `Grip of robot ${name} on block ${legible(hold.block)}` });
    const text = /** @type {Element} */ (group.children[1]);
    const short = name.length > 4 ? [...name][0] : name;
    if (text.textContent !== short) text.textContent = short;
  }, () => svg("g", {}, svg("circle", { r: 13 }), svg("text", { dy: "0.35em", "aria-hidden": "true" })));
}

/**
 * Updates one element for each item, and reuses the elements of the last drawing. An element with the focus then does
 * not lose the focus.
 * @template T
 * @param {Element} layer @param {T[]} items @param {(item: T, element: Element) => void} update @param {() => Element} create
 */
function reuse(layer, items, update, create) {
  while (layer.childElementCount > items.length) layer.lastElementChild?.remove();
  items.forEach((item, i) => update(item, layer.children[i] ?? layer.appendChild(create())));
}
