// Divides outlines into convex pieces, for tests of overlap.

import { cross, isConvex, signedArea, subtract } from "./geometry.js";

/** @typedef {import("./geometry.js").Point} Point */

/** @type {WeakMap<Point[], Point[][]>} */
const known = new WeakMap();

/**
 * Returns convex pieces that cover an outline and do not overlap. The list is empty if the outline crosses itself.
 * @param {Point[]} outline @returns {Point[][]}
 */
export function convexPieces(outline) {
  let pieces = known.get(outline);
  if (!pieces) {
    pieces = isConvex(outline) ? [outline] : joined(triangles(outline));
    known.set(outline, pieces);
  }
  return pieces;
}

/** Divides an outline into triangles, by cutting off one corner after the other. @param {Point[]} outline @returns {Point[][]} */
function triangles(outline) {
  const ring = signedArea(outline) < 0 ? outline.toReversed() : [...outline];
  const found = [];
  while (ring.length > 2) {
    const i = ring.findIndex((_, i) => isEar(ring, i));
    if (i < 0) return [];
    const corner = triangle(ring, i);
    if (bend(corner) > 0) found.push(corner);
    ring.splice(i, 1);
  }
  return found;
}

/** @param {Point[]} ring @param {number} i @returns {Point[]} */
const triangle = (ring, i) => [ring[(i + ring.length - 1) % ring.length], ring[i], ring[(i + 1) % ring.length]];
/** @param {Point[]} corner */
const bend = ([a, b, c]) => cross(subtract(b, a), subtract(c, b));

/** True if the corner can be cut off: it is straight, or convex without other corners in its triangle. @param {Point[]} ring @param {number} i */
function isEar(ring, i) {
  const corner = triangle(ring, i);
  const [a, b, c] = corner;
  if (bend(corner) === 0) return true;
  if (bend(corner) < 0) return false;
  return ring.every((p) => corner.some((q) => q[0] === p[0] && q[1] === p[1]) || bend([a, b, p]) < 0 || bend([b, c, p]) < 0 || bend([c, a, p]) < 0);
}

/** Joins pieces with a common edge as long as they stay convex. @param {Point[][]} pieces @returns {Point[][]} */
function joined(pieces) {
  for (let i = 0; i < pieces.length; i++) {
    for (let j = i + 1; j < pieces.length; j++) {
      const whole = union(pieces[i], pieces[j]);
      if (whole) return joined([...pieces.slice(0, i), whole, ...pieces.slice(i + 1, j), ...pieces.slice(j + 1)]);
    }
  }
  return pieces;
}

/** Returns the union of two pieces with a common edge if it is convex. @param {Point[]} one @param {Point[]} other @returns {Point[] | null} */
function union(one, other) {
  for (let i = 0; i < one.length; i++) {
    const j = other.indexOf(one[(i + 1) % one.length]);
    if (j < 0 || other[(j + 1) % other.length] !== one[i]) continue;
    const rest = (/** @type {Point[]} */ list, /** @type {number} */ from) => list.map((_, k) => list[(from + k) % list.length]);
    // Join both rings of corners without the common edge: each ring begins at the end of this edge and ends at the
    // start of the edge.
    const whole = [...rest(one, i + 1), ...rest(other, j + 1).slice(1, -1)];
    return isConvex(whole) ? whole : null;
  }
  return null;
}
