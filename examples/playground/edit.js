// Changes to a scene. Each function changes the parsed scene that it gets, and only the keys that it needs to change.
// Coordinates keep the number of decimals of the scene, because the library estimates the rounding error of the
// coordinates from this number.

import { add, centroid, round, roundPoint, subtract, turn } from "./geometry.js";
import { gridOf, nearestNode, toLattice, toMetres } from "./lattice.js";
import { blockId, cellsOf, isPoint, list, outlineOf, robotId } from "./scene.js";

/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {import("./scene.js").Body} Body */

/** @param {any} scene @param {Body} body @returns {any} the block or part of the ground in the scene */
export const entityOf = (scene, body) => scene[body.list][body.index];

/** Moves a body, with its loads and grips. @param {any} scene @param {Body} body @param {Point} by metres @param {number} decimals */
export function moveBody(scene, body, by, decimals) {
  const entity = entityOf(scene, body);
  const grid = gridOf(scene);
  const at = isPoint(entity.at) ? entity.at : /** @type {Point} */ ([0, 0]);
  let moved = roundPoint(by, decimals);
  if (grid && cellsOf(scene, entity)) {
    const goal = nearestNode(grid, add(toMetres(grid, at), by));
    moved = subtract(toMetres(grid, goal), toMetres(grid, at));
    entity.at = goal;
  } else if (entity.polygon && !entity.at && !entity.angle) {
    const shift = (/** @type {Point[]} */ loop) => loop.map((p) => roundPoint(add(p, moved), decimals));
    entity.polygon = shift(entity.polygon);
    if (entity.holes) entity.holes = list(entity.holes).map(shift);
  } else {
    const step = grid ? toLattice(grid, moved) : moved;
    entity.at = roundPoint(add(at, step), grid ? 9 : decimals);
  }
  if (body.list === "blocks") forEachPointOf(scene, body.id, (p) => roundPoint(add(p, moved), decimals));
}

/** Changes every point that belongs to a block: the points of its loads and the grip points of robots. @param {any} scene @param {string} id @param {(p: Point) => Point} change */
function forEachPointOf(scene, id, change) {
  for (const load of list(scene.loads)) if (load?.block === id && isPoint(load.at)) load.at = change(load.at);
  for (const robot of list(scene.robots)) if (robot?.holds === id && isPoint(robot.at)) robot.at = change(robot.at);
  for (const step of list(scene.steps)) {
    for (const grip of Object.values(step?.hold ?? {})) if (grip?.block === id && isPoint(grip.at)) grip.at = change(grip.at);
  }
}

/** Turns a body about its centroid. Bodies of cells turn by whole lattice angles. @param {any} scene @param {Body} body @param {number} degrees @param {number} decimals */
export function turnBody(scene, body, degrees, decimals) {
  const entity = entityOf(scene, body);
  const grid = gridOf(scene);
  if (grid && cellsOf(scene, entity)) {
    const part = grid.kind === "square" ? 90 : 60;
    const full = (((entity.angle ?? 0) + Math.sign(degrees) * part) % 360 + 360) % 360;
    if (full === 0) delete entity.angle;
    else entity.angle = full;
    // The angle turns the body about its origin. Choose `at` so that the centroid is as near to its old position as
    // the lattice allows.
    const outline = outlineOf(scene, entity)?.[0];
    if (outline) entity.at = nearestNode(grid, add(toMetres(grid, entity.at ?? [0, 0]), subtract(body.centre, centroid(outline))));
    return;
  }
  const angle = (degrees * Math.PI) / 180;
  bakePolygon(scene, body, Math.max(4, decimals), (p) => turn(p, angle, body.centre));
}

