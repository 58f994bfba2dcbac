// Draws the structure for editing. The drawing is simple, because it has to follow the pointer. The library draws the
// figures below it.

import { bounds } from "./geometry.js";
import { gridOf, toMetres } from "./lattice.js";
import { roundStep } from "./snap.js";
import { legible, set, svg } from "./dom.js";
import { drawForces, drawLoads, drawMissing, drawRobots } from "./arrows.js";
import { View } from "./view.js";

/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {import("./scene.js").Body} Body */
/**
 * @typedef {object} Picture what to draw
 * @property {any} scene
 * @property {import("./scene.js").Resolved} resolved
 * @property {number} frame
 * @property {string | null} selected
 * @property {any | null} result the result of the library for this step, or null
 * @property {Set<string>} faulty ids of blocks with a problem
 * @property {boolean} forces whether to draw the forces between the blocks
 * @property {boolean} stale whether the answer is older than the drawing
 */

const LAYERS = ["grid", "ground", "planned", "blocks", "forces", "missing", "loads", "robots", "handles", "draft"];

export class Stage {
  /** @param {SVGSVGElement} root */
  constructor(root) {
    this.root = root;
    this.view = new View();
    /** @type {Record<string, SVGElement>} */
    this.layers = {};
    for (const name of LAYERS) this.layers[name] = /** @type {SVGElement} */ (root.appendChild(svg("g", { class: `layer-${name}` })));
    // Screen readers ignore these layers. Elements that can have the focus are in the other layers.
    for (const name of ["grid", "planned", "forces", "missing", "draft"]) set(this.layers[name], { "aria-hidden": "true" });
    /** @type {Map<string, { group: SVGElement, path: SVGElement, label: SVGElement, d: string, text: string }>} */
    this.drawn = new Map();
    /** The length of an arrow of a load for one newton, in metres. This length is constant while a load is dragged. */
    this.loadScale = 1;
  }

  /** Reads the size of the element on the page. */
  resize() {
    const { width, height } = this.root.getBoundingClientRect();
    this.view.width = Math.max(50, width);
    this.view.height = Math.max(50, height);
    set(this.root, { viewBox: `0 0 ${this.view.width} ${this.view.height}` });
  }

  /** @param {import("./scene.js").Resolved} resolved */
  fit(resolved) {
    this.view.fit(bounds(resolved.bodies.flatMap((body) => body.outline)));
  }

  /** The distance of grid lines in metres. @param {any} scene */
  gridStep(scene) {
    return gridOf(scene)?.side ?? roundStep(26 / this.view.zoom);
  }

  /** @param {Picture} picture */
  draw(picture) {
    this.drawGrid(picture.scene);
    this.drawBodies(picture);
    drawForces(this, picture);
    drawMissing(this, picture);
    drawLoads(this, picture);
    drawRobots(this, picture);
    this.drawHandles(picture);
  }

  /** @param {any} scene */
  drawGrid(scene) {
    const { view } = this;
    const [left, bottom] = view.toWorld([0, view.height]);
    const [right, top] = view.toWorld([view.width, 0]);
    const grid = gridOf(scene);
    let d = "";
    if (grid && grid.side * view.zoom > 8) {
      const rows = Math.ceil((top - bottom) / toMetres(grid, [0, 1])[1]) + 2;
      const first = Math.floor(bottom / toMetres(grid, [0, 1])[1]);
      const columns = Math.ceil((right - left) / grid.side) + 3;
      for (let j = first; j < first + rows; j++) {
        const start = Math.floor((left - toMetres(grid, [0, j])[0]) / grid.side) - 1;
        for (let i = start; i < start + columns; i++) {
          const [x, y] = view.toPixels(toMetres(grid, [i, j]));
          d += `M${x.toFixed(1)} ${y.toFixed(1)}h0`;
        }
      }
    } else if (!grid) {
      const step = this.gridStep(scene);
      for (let x = Math.ceil(left / step); x * step <= right; x++) {
        for (let y = Math.ceil(bottom / step); y * step <= top; y++) {
          const [px, py] = view.toPixels([x * step, y * step]);
          d += `M${px.toFixed(1)} ${py.toFixed(1)}h0`;
        }
      }
    }
    const dots = this.layers.grid.firstChild ?? this.layers.grid.appendChild(svg("path", { class: "dots" }));
    set(/** @type {Element} */ (dots), { d });
  }

