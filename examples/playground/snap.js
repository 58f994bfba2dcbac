// Computes the position of a dragged block. The block snaps to the edges of near neighbours, otherwise to the grid. The
// block does not overlap other blocks, because stones cannot pass through each other.

import { convexPieces } from "./convex.js";
import { add, cross, dot, length, near, pushOut, scale, signedArea, subtract } from "./geometry.js";

/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {import("./geometry.js").Box} Box */
/** @typedef {{ outline: Point[], holes?: Point[][], box: Box }} Outline */
/**
 * A possible move along a normal. The pull with the least weight is used.
 * @typedef {{ normal: Point, distance: number, weight: number }} Pull
 */

/** The largest sine of the angle between two edges that count as parallel. */
const PARALLEL = 0.03;
/** The largest number of steps into which a move is divided. */
const STEPS = 60;

/**
 * The move that snaps a block.
 * @param {Outline} body as it was before the drag
 * @param {Point} wish the move of the pointer
 * @param {Outline[]} others
 * @param {{ reach: number, grid: number, decimals: number, last?: Point }} options `reach` is in metres, `grid` is 0 if
 *   there is no grid, and `last` is the previous move
 * @returns {Point}
 */
export function snapMove(body, wish, others, { reach, grid, decimals, last = [0, 0] }) {
  const slack = 10 ** -decimals;
  const free = slide(body, wish, others, slack, last);
  const box = moved(body.box, free);
  const close = others.filter((other) => near(other.box, box, 2 * reach));
  let move = free;
  const first = nearestPull(edgePulls(shift(body.outline, move), close, reach));
  if (first) {
    move = add(move, scale(first.normal, first.distance));
    const along = pullsAlong(shift(body.outline, move), close, first.normal, reach);
    const second = nearestPull(along);
    /** @type {Point} */
    const tangent = [-first.normal[1], first.normal[0]];
    if (second) move = add(move, scale(tangent, second.distance / dot(second.normal, tangent)));
    else if (grid > 0) move = add(move, scale(tangent, gridShift(dot(add([body.box.left, body.box.bottom], move), tangent), grid)));
  } else if (grid > 0) {
    // The lowest left corner of the block is moved to the grid.
    const corner = [body.box.left, body.box.bottom];
    move = /** @type {Point} */ (free.map((w, i) => Math.round((corner[i] + w) / grid) * grid - corner[i]));
  }
  return outOfOthers(body, move, others, slack, free);
}

/** @param {Point[]} outline @param {Point} by */
const shift = (outline, by) => outline.map((p) => add(p, by));
/** @param {Box} box @param {Point} by @returns {Box} */
const moved = (box, [x, y]) => ({ left: box.left + x, right: box.right + x, bottom: box.bottom + y, top: box.top + y });

/** @param {Pull[]} pulls @returns {Pull | null} */
function nearestPull(pulls) {
  return pulls.reduce((best, pull) => (!best || pull.weight < best.weight ? pull : best), /** @type {Pull | null} */ (null));
}

/** Returns the pulls that move an edge of the outline onto a parallel edge of another outline. @param {Point[]} outline @param {Outline[]} others @param {number} reach @returns {Pull[]} */
function edgePulls(outline, others, reach) {
  /** @type {Pull[]} */
  const pulls = [];
  const sense = Math.sign(signedArea(outline));
  for (const [a, b] of edges(outline)) {
    const along = unit(subtract(b, a));
    if (!along) continue;
    /** @type {Point} */
    const normal = [-along[1], along[0]];
    for (const other of others) {
      const otherSense = Math.sign(signedArea(other.outline));
      for (const [c, d] of edges(other.outline)) {
        const direction = unit(subtract(d, c));
        if (!direction || Math.abs(cross(along, direction)) > PARALLEL) continue;
        const distance = (dot(subtract(c, a), normal) + dot(subtract(d, b), normal)) / 2;
        if (Math.abs(distance) > reach || !overlap(a, b, c, d, along)) continue;
        // Edges that face each other come before edges that only lie on one line.
        const facing = dot(along, direction) * sense * otherSense < 0;
        pulls.push({ normal, distance, weight: Math.abs(distance) * (facing ? 1 : 3) });
      }
    }
  }
  return pulls;
}

