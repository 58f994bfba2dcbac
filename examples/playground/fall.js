// Shows how a structure begins to fall. Each block turns about its instantaneous centre of rotation, or slides if it
// does not turn. The library gives the velocities of the first moment; the rest of the motion is only an
// illustration.

import { length } from "./geometry.js";

/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {{ block: string, velocity: Point, spin: number }} Motion */

/** The durations of the fall, of the pause at its end, and of the return to the start, in milliseconds. */
const FALL = 1500;
const REST = 900;
const RETURN = 350;
/** The largest turn of a block, in radians. */
const MOST_TURN = 0.16;

export class Fall {
  /** @param {import("./stage.js").Stage} stage */
  constructor(stage) {
    this.stage = stage;
    this.timer = 0;
    /** @type {(() => void) | null} */
    this.ended = null;
  }

  get running() {
    return this.timer !== 0;
  }

  /**
   * @param {Motion[]} mechanism
   * @param {import("./scene.js").Resolved} resolved
   * @param {() => void} ended
   */
  play(mechanism, resolved, ended = () => {}) {
    this.stop();
    // The fastest point moves by about a tenth of the picture. No block turns so far that hinges visibly open.
    const picture = Math.min(this.stage.view.width, this.stage.view.height) / this.stage.view.zoom;
    const spin = Math.max(...mechanism.map((motion) => Math.abs(motion.spin)), 1e-12);
    const reach = Math.min(0.1 * picture, MOST_TURN / spin);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const begin = performance.now();
    this.ended = ended;
    this.stage.root.classList.add("falling");
    const frame = (/** @type {number} */ now) => {
      const time = now - begin;
      const share = still ? 1 : time < FALL ? (time / FALL) ** 2 : 1 - Math.min(1, Math.max(0, (time - FALL - REST) / RETURN));
      this.show(mechanism, resolved, reach * share);
      if (time > FALL + REST + RETURN) this.stop();
      else this.timer = requestAnimationFrame(frame);
    };
    this.timer = requestAnimationFrame(frame);
  }

  /** @param {Motion[]} mechanism @param {import("./scene.js").Resolved} resolved @param {number} amount metres that the fastest point moves */
  show(mechanism, resolved, amount) {
    for (const motion of mechanism) {
      const body = resolved.byId.get(motion.block);
      const drawn = body && this.stage.drawn.get(body.key);
      if (!drawn) continue;
      drawn.group.setAttribute("transform", this.transform(motion, body.centre, amount));
    }
  }

  /** @param {Motion} motion @param {Point} centre @param {number} amount */
  transform({ velocity, spin }, centre, amount) {
    const { view } = this.stage;
    const angle = spin * amount;
    const radius = length(velocity) / Math.max(Math.abs(spin), 1e-12);
    if (Math.abs(angle) < 1e-6 || radius * view.zoom > 1e5) {
      return `translate(${(velocity[0] * amount * view.zoom).toFixed(2)} ${(-velocity[1] * amount * view.zoom).toFixed(2)})`;
    }
    // The centre of rotation does not move. Its direction from the centroid is perpendicular to the velocity.
    const [x, y] = view.toPixels([centre[0] - velocity[1] / spin, centre[1] + velocity[0] / spin]);
    return `rotate(${((-angle * 180) / Math.PI).toFixed(3)} ${x.toFixed(2)} ${y.toFixed(2)})`;
  }

  stop() {
    if (!this.timer) return;
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.stage.root.classList.remove("falling");
    for (const { group } of this.stage.drawn.values()) group.removeAttribute("transform");
    this.ended?.();
    this.ended = null;
  }
}