/** Gives a body its own polygon in metres, changed point by point. @param {any} scene @param {Body} body @param {number} decimals @param {(p: Point, i: number) => Point} change */
function bakePolygon(scene, body, decimals, change) {
  const entity = entityOf(scene, body);
  const at = (/** @type {Point} */ p, /** @type {number} */ i) => roundPoint(change(p, i), decimals);
  const polygon = body.outline.map(at);
  const holes = body.holes.map((hole) => hole.map((p) => at(p, -1)));
  for (const key of ["shape", "cells", "at", "angle", "holes"]) delete entity[key];
  entity.polygon = polygon;
  if (holes.length > 0) entity.holes = holes;
}

/** @param {any} scene @param {Body} body @param {number} corner @param {Point} to metres @param {number} decimals */
export function moveCorner(scene, body, corner, to, decimals) {
  bakePolygon(scene, body, decimals, (p, i) => (i === corner ? to : p));
}

/** Adds a corner after the given corner. @param {any} scene @param {Body} body @param {number} after @param {Point} at @param {number} decimals */
export function addCorner(scene, body, after, at, decimals) {
  const outline = body.outline.toSpliced(after + 1, 0, at);
  bakePolygon(scene, { ...body, outline }, decimals, (p) => p);
}

/** Removes a corner, except from a triangle. @param {any} scene @param {Body} body @param {number} corner @param {number} decimals */
export function removeCorner(scene, body, corner, decimals) {
  if (body.outline.length <= 3) return;
  bakePolygon(scene, { ...body, outline: body.outline.toSpliced(corner, 1) }, decimals, (p) => p);
}

/** Adds a block, to the scene and to the current step. @param {any} scene @param {any} block @param {number} frame @returns {string} its id */
export function addBlock(scene, block, frame) {
  scene.blocks = list(scene.blocks);
  const taken = new Set(scene.blocks.map(blockId));
  let number = scene.blocks.length + 1;
  while (taken.has(String(number))) number += 1;
  const id = String(number);
  scene.blocks.push({ id, ...block });
  const step = list(scene.steps)[frame];
  if (step) step.place = [...list(step.place), id];
  return id;
}

/** Removes a body and all entries that refer to it. @param {any} scene @param {Body} body */
export function removeBody(scene, body) {
  // The name of a block without an id is its number. Give all blocks an id before the numbers change.
  if (body.list === "blocks") scene.blocks.forEach((/** @type {any} */ block, /** @type {number} */ i) => block.id ??= blockId(block, i));
  scene[body.list].splice(body.index, 1);
  if (body.list === "ground") return;
  const other = (/** @type {any} */ name) => name !== body.id;
  if (scene.loads) scene.loads = list(scene.loads).filter((load) => other(load?.block));
  for (const robot of list(scene.robots)) if (robot?.holds === body.id) { delete robot.holds; delete robot.at; }
  for (const step of list(scene.steps)) {
    if (!step) continue;
    for (const key of ["place", "remove"]) if (step[key]) step[key] = list(step[key]).filter(other);
    for (const key of ["hold", "plan"]) {
      for (const [robot, grip] of Object.entries(step[key] ?? {})) if (!other(/** @type {any} */ (grip)?.block ?? grip)) delete step[key][robot];
    }
  }
  dropLostReleases(scene);
}

/** Removes releases of robots that hold nothing, because a scene must not contain them. @param {any} scene */
function dropLostReleases(scene) {
  const holding = new Set();
  for (const step of list(scene.steps)) {
    if (step?.release) step.release = list(step.release).filter((robot) => holding.delete(robot));
    for (const robot of Object.keys(step?.hold ?? {})) holding.add(robot);
  }
}

/** @param {any} scene @param {any} load */
export function addLoad(scene, load) {
  scene.loads = [...list(scene.loads), load];
}

/** @param {any} scene @param {number} index */
export function removeLoad(scene, index) {
  scene.loads = list(scene.loads).toSpliced(index, 1);
  if (scene.loads.length === 0) delete scene.loads;
}