/** Returns the pulls along a face that already touches: from corner to corner, or onto a second face. @param {Point[]} outline @param {Outline[]} others @param {Point} normal @param {number} reach @returns {Pull[]} */
function pullsAlong(outline, others, normal, reach) {
  /** @type {Point} */
  const tangent = [-normal[1], normal[0]];
  const pulls = edgePulls(outline, others, reach).filter((pull) => Math.abs(dot(pull.normal, tangent)) > 0.3);
  for (const p of outline) {
    for (const other of others) {
      for (const q of other.outline) {
        const gap = subtract(q, p);
        if (Math.abs(dot(gap, normal)) > reach / 4) continue;
        const distance = dot(gap, tangent);
        if (Math.abs(distance) <= reach) pulls.push({ normal: tangent, distance, weight: Math.abs(distance) });
      }
    }
  }
  return pulls;
}

/** Whether two parallel edges lie next to each other. @param {Point} a @param {Point} b @param {Point} c @param {Point} d @param {Point} along */
function overlap(a, b, c, d, along) {
  const [p, q] = [dot(c, along), dot(d, along)];
  return Math.max(dot(a, along), Math.min(p, q)) < Math.min(dot(b, along), Math.max(p, q));
}

/** Returns the difference between the nearest grid line and a coordinate. @param {number} at @param {number} grid */
const gridShift = (at, grid) => Math.round(at / grid) * grid - at;

/**
 * Returns how far the block can move from its last position towards the requested one. The block moves in steps
 * that are smaller than the block, so that it does not jump over other blocks but slides along them.
 * @param {Outline} body @param {Point} wish @param {Outline[]} others @param {number} slack @param {Point} last
 * @returns {Point}
 */
function slide(body, wish, others, slack, last) {
  if (piecesOf(body).length === 0) return wish;
  const size = 0.3 * Math.min(body.box.right - body.box.left, body.box.top - body.box.bottom);
  const step = Math.max(size, length(subtract(wish, last)) / STEPS);
  let at = last;
  for (let i = 0; i < STEPS; i++) {
    const rest = subtract(wish, at);
    const far = length(rest);
    if (far === 0) break;
    const next = outOfOthers(body, far > step ? add(at, scale(rest, step / far)) : wish, others, slack, at);
    const moves = length(subtract(next, at));
    at = next;
    if (moves < 1e-3 * step) break;
  }
  return at;
}

/** Returns the convex pieces of a body. For a body with holes the list is empty, because other blocks may lie in the holes. @param {Outline} body */
const piecesOf = (body) => (body.holes?.length ? [] : convexPieces(body.outline));

/** Returns the move, changed so that the block does not overlap the others. @param {Outline} body @param {Point} move @param {Outline[]} others @param {number} slack @param {Point} last @returns {Point} */
function outOfOthers(body, move, others, slack, last) {
  const pieces = piecesOf(body);
  let result = move;
  const before = pieces.map((piece) => shift(piece, last));
  // A block between two others may be pushed from one into the other. The number of rounds is therefore limited.
  for (let round = 0; round < 6; round++) {
    const now = pieces.map((piece) => shift(piece, result));
    const box = moved(body.box, result);
    const push = others
      .filter((other) => near(other.box, box))
      .flatMap(piecesOf)
      .flatMap((piece) => now.map((own, i) => pushOut(own, piece, slack, before[i])))
      .reduce((most, one) => (one && (!most || length(one) > length(most)) ? one : most), null);
    if (!push) return result;
    result = add(result, push);
  }
  return last;
}

/**
 * A point on the grid, or on a corner of an outline within reach.
 * @param {Point} point @param {Point[]} corners @param {{ reach: number, grid: number }} options
 * @returns {Point}
 */
export function snapPoint(point, corners, { reach, grid }) {
  let best = null;
  let least = reach;
  for (const corner of corners) {
    const distance = length(subtract(corner, point));
    if (distance < least) [best, least] = [corner, distance];
  }
  if (best) return best;
  return grid > 0 ? [Math.round(point[0] / grid) * grid, Math.round(point[1] / grid) * grid] : point;
}

/** A round grid width, 1, 2 or 5 times a power of ten, of about this many metres. @param {number} metres */
export function roundStep(metres) {
  const power = 10 ** Math.floor(Math.log10(metres));
  return [1, 2, 5, 10].map((n) => n * power).find((step) => step >= metres * 0.7) ?? power;
}

/** @param {Point[]} outline @returns {[Point, Point][]} */
const edges = (outline) => outline.map((p, i) => [p, outline[(i + 1) % outline.length]]);
/** @param {Point} p @returns {Point | null} */
function unit(p) {
  const size = length(p);
  return size > 1e-12 ? scale(p, 1 / size) : null;
}
