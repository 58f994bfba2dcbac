// Plane geometry for the editor. A point is [x, y] in metres, and a polygon is a list of points. Verdicts do not
// depend on this file, because the library reads every scene from its text.

/** @typedef {[number, number]} Point */

/** @param {Point} a @param {Point} b @returns {Point} */
export const add = (a, b) => [a[0] + b[0], a[1] + b[1]];
/** @param {Point} a @param {Point} b @returns {Point} */
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1]];
/** @param {Point} a @param {number} factor @returns {Point} */
export const scale = (a, factor) => [a[0] * factor, a[1] * factor];
/** @param {Point} a @param {Point} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1];
/** @param {Point} a @param {Point} b */
export const cross = (a, b) => a[0] * b[1] - a[1] * b[0];
/** @param {Point} a */
export const length = (a) => Math.hypot(a[0], a[1]);

/** Rounds a number to `decimals` decimals. Never returns −0. @param {number} value @param {number} decimals */
export function round(value, decimals) {
  const rounded = Number(value.toFixed(decimals));
  return rounded === 0 ? 0 : rounded;
}

/** @param {Point} p @param {number} decimals @returns {Point} */
export const roundPoint = (p, decimals) => [round(p[0], decimals), round(p[1], decimals)];

/** Turns a point about a centre, radians anticlockwise. @param {Point} p @param {number} angle @param {Point} [centre] @returns {Point} */
export function turn(p, angle, centre = [0, 0]) {
  const [x, y] = subtract(p, centre);
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return [centre[0] + c * x - s * y, centre[1] + s * x + c * y];
}

/** Returns the signed area, which is positive if the corners are in anticlockwise order. @param {Point[]} polygon */
export function signedArea(polygon) {
  let sum = 0;
  for (let i = 0; i < polygon.length; i++) sum += cross(polygon[i], polygon[(i + 1) % polygon.length]);
  return sum / 2;
}

/** Returns the centroid of a polygon, or the mean of its corners if it has no area. @param {Point[]} polygon @returns {Point} */
export function centroid(polygon) {
  const origin = polygon[0] ?? [0, 0];
  let area = 0;
  /** @type {Point} */
  let sum = [0, 0];
  for (let i = 1; i + 1 < polygon.length; i++) {
    const a = subtract(polygon[i], origin);
    const b = subtract(polygon[i + 1], origin);
    const part = cross(a, b);
    area += part;
    sum = add(sum, scale(add(a, b), part / 3));
  }
  if (Math.abs(area) > 1e-12) return add(origin, scale(sum, 1 / area));
  const total = polygon.reduce((t, p) => add(t, p), /** @type {Point} */ ([0, 0]));
  return scale(total, 1 / Math.max(1, polygon.length));
}

/** @param {Point} p @param {Point[]} polygon */
export function contains(polygon, p) {
  let inside = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [a, b] = [polygon[i], polygon[j]];
    if (a[1] > p[1] !== b[1] > p[1] && p[0] < ((b[0] - a[0]) * (p[1] - a[1])) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside;
}

/** @param {Point} p @param {Point} a @param {Point} b @returns {Point} the point of the segment nearest to p */
export function nearestOnSegment(p, a, b) {
  const along = subtract(b, a);
  const t = dot(subtract(p, a), along) / (dot(along, along) || 1);
  return add(a, scale(along, Math.min(1, Math.max(0, t))));
}

/**
 * @typedef {{ left: number, right: number, bottom: number, top: number }} Box
 * @param {Iterable<Point>} points
 * @returns {Box} the smallest box around the points, or a unit square if there are no points
 */
export function bounds(points) {
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (const [x, y] of points) {
    box.left = Math.min(box.left, x);
    box.right = Math.max(box.right, x);
    box.bottom = Math.min(box.bottom, y);
    box.top = Math.max(box.top, y);
  }
  return Number.isFinite(box.left) ? box : { left: 0, right: 1, bottom: 0, top: 1 };
}

/** True if the distance of two boxes is at most `gap`. @param {Box} a @param {Box} b @param {number} [gap] */
export const near = (a, b, gap = 0) =>
  a.left - gap <= b.right && b.left - gap <= a.right && a.bottom - gap <= b.top && b.bottom - gap <= a.top;

/** @param {Point[]} polygon */
export function isConvex(polygon) {
  let sign = 0;
  for (let i = 0; i < polygon.length; i++) {
    const [a, b, c] = [0, 1, 2].map((k) => polygon[(i + k) % polygon.length]);
    const bend = cross(subtract(b, a), subtract(c, b));
    if (Math.abs(bend) < 1e-12) continue;
    if (sign !== 0 && Math.sign(bend) !== sign) return false;
    sign = Math.sign(bend);
  }
  return true;
}

/**
 * Returns the shortest move of `a` after which it does not overlap `b`, or null if they do not overlap. Both
 * polygons must be convex, because the separating-axis test uses the normals of all edges. If `a` did not overlap `b`
 * at its position `before`, it moves back to the same side of `b`, so that `a` never passes through `b`.
 * @param {Point[]} a @param {Point[]} b @param {number} slack overlaps below this many metres do not count
 * @param {Point[]} [before] where `a` was
 * @returns {Point | null}
 */
export function pushOut(a, b, slack, before) {
  /** @type {Point | null} */
  let best = null;
  let least = Infinity;
  /** @type {Point | null} */
  let back = null;
  let leastBack = Infinity;
  for (const polygon of [a, b]) {
    for (let i = 0; i < polygon.length; i++) {
      const edge = subtract(polygon[(i + 1) % polygon.length], polygon[i]);
      const size = length(edge);
      if (size < 1e-12) continue;
      /** @type {Point} */
      const normal = [edge[1] / size, -edge[0] / size];
      const [aLow, aHigh] = extent(a, normal);
      const [bLow, bHigh] = extent(b, normal);
      const forward = bHigh - aLow;
      const backward = aHigh - bLow;
      if (forward <= slack || backward <= slack) return null;
      const depth = Math.min(forward, backward);
      if (depth < least) {
        least = depth;
        best = scale(normal, forward < backward ? forward : -backward);
      }
      if (!before) continue;
      const [low, high] = extent(before, normal);
      if (low >= bHigh - slack && forward < leastBack) [back, leastBack] = [scale(normal, forward), forward];
      if (high <= bLow + slack && backward < leastBack) [back, leastBack] = [scale(normal, -backward), backward];
    }
  }
  return back ?? best;
}

/** @param {Point[]} polygon @param {Point} direction @returns {[number, number]} */
function extent(polygon, direction) {
  let low = Infinity;
  let high = -Infinity;
  for (const p of polygon) {
    const d = dot(p, direction);
    low = Math.min(low, d);
    high = Math.max(high, d);
  }
  return [low, high];
}
