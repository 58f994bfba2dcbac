// Converts a scene file to what the stage shows: outlines in metres, and for each step the placed, held and planned
// blocks. This module accepts incomplete scenes: while a user types, keys may be missing or have values of a wrong
// type.

import { bounds, centroid, turn, add, signedArea } from "./geometry.js";
import { builtIn, gridOf, outlineOfCells, toMetres } from "./lattice.js";

/** @typedef {import("./geometry.js").Point} Point */
/**
 * @typedef {object} Body
 * @property {"blocks" | "ground"} list the list in the scene that contains it
 * @property {number} index its number there, from 0
 * @property {string} key identifies the body, for example "blocks/3"
 * @property {string} id its name for other parts of the scene
 * @property {Point[]} outline corners in metres
 * @property {Point[][]} holes
 * @property {Point} centre its centroid
 * @property {import("./geometry.js").Box} box
 * @property {boolean} onLattice whether it consists of cells
 * @property {string | null} fill
 */
/** @typedef {{ robot: string, block: string, at: Point | null, step: number }} Hold */
/** @typedef {{ title: string, placed: Set<string>, holds: Hold[], planned: Set<string> }} Frame */
/** @typedef {{ bodies: Body[], frames: Frame[], byId: Map<string, Body> }} Resolved */

/** @param {any} value @returns {any[]} */
export const list = (value) => (Array.isArray(value) ? value : []);
/** @param {any} value @param {string} name */
const entry = (value, name) => (value && typeof value === "object" && Object.hasOwn(value, name) ? value[name] : undefined);
/** @param {any} p @returns {p is Point} */
export const isPoint = (p) => Array.isArray(p) && p.length === 2 && p.every((c) => typeof c === "number" && Number.isFinite(c));

/** The name of a block, as the library gives it. @param {any} block @param {number} index */
export const blockId = (block, index) => (typeof block?.id === "string" ? block.id : String(index + 1));
/** @param {any} robot @param {number} index */
export const robotId = (robot, index) => (typeof robot?.id === "string" ? robot.id : `r${index}`);

/** The largest numbers of parts that the stage shows, so that a harmful link cannot block the browser. The library gets the whole scene. */
const MOST_BODIES = 5000;
const MOST_PLACED = 1_000_000;

/** @param {any} scene @returns {Resolved} */
export function resolve(scene) {
  /** @type {Body[]} */
  const bodies = [];
  for (const kind of /** @type {const} */ (["ground", "blocks"])) {
    list(scene?.[kind]).slice(0, MOST_BODIES).forEach((entity, index) => {
      const body = resolveBody(scene, entity, kind, index);
      if (body) bodies.push(body);
    });
  }
  const byId = new Map(bodies.filter((b) => b.list === "blocks").map((b) => [b.id, b]));
  return { bodies, frames: framesOf(scene), byId };
}

/** @param {any} scene @param {any} entity @param {"blocks" | "ground"} kind @param {number} index @returns {Body | null} */
function resolveBody(scene, entity, kind, index) {
  const loops = outlineOf(scene, entity);
  if (!loops || loops[0].length < 3 || Math.abs(signedArea(loops[0])) < 1e-15) return null;
  const [outline, ...holes] = loops;
  const fill = entity.fill ?? entry(entry(scene.materials, entity.material), "fill");
  return {
    list: kind,
    index,
    key: `${kind}/${index}`,
    id: kind === "blocks" ? blockId(entity, index) : `ground ${index + 1}`,
    outline,
    holes,
    centre: centroid(outline),
    box: bounds(outline),
    onLattice: cellsOf(scene, entity) !== null,
    fill: typeof fill === "string" && /^#([0-9a-f]{3}|[0-9a-f]{6})$/i.test(fill) ? fill : null,
  };
}

/** Returns the object with the outline of a body: its shape if it names one, otherwise the body. Null if the shape does not exist. @param {any} scene @param {any} entity */
function shapeOf(scene, entity) {
  return typeof entity?.shape === "string" ? entry(scene?.shapes, entity.shape) ?? null : entity;
}

