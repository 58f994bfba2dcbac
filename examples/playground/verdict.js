// Writes the verdict in words.

import { legible, newtons } from "./dom.js";
import { list } from "./scene.js";

/**
 * @typedef {object} Words
 * @property {"stands" | "falls" | "undecided" | "wrong" | "waiting"} state
 * @property {string} title
 * @property {string} detail
 */

/** @param {string[]} names */
function names(names) {
  const shown = names.slice(0, 4).map((name) => legible(name)).join(", ");
  return names.length > 4 ? `${shown} and ${names.length - 4} more` : shown;
}

/** @param {number} count @param {string} noun */
const count = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;

/** @param {import("./solver.js").Answer} answer @param {number} blocks that stand in this step @returns {Words} */
export function inWords(answer, blocks) {
  if (answer.error) return { state: "wrong", title: "No answer", detail: answer.error };
  if (answer.problems) {
    const [first] = answer.problems;
    const more = answer.problems.length > 1 ? ` (and ${count(answer.problems.length - 1, "more problem")}, marked in the scene text)` : "";
    const overlap = answer.problems.every((p) => /overlap/.test(p.code ?? ""));
    return { state: "wrong", title: overlap ? "Blocks overlap" : "Not a valid scene", detail: `${sentence(legiblePart(first?.message))}${more}` };
  }
  const frame = answer.value?.frames?.at(-1);
  if (!frame) return { state: "waiting", title: "…", detail: "" };
  const total = `${count(blocks, "block")}, ${newtons(frame.weight)} in all.`;
  if (frame.verdict === "stable") {
    return { state: "stands", title: "It stands", detail: blocks === 0 ? "There is nothing that could fall. Add a block." : `${total} Every block is held.` };
  }
  if (frame.verdict === "unstable") return { state: "falls", title: "It falls", detail: falling(frame, blocks) };
  return { state: "undecided", title: "Undecided", detail: sentence(legiblePart(frame.doubt ?? "Neither verdict could be proved")) };
}

/** @param {any} frame @param {number} blocks */
function falling(frame, blocks) {
  const moving = frame.mechanism.map((/** @type {any} */ motion) => motion.block);
  const hanging = list(frame.unsupported);
  const parts = hanging.length === moving.length ? [] : [moves(moving, blocks)];
  const missing = list(frame.failures);
  if (hanging.length > 0) parts.push(`Nothing supports ${hanging.length === 1 ? "block" : "blocks"} ${names(hanging)}.`);
  if (missing.length > 0) {
    const largest = missing.reduce((a, b) => (b.amount > a.amount ? b : a));
    parts.push(sentence(largest.kind.startsWith("robot") ? grip(largest) : joint(largest)));
  }
  return parts.join(" ");
}

/** @param {string[]} moving @param {number} blocks */
function moves(moving, blocks) {
  if (moving.length === blocks && blocks > 1) return "All blocks move.";
  if (moving.length > 4) return `${moving.length} of ${blocks} blocks move.`;
  return moving.length === 1 ? `Block ${names(moving)} moves.` : `Blocks ${names(moving)} move.`;
}

/** @param {any} failure */
function grip({ robot, kind, amount }) {
  return `robot ${legible(robot)} would have to give ${newtons(amount)}${kind === "robot_torque" ? "·m" : ""} more`;
}

/** @param {any} failure */
function joint({ kind, bodies, amount }) {
  const [a, b] = list(bodies).map((name) => (name === "ground" ? "the ground" : `block ${legible(name)}`));
  return kind === "friction" ? `${newtons(amount)} of friction is missing between ${a} and ${b}` : `${a} would have to stick to ${b} with ${newtons(amount)}`;
}

/** Makes a message of the library safe to show, because the message may quote names from the scene. @param {any} text */
const legiblePart = (text) => String(text ?? "").split(/(\s)/).map((word) => (/^\s$/.test(word) ? " " : legible(word))).join("");

/** @param {string} text */
function sentence(text) {
  const [first = "", ...rest] = text;
  return `${first.toUpperCase()}${rest.join("")}${/[.!?…]$/.test(text) ? "" : "."}`;
}

/** Returns the bodies that have problems, from the paths of the problems in the scene. @param {any[]} problems */
export function faultyBodies(problems) {
  const keys = new Set();
  for (const problem of problems) {
    for (const [, kind, index] of String(problem.path ?? "").matchAll(/\b(blocks|ground)\[(\d+)\]/g)) keys.add(`${kind}/${index}`);
  }
  return keys;
}