  /** @param {Picture} picture */
  drawBodies(picture) {
    const { resolved, frame, selected, result, faulty } = picture;
    const { placed, planned, holds } = resolved.frames[frame];
    const moving = new Set(result?.verdict === "unstable" ? result.mechanism.map((/** @type {any} */ m) => m.block) : []);
    const unsupported = new Set(result?.unsupported ?? []);
    const held = new Set(holds.map((hold) => hold.block));
    const seen = new Set();
    const ghosts = [];
    for (const body of resolved.bodies) {
      const ground = body.list === "ground";
      if (!ground && planned.has(body.id)) ghosts.push(svg("path", { d: this.view.path([body.outline]) }));
      if (!ground && !placed.has(body.id)) continue;
      seen.add(body.key);
      const state = [
        "body",
        ground ? "ground" : "block",
        moving.has(body.id) && !ground && "moving",
        unsupported.has(body.id) && !ground && "unsupported",
        held.has(body.id) && !ground && "held",
        faulty.has(body.key) && "faulty",
        body.key === selected && "selected",
      ].filter(Boolean).join(" ");
      this.drawBody(body, state, body.key === selected, describe(body, moving.has(body.id), held.has(body.id)));
    }
    for (const [key, { group }] of this.drawn) {
      if (seen.has(key)) continue;
      group.remove();
      this.drawn.delete(key);
    }
    this.layers.planned.replaceChildren(...ghosts);
    this.keepOneTabStop(selected);
  }

  /** @param {Body} body @param {string} state @param {boolean} selected @param {string} label */
  drawBody(body, state, selected, label) {
    let drawn = this.drawn.get(body.key);
    if (!drawn) {
      const path = svg("path", { "fill-rule": "evenodd" });
      const text = svg("text", { "aria-hidden": "true", dy: "0.35em" });
      const group = svg("g", { "data-handle": `body:${body.key}`, role: "button", tabindex: -1 }, path, text);
      this.layers[body.list === "ground" ? "ground" : "blocks"].append(group);
      drawn = { group, path, label: text, d: "", text: "" };
      this.drawn.set(body.key, drawn);
    }
    const d = this.view.path([body.outline, ...body.holes]);
    if (d !== drawn.d) {
      drawn.path.setAttribute("d", d);
      drawn.d = d;
      const [x, y] = this.view.toPixels(body.centre);
      set(drawn.label, { x: x.toFixed(1), y: y.toFixed(1) });
    }
    // A name that does not fit is not drawn. The list next to the stage contains all names.
    const room = Math.min(body.box.right - body.box.left, 3 * (body.box.top - body.box.bottom)) * this.view.zoom;
    const name = legible(body.id);
    const text = body.list === "blocks" && room > 10 + 7.5 * name.length ? name : "";
    if (text !== drawn.text) drawn.label.textContent = drawn.text = text;
    set(drawn.group, { class: state, "aria-label": label, "aria-pressed": selected ? "true" : "false" });
    drawn.path.style.fill = body.fill && !state.includes("moving") ? body.fill : "";
  }

  /** Lets Tab reach only one body: the selected one or, if there is none, the first block. @param {string | null} selected */
  keepOneTabStop(selected) {
    const keys = [...this.drawn.keys()];
    const stop = selected && this.drawn.has(selected) ? selected : keys.find((key) => key.startsWith("blocks")) ?? keys[0];
    for (const [key, { group }] of this.drawn) set(group, { tabindex: key === stop ? 0 : -1 });
  }

  /** @param {Picture} picture */
  drawHandles({ scene, resolved, selected }) {
    const body = resolved.bodies.find((b) => b.key === selected && this.drawn.has(b.key));
    const points = body && !body.onLattice && scene && body.outline.length <= 80 ? body.outline : [];
    const layer = this.layers.handles;
    while (layer.childElementCount > 2 * points.length) layer.lastElementChild?.remove();
    points.forEach((p, i) => {
      const next = points[(i + 1) % points.length];
      const [x, y] = this.view.toPixels(p);
      const [mx, my] = this.view.toPixels([(p[0] + next[0]) / 2, (p[1] + next[1]) / 2]);
      // There are two elements for each corner. The elements are reused and keep their place in the document, so that
      // an element with the focus does not lose the focus.
      const corner = layer.children[2 * i] ?? layer.appendChild(svg("circle"));
      const middle = layer.children[2 * i + 1] ?? layer.appendChild(svg("circle"));
      const name = legible(/** @type {Body} */ (body).id);
      set(corner, { class: "handle corner", r: 6, cx: x, cy: y, "data-handle": `corner:${i}`, role: "button", tabindex: 0, "aria-label": `Corner ${i + 1} of ${name}` });
      set(middle, { class: "handle middle", r: 4, cx: mx, cy: my, "data-handle": `edge:${i}`, "aria-hidden": "true" });
    });
  }
}

/** @param {Body} body @param {boolean} moves @param {boolean} held */
function describe(body, moves, held) {
  if (body.list === "ground") return `Ground, part ${body.index + 1}`;
  return `Block ${legible(body.id)}${held ? ", held by a robot" : ""}${moves ? ", falls" : ""}`;
}
