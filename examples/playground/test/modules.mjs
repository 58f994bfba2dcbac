// Tests of the modules that need no browser.

import assert from "node:assert/strict";
import { readFile, readdir } from "node:fs/promises";
import path from "node:path";
import { test } from "node:test";
import { root } from "./lib/root.mjs";
import { convexPieces } from "../convex.js";
import * as edit from "../edit.js";
import { formatScene } from "../format.js";
import { bounds, isConvex, pushOut, signedArea } from "../geometry.js";
import { nearestNode, toMetres } from "../lattice.js";
import { packed, unpacked } from "../link.js";
import { inWords, nameOf, numbersOf, rangeOf, valueAt } from "../number.js";
import { resolve } from "../scene.js";
import { snapMove } from "../snap.js";

const read = async (/** @type {string} */ file) => JSON.parse(await readFile(path.join(root, file), "utf8"));

test("the examples with figures of Vallat (2023) are the files in assets/thesis", async () => {
  for (const name of (await readdir(path.join(root, "scenes"))).filter((n) => n.startsWith("figure-"))) {
    assert.equal(await readFile(path.join(root, "scenes", name), "utf8"), await readFile(path.join(root, "../../assets/thesis", name), "utf8"), name);
  }
});

test("a scene that is written and read again is the same", async () => {
  for (const name of await readdir(path.join(root, "scenes"))) {
    const scene = await read(`scenes/${name}`);
    assert.deepEqual(JSON.parse(formatScene(scene)), scene, name);
  }
});

test("the numbers of a scene have names, values and ranges", () => {
  const scene = { blocks: [{ id: "a", polygon: [[0, 0], [2, 0], [2, 1], [0, 1]], weight: 30 }], loads: [{ block: "a", force: [3, -4], at: [1, 1] }, { block: "b", force: [0, -1] }] };
  const body = { list: "blocks", index: 0, id: "a" };
  const numbers = numbersOf(scene, body);
  assert.deepEqual(numbers.map(({ path }) => nameOf(path)), ["blocks[0].weight", "loads[0].at[0]", "loads[0].at[1]", "loads[0].force[0]", "loads[0].force[1]"]);
  assert.deepEqual(numbers.map(({ path }) => valueAt(scene, path)), [30, 1, 1, 3, -4]);
  assert.equal(numbersOf(scene, null).length, 6);
  for (const number of numbers) {
    const value = valueAt(scene, number.path);
    const [low, high] = rangeOf(number, value);
    assert.ok(low <= value && value <= high && low < high, `${number.label}: ${low} to ${high}`);
  }
  assert.equal(rangeOf(numbers[0], 30)[0], 0);
  assert.equal(inWords([{ state: "holds", from: 0, to: 1 }, { state: "fails", from: 1.01, to: 2 }]), "stands from 0 to 1");
  assert.equal(inWords([{ state: "holds", from: -3500, to: 4120 }, { state: "fails", from: 4130, to: 5000 }]), "stands from −3500 to 4120");
  assert.equal(inWords([{ state: "fails", from: 0, to: 1 }]), "stands at no value of this slider");
});

test("hexagons of the lattice have their outline", async () => {
  const { byId } = resolve(await read("scenes/figure-4.json"));
  const hexagon = byId.get("1");
  assert.equal(hexagon?.outline.length, 6);
  for (const p of hexagon?.outline ?? []) assert.ok(Math.abs(Math.hypot(p[0] - hexagon.centre[0], p[1] - hexagon.centre[1]) - 1) < 1e-12);
});

test("cells with a hole have an outline and a hole, and many cells are fast", () => {
  const ring = [[0, 0], [1, 0], [2, 0], [0, 1], [2, 1], [0, 2], [1, 2], [2, 2]];
  const [body] = resolve({ grid: { kind: "square" }, blocks: [{ cells: ring }] }).bodies;
  assert.deepEqual([body.outline.length, body.holes.map((hole) => hole.length)], [4, [4]]);
  const many = Array.from({ length: 5000 }, (_, i) => [2 * (i % 70), 2 * Math.floor(i / 70)]);
  // If every cell were compared with every other, this would take minutes.
  assert.equal(resolve({ grid: { kind: "square" }, blocks: [{ cells: many }] }).bodies.length, 1);
});

test("steps place, hold, release and plan", async () => {
  const { frames } = resolve(await read("scenes/figure-4.json"));
  assert.equal(frames.length, 6);
  assert.deepEqual(frames[1].holds.map((hold) => hold.robot), ["r1"]);
  assert.deepEqual([...frames[1].planned], ["5"]);
  assert.ok(frames[2].placed.has("5") && !frames[3].placed.has("5"));
});

test("input that is not a scene resolves to no bodies", () => {
  for (const scene of [null, 5, "x", [], { blocks: 3 }, { blocks: [null, 1, {}], steps: [null, 2] }, { grid: { kind: "square" }, blocks: [{ cells: [["a"]] }] }]) {
    assert.equal(resolve(scene).bodies.length, 0);
  }
});

