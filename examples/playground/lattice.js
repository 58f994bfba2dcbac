// The two lattices of a scene file: the positions of nodes, the cells of the built-in shapes, and the outline of
// cells. The numbers are those of src/mechanics/scene/shape.rs and src/geometry/lattice.rs.

import { signedArea } from "./geometry.js";

/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {{ kind: "triangular" | "square", side: number }} Grid */
/** @typedef {[number, number, string?]} Cell */

const ROW = Math.sqrt(3) / 2;

/** @type {Record<string, Cell[]>} */
const BUILT_IN = {
  up: [[0, 0, "up"]],
  down: [[0, 0, "down"]],
  hexagon: [[0, 0, "up"], [-1, 1, "down"], [-1, 0, "up"], [-1, 0, "down"], [0, -1, "up"], [0, 0, "down"]],
  linkh: [[-1, 1, "down"], [0, 0, "up"], [0, 1, "down"], [0, -1, "up"], [0, 0, "down"], [1, -1, "up"]],
  linkr: [[-1, 0, "up"], [-1, 1, "down"], [-1, 1, "up"], [0, 0, "down"], [0, 0, "up"], [0, 1, "down"]],
  linkl: [[0, 0, "up"], [-1, 1, "down"], [-1, 1, "up"], [-1, 0, "down"], [-1, 0, "up"], [-2, 1, "down"]],
};

/** The names of the built-in shapes of the triangular lattice. */
export const BUILT_IN_NAMES = Object.keys(BUILT_IN);

/** @param {string} name @returns {Cell[] | null} */
export const builtIn = (name) => (Object.hasOwn(BUILT_IN, name) ? BUILT_IN[name] : null);

/** The grid of the scene with its default values, or null if there is no grid. @param {any} scene @returns {Grid | null} */
export function gridOf(scene) {
  const grid = scene?.grid;
  if (!grid || (grid.kind !== "triangular" && grid.kind !== "square")) return null;
  return { kind: grid.kind, side: typeof grid.side === "number" && grid.side > 0 ? grid.side : 1 };
}

/** A lattice point in metres. @param {Grid} grid @param {Point} node @returns {Point} */
export function toMetres(grid, [x, y]) {
  return grid.kind === "square" ? [grid.side * x, grid.side * y] : [grid.side * (x + y / 2), grid.side * y * ROW];
}

/** Converts a point in metres to lattice coordinates, without rounding. @param {Grid} grid @param {Point} point @returns {Point} */
export function toLattice(grid, [x, y]) {
  if (grid.kind === "square") return [x / grid.side, y / grid.side];
  const row = y / ROW / grid.side;
  return [x / grid.side - row / 2, row];
}

/** The lattice point nearest to a point in metres. @param {Grid} grid @param {Point} point @returns {Point} */
export function nearestNode(grid, point) {
  const [x, y] = toLattice(grid, point);
  let best = /** @type {Point} */ ([Math.round(x), Math.round(y)]);
  let least = Infinity;
  // Because the coordinates are skewed, the rounded node may be a neighbour of the nearest one.
  for (let i = Math.floor(x) - 1; i <= Math.floor(x) + 2; i++) {
    for (let j = Math.floor(y); j <= Math.floor(y) + 1; j++) {
      const [nx, ny] = toMetres(grid, [i, j]);
      const distance = Math.hypot(nx - point[0], ny - point[1]);
      if (distance < least - 1e-12) [best, least] = [[i, j], distance];
    }
  }
  return best;
}

/** @param {Grid} grid @param {Cell} cell @returns {Point[]} its nodes, anticlockwise */
function corners(grid, [x, y, half]) {
  if (grid.kind === "square") return [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
  return half === "down" ? [[x, y], [x + 1, y - 1], [x + 1, y]] : [[x, y], [x + 1, y], [x, y + 1]];
}

/** @param {Grid} grid @param {Point} node @param {number} steps of 60° or 90° @returns {Point} */
function turned(grid, [x, y], steps) {
  const full = grid.kind === "square" ? 4 : 6;
  for (let i = ((steps % full) + full) % full; i > 0; i--) [x, y] = grid.kind === "square" ? [-y, x] : [-y, x + y];
  return [x, y];
}

/**
 * Returns the outline of connected cells as lattice nodes. An edge that two cells share occurs in both directions and is
 * left out. The other edges form loops, and the loop with the largest area is the outline.
 * @param {Grid} grid @param {Cell[]} cells @param {number} angle degrees
 * @returns {Point[][]} the outline, then its holes
 */
export function outlineOfCells(grid, cells, angle) {
  const steps = Math.round(angle / (grid.kind === "square" ? 90 : 60));
  /** @type {Map<string, [Point, Point]>} */
  const edges = new Map();
  const key = (/** @type {Point} */ a, /** @type {Point} */ b) => `${a}|${b}`;
  for (const cell of cells) {
    const nodes = corners(grid, cell).map((node) => turned(grid, node, steps));
    nodes.forEach((a, i) => {
      const b = nodes[(i + 1) % nodes.length];
      if (!edges.delete(key(b, a))) edges.set(key(a, b), [a, b]);
    });
  }
  /** @type {Map<string, [Point, Point][]>} edges by the node where they begin */
  const from = new Map();
  for (const edge of edges.values()) from.set(String(edge[0]), [...(from.get(String(edge[0])) ?? []), edge]);
  /** @type {Point[][]} */
  const loops = [];
  for (const first of edges.values()) {
    /** @type {Point[]} */
    const loop = [];
    let edge = from.get(String(first[0]))?.pop();
    while (edge) {
      loop.push(edge[0]);
      edge = from.get(String(edge[1]))?.pop();
    }
    if (loop.length > 0) loops.push(straightened(loop));
  }
  // The outline runs anticlockwise, holes clockwise.
  return loops.sort((a, b) => signedArea(b) - signedArea(a));
}

/** Removes corners between two edges of the same direction. @param {Point[]} loop */
function straightened(loop) {
  return loop.filter((p, i) => {
    const a = loop[(i + loop.length - 1) % loop.length];
    const b = loop[(i + 1) % loop.length];
    return (p[0] - a[0]) * (b[1] - p[1]) !== (p[1] - a[1]) * (b[0] - p[0]);
  });
}
