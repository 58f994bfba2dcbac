// The shapes that users can add: centred at the origin, with a size that fits the scene.

import { round } from "./geometry.js";
import { BUILT_IN_NAMES, gridOf, nearestNode } from "./lattice.js";

/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {{ id: string, label: string, make: (size: number) => any }} Choice */

/** @param {Point[]} points @param {number} decimals */
const rounded = (points, decimals) => points.map(([x, y]) => [round(x, decimals), round(y, decimals)]);

/** A hexagon that stands on one of its sides. @param {number} radius @returns {Point[]} */
function standingHexagon(radius) {
  const height = (radius * Math.sqrt(3)) / 2;
  return [[-radius / 2, 0], [radius / 2, 0], [radius, height], [radius / 2, 2 * height], [-radius / 2, 2 * height], [-radius, height]];
}

/**
 * A voussoir at the crown of a semicircular arch. The sides of the voussoir point to the centre of the arch, which is
 * below the voussoir.
 * @param {number} size its height @param {number} [angle] the angle between its sides, degrees
 * @returns {Point[]}
 */
export function voussoir(size, angle = 18) {
  const half = (angle * Math.PI) / 360;
  const inner = size / (2 * Math.tan(half));
  const outer = inner + size;
  const base = inner * Math.cos(half);
  const at = (/** @type {number} */ radius, /** @type {number} */ side) =>
    /** @type {Point} */ ([side * radius * Math.sin(half), radius * Math.cos(half) - base]);
  return [at(inner, -1), at(inner, 1), at(outer, 1), at(outer, -1)];
}

/** Blocks that can be added to a scene. @param {any} scene @returns {Choice[]} */
export function choices(scene) {
  /** @type {Choice[]} */
  const all = [
    { id: "rectangle", label: "Rectangle", make: (s) => ({ polygon: [[-s, 0], [s, 0], [s, s], [-s, s]] }) },
    { id: "square", label: "Square", make: (s) => ({ polygon: [[-s / 2, 0], [s / 2, 0], [s / 2, s], [-s / 2, s]] }) },
    { id: "voussoir", label: "Voussoir (arch stone)", make: (s) => ({ polygon: voussoir(s) }) },
    { id: "triangle", label: "Triangle", make: (s) => ({ polygon: [[-s / 2, 0], [s / 2, 0], [0, s * 0.866]] }) },
    { id: "hexagonal", label: "Hexagon", make: (s) => ({ polygon: standingHexagon(s * 0.6) }) },
  ];
  const grid = gridOf(scene);
  if (!grid) return all;
  const names = grid.kind === "triangular" ? BUILT_IN_NAMES : [];
  const labels = { up: "Triangle ▲", down: "Triangle ▼", hexagon: "Hexagon", linkh: "Link, flat", linkr: "Link, leaning right", linkl: "Link, leaning left" };
  const own = Object.keys(scene.shapes ?? {});
  return [
    ...names.map((name) => ({ id: name, label: `Lattice: ${labels[/** @type {keyof labels} */ (name)]}`, make: () => ({ shape: name, at: [0, 0] }) })),
    ...(grid.kind === "square" ? [{ id: "cell", label: "Lattice: square", make: () => ({ cells: [[0, 0]], at: [0, 0] }) }] : []),
    ...own.filter((name) => Array.isArray(scene.shapes[name]?.cells)).map((name) => ({ id: `own ${name}`, label: `Shape: ${name}`, make: () => ({ shape: name, at: [0, 0] }) })),
    ...all.slice(0, 1),
  ];
}

/**
 * A block of the chosen shape whose origin is at a point.
 * @param {any} scene @param {Choice} choice @param {Point} at metres @param {number} size @param {number} decimals
 */
export function shapeAt(scene, choice, at, size, decimals) {
  const block = choice.make(size);
  const grid = gridOf(scene);
  if (grid && !block.polygon) return { ...block, at: nearestNode(grid, at) };
  return { polygon: rounded(block.polygon.map((/** @type {Point} */ [x, y]) => [x + at[0], y + at[1]]), decimals) };
}