/** Moves the point at which a load acts. @param {any} scene @param {number} index @param {Point} to @param {number} decimals */
export function moveLoad(scene, index, to, decimals) {
  scene.loads[index].at = roundPoint(to, decimals);
}

/** @param {any} scene @param {number} index @param {Point} force newtons, kept to three digits */
export function setForce(scene, index, force) {
  const size = Math.max(Math.abs(force[0]), Math.abs(force[1]), 1e-9);
  const decimals = Math.max(0, 2 - Math.floor(Math.log10(size)));
  scene.loads[index].force = roundPoint(force, Math.min(9, decimals));
}

/** Moves the grip point of a robot. @param {any} scene @param {import("./scene.js").Hold} hold @param {Point} to @param {number} decimals */
export function moveGrip(scene, hold, to, decimals) {
  const at = roundPoint(to, decimals);
  if (hold.step >= 0) scene.steps[hold.step].hold[hold.robot] = { block: hold.block, at };
  else {
    const robot = list(scene.robots).find((r, i) => robotId(r, i) === hold.robot);
    if (robot) robot.at = at;
  }
}

/** Makes a robot hold a block; if robots hold the block already, they release it. @param {any} scene @param {string} id @param {number} frame @param {import("./scene.js").Hold[]} holds of this step */
export function toggleHold(scene, id, frame, holds) {
  const held = holds.filter((hold) => hold.block === id);
  scene.robots = list(scene.robots);
  const steps = list(scene.steps);
  if (held.length > 0) {
    for (const hold of held) {
      if (hold.step < 0) {
        const robot = scene.robots.find((/** @type {any} */ r, /** @type {number} */ i) => robotId(r, i) === hold.robot);
        delete robot?.holds;
        delete robot?.at;
      } else if (hold.step === frame) delete steps[frame].hold[hold.robot];
      else steps[frame].release = [...list(steps[frame].release), hold.robot];
    }
    dropLostReleases(scene);
    return;
  }
  const busy = new Set(holds.map((hold) => hold.robot));
  let index = scene.robots.findIndex((/** @type {any} */ r, /** @type {number} */ i) => !busy.has(robotId(r, i)));
  if (index < 0) {
    const taken = new Set(scene.robots.map(robotId));
    let number = 0;
    while (taken.has(`r${number}`)) number += 1;
    index = scene.robots.push({ id: `r${number}` }) - 1;
  }
  const robot = scene.robots[index];
  if (steps.length > 0) steps[frame].hold = { ...steps[frame].hold, [robotId(robot, index)]: id };
  else robot.holds = id;
}

/** Sets one friction coefficient for the whole scene, as the friction margin does. @param {any} scene @param {number} mu */
export function setFriction(scene, mu) {
  scene.friction = round(mu, 3);
  delete scene.friction_pairs;
  delete scene.joint_sets;
  delete scene.friction_factor_on;
  for (const material of Object.values(scene.materials ?? {})) if (material) delete material.friction;
  for (const body of [...list(scene.blocks), ...list(scene.ground)]) if (body) delete body.friction;
}

/** Turns gravity. At 0°, gravity points down. @param {any} scene @param {number} degrees anticlockwise */
export function setTilt(scene, degrees) {
  const size = Math.hypot(...gravityOf(scene)) || 9.81;
  const angle = (degrees * Math.PI) / 180;
  const decimals = 6;
  scene.gravity = degrees === 0 ? [0, -round(size, decimals)] : roundPoint([size * Math.sin(angle), -size * Math.cos(angle)], decimals);
}

/** @param {any} scene @returns {Point} */
export const gravityOf = (scene) => (isPoint(scene?.gravity) ? scene.gravity : [0, -9.81]);

/** The angle between gravity and the downward direction, in degrees anticlockwise. @param {any} scene */
export function tiltOf(scene) {
  const [x, y] = gravityOf(scene);
  return x === 0 && y === 0 ? 0 : round((Math.atan2(x, -y) * 180) / Math.PI, 3);
}