test("the nearest lattice point is found", () => {
  const grid = /** @type {const} */ ({ kind: "triangular", side: 0.5 });
  for (let i = 0; i < 200; i++) {
    const p = /** @type {[number, number]} */ ([Math.sin(i * 7) * 3, Math.cos(i * 5) * 3]);
    const [x, y] = toMetres(grid, nearestNode(grid, p));
    assert.ok(Math.hypot(x - p[0], y - p[1]) <= 0.5 / Math.sqrt(3) + 1e-9);
  }
});

test("a block snaps onto the face below it, with its corners in either order", () => {
  const square = (/** @type {number} */ x, /** @type {number} */ y) => {
    const outline = /** @type {[number, number][]} */ ([[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]]);
    return { outline, box: { left: x, right: x + 1, bottom: y, top: y + 1 } };
  };
  const below = square(0, 0);
  for (const clockwise of [false, true]) {
    const body = square(0.02, 5);
    if (clockwise) body.outline.reverse();
    const move = snapMove(body, [0, -3.95], [below], { reach: 0.1, grid: 0, decimals: 3 });
    assert.ok(Math.abs(move[1] + 4) < 1e-12, `${move}`);
    assert.ok(Math.abs(move[0] + 0.02) < 1e-12, `${move}`);
  }
  // A block that is dragged far into the other is pushed out.
  const move = snapMove(square(3, 0), [-2.3, 0], [below], { reach: 0.05, grid: 0, decimals: 3 });
  assert.equal(pushOut(square(3 + move[0], 0).outline, below.outline, 1e-6), null);
});

/** @typedef {[number, number][]} Outline */
const CONCAVE = /** @type {Outline[]} */ ([
  [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]],
  [[0, 0], [5, 0], [5, 3], [4, 3], [4, 1], [3, 1], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]],
  [[0, 0], [2, 0], [4, 0], [2, 0.5], [2, 4]],
]);

test("convex pieces have the area of the outline and do not overlap", () => {
  for (const outline of CONCAVE.flatMap((o) => [o, o.toReversed()])) {
    const pieces = convexPieces(outline);
    assert.ok(pieces.length > 1 && pieces.every(isConvex));
    const area = pieces.reduce((sum, piece) => sum + Math.abs(signedArea(piece)), 0);
    assert.ok(Math.abs(area - Math.abs(signedArea(outline))) < 1e-12);
    for (const [i, a] of pieces.entries()) for (const b of pieces.slice(i + 1)) assert.equal(pushOut(a, b, 1e-9), null);
  }
  assert.deepEqual(convexPieces([[0, 0], [2, 2], [2, 0], [0, 2]]), []);
});

test("concave stones do not overlap while they are dragged, and fit into each other", () => {
  const body = (/** @type {Outline} */ outline) => ({ outline, box: bounds(outline) });
  for (const outline of CONCAVE) {
    const [angle, other] = [body(outline), body([[6, -1], [7, -1], [7, 4], [6, 4]])];
    let last = /** @type {[number, number]} */ ([0, 0]);
    for (let i = 0; i < 120; i++) {
      last = snapMove(angle, [i / 10, Math.sin(i / 9)], [other], { reach: 0.01, grid: 0, decimals: 6, last });
      const now = convexPieces(outline).map((piece) => piece.map((p) => /** @type {[number, number]} */ ([p[0] + last[0], p[1] + last[1]])));
      assert.ok(now.every((piece) => pushOut(piece, other.outline, 2e-6) === null), `${outline} ${i}`);
    }
  }
  // A block can be laid into the inner corner of an angle.
  const [block, angle] = [body([[0, 0], [1, 0], [1, 1], [0, 1]]), body(CONCAVE[0])];
  const from = body(block.outline.map(([x, y]) => /** @type {[number, number]} */ ([x + 4, y + 4])));
  const move = snapMove(from, [-2.97, -2.98], [angle], { reach: 0.05, grid: 0, decimals: 3 });
  assert.ok(Math.hypot(move[0] + 3, move[1] + 3) < 1e-9, `${move}`);
});

test("removing a block removes all entries that refer to it", async () => {
  const scene = await read("scenes/doorway.json");
  const body = resolve(scene).byId.get("right half");
  edit.removeBody(scene, /** @type {any} */ (body));
  assert.ok(!JSON.stringify(scene.steps).includes('"right half"'));
  assert.deepEqual(scene.steps.at(-1).release, []);
});

test("a link can contain any text", async () => {
  for (const text of ["{}", "x".repeat(100_000), "ü \u{1F9F1} \u202E", JSON.stringify(await read("scenes/figure-4.json"))]) {
    assert.equal(await unpacked(`#${await packed(text)}`), text);
  }
  assert.equal(await unpacked("#other"), null);
  await assert.rejects(async () => unpacked(`#${await packed("0".repeat(5_000_000))}`));
});