/** @param {any} scene @param {any} entity @returns {import("./lattice.js").Cell[] | null} */
export function cellsOf(scene, entity) {
  if (!gridOf(scene)) return null;
  const shape = shapeOf(scene, entity);
  if (Array.isArray(shape?.cells)) return shape.cells.filter((/** @type {any} */ c) => Array.isArray(c) && Number.isInteger(c[0]) && Number.isInteger(c[1])).slice(0, 5000);
  return shape === null ? builtIn(entity.shape) : null;
}

/** Outline and holes of a body in metres. @param {any} scene @param {any} entity @returns {Point[][] | null} */
export function outlineOf(scene, entity) {
  if (!entity || typeof entity !== "object") return null;
  const grid = gridOf(scene);
  const angle = typeof entity.angle === "number" ? entity.angle : 0;
  const given = isPoint(entity.at) ? entity.at : /** @type {Point} */ ([0, 0]);
  const at = grid ? toMetres(grid, given) : given;
  const cells = cellsOf(scene, entity);
  if (grid && cells) {
    if (cells.length === 0) return null;
    return outlineOfCells(grid, cells, angle).map((loop) => loop.map((node) => add(toMetres(grid, node), at)));
  }
  const shape = shapeOf(scene, entity);
  const loops = [shape?.polygon, ...list(shape?.holes)];
  if (!Array.isArray(loops[0])) return null;
  const radians = (angle * Math.PI) / 180;
  return loops.map((loop) => list(loop).filter(isPoint).map((p) => add(angle ? turn(p, radians) : p, at)));
}

/** Returns the placed, held and planned blocks of each step. @param {any} scene @returns {Frame[]} */
function framesOf(scene) {
  const robots = list(scene?.robots).map((robot, i) => ({ id: robotId(robot, i), at: isPoint(robot?.at) ? robot.at : null, holds: robot?.holds }));
  const everything = list(scene?.blocks).slice(0, MOST_BODIES).map(blockId);
  if (!Array.isArray(scene?.steps) || scene.steps.length === 0) {
    const holds = robots.filter((r) => typeof r.holds === "string").map((r) => ({ robot: r.id, block: r.holds, at: r.at, step: -1 }));
    return [{ title: "", placed: new Set(everything), holds, planned: new Set() }];
  }
  const placed = new Set();
  /** @type {Map<string, Hold>} */
  const holds = new Map();
  return scene.steps.slice(0, Math.ceil(MOST_PLACED / Math.max(1000, everything.length))).map((/** @type {any} */ step, /** @type {number} */ number) => {
    for (const robot of list(step?.release)) holds.delete(robot);
    for (const block of list(step?.remove)) placed.delete(block);
    for (const block of list(step?.place)) placed.add(block);
    for (const [robot, grip] of Object.entries(step?.hold ?? {})) {
      const block = typeof grip === "string" ? grip : /** @type {any} */ (grip)?.block;
      const own = robots.find((r) => r.id === robot);
      const at = isPoint(/** @type {any} */ (grip)?.at) ? /** @type {any} */ (grip).at : own?.holds === block ? own?.at ?? null : null;
      holds.set(robot, { robot, block, at, step: number });
    }
    const planned = new Set(Object.values(step?.plan ?? {}).map(String));
    return { title: typeof step?.title === "string" ? step.title : "", placed: new Set(placed), holds: [...holds.values()], planned };
  });
}

/** The bodies of one step: the ground, and the blocks that are placed. @param {Resolved} resolved @param {number} frame */
export function standing(resolved, frame) {
  const { placed } = resolved.frames[Math.min(frame, resolved.frames.length - 1)];
  return resolved.bodies.filter((b) => b.list === "ground" || placed.has(b.id));
}

/** The largest number of decimals that coordinates of the scene have, from 2 to 6. @param {Resolved} resolved @param {any} scene */
export function decimalsOf(resolved, scene) {
  let most = 2;
  const look = (/** @type {any} */ value) => {
    if (typeof value === "number") most = Math.max(most, (String(value).split(".")[1] ?? "").length);
    else if (Array.isArray(value)) value.forEach(look);
  };
  for (const body of resolved.bodies) {
    const entity = scene[body.list][body.index];
    look(entity.polygon);
    look(entity.at);
  }
  for (const shape of Object.values(scene?.shapes ?? {})) look(/** @type {any} */ (shape)?.polygon);
  return Math.min(6, most);
}
