// Draws a plumb line in the corner of the stage, in the direction of gravity.

import { set, svg } from "./dom.js";
import { gravityOf, tiltOf } from "./edit.js";

/** @param {SVGSVGElement} root @param {any} scene */
export function drawPlumb(root, scene) {
  if (root.childElementCount === 0) {
    root.append(svg("path", { d: "M-9 0h18" }), svg("g", {}, svg("path", { d: "M0 0V48" }), svg("circle", { cy: 53, r: 6 })));
  }
  const [x, y] = gravityOf(scene);
  const tilt = tiltOf(scene);
  set(/** @type {Element} */ (root.lastElementChild), { transform: `rotate(${-tilt})`, display: x === 0 && y === 0 ? "none" : null });
  const side = tilt === 0 ? "straight down" : `${Math.abs(tilt)}° to the ${tilt < 0 ? "left" : "right"}`;
  set(root, { "aria-label": x === 0 && y === 0 ? "There is no gravity" : `Gravity points ${side}` });
}
