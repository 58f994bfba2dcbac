// Converts metres to pixels and back, and stores which part of the plane is visible.

/** @typedef {import("./geometry.js").Point} Point */

export class View {
  constructor() {
    /** Pixels per metre. */
    this.zoom = 100;
    /** @type {Point} the world point in the middle */
    this.centre = [0, 0];
    this.width = 800;
    this.height = 500;
  }

  /** @param {Point} p @returns {Point} */
  toPixels([x, y]) {
    return [this.width / 2 + (x - this.centre[0]) * this.zoom, this.height / 2 - (y - this.centre[1]) * this.zoom];
  }

  /** @param {Point} p @returns {Point} */
  toWorld([x, y]) {
    return [this.centre[0] + (x - this.width / 2) / this.zoom, this.centre[1] - (y - this.height / 2) / this.zoom];
  }

  /** Shows a box with a margin around it. @param {import("./geometry.js").Box} box */
  fit(box) {
    const [width, height] = [Math.max(box.right - box.left, 1e-9), Math.max(box.top - box.bottom, 1e-9)];
    const room = Math.min(72, this.width * 0.1);
    this.zoom = Math.min((this.width - 2 * room) / width, (this.height - 2 * room) / height);
    this.centre = [(box.left + box.right) / 2, (box.bottom + box.top) / 2];
  }

  /** True if a box is completely visible. @param {import("./geometry.js").Box} box */
  shows(box) {
    const [left, top] = this.toPixels([box.left, box.top]);
    const [right, bottom] = this.toPixels([box.right, box.bottom]);
    return left >= 0 && top >= 0 && right <= this.width && bottom <= this.height;
  }

  /** Zooms. The given point does not move on the screen. @param {number} factor @param {Point} [at] pixels */
  zoomBy(factor, at = [this.width / 2, this.height / 2]) {
    const fixed = this.toWorld(at);
    this.zoom = Math.min(1e7, Math.max(1e-5, this.zoom * factor));
    const now = this.toWorld(at);
    this.centre = [this.centre[0] + fixed[0] - now[0], this.centre[1] + fixed[1] - now[1]];
  }

  /** SVG path data of closed loops. @param {Point[][]} loops */
  path(loops) {
    return loops.map((loop) => `M${loop.map((p) => this.toPixels(p).map((c) => c.toFixed(2)).join(" ")).join("L")}Z`).join("");
  }
}
