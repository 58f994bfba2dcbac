// Implements dragging in an SVG with mouse, touch or pen. This module does not depend on scenes: its caller decides
// what can be dragged, and what a move does. The caller is told of at most one move for each frame of the screen.

/** @typedef {import("./geometry.js").Point} Point */
/**
 * @template Handle
 * @typedef {object} DragOptions
 * @property {(target: Element, event: PointerEvent) => Handle | null} pick the handle under the pointer, or null
 * @property {(x: number, y: number) => Point} toWorld client coordinates to those of the drawing
 * @property {(handle: Handle, at: Point) => void} [start] called when the pointer has moved by a few pixels
 * @property {(handle: Handle, by: Point, at: Point, event: PointerEvent) => void} move `by` is counted from the start
 * @property {(handle: Handle, kept: boolean) => void} end `kept` is false if Escape or the browser ended the drag
 * @property {(handle: Handle | null, at: Point) => void} [click] called if the pointer did not move while it was pressed
 */

/** If the pointer moves by less than this many pixels, the drag counts as a click. */
const CLICK = 4;

/**
 * @template Handle
 * @param {SVGSVGElement} svg
 * @param {DragOptions<Handle>} options
 * @returns {() => void} a function that ends the support of dragging
 */
export function makeDraggable(svg, options) {
  /** @type {{ handle: Handle | null, id: number, x: number, y: number, from: Point, moving: boolean } | null} */
  let drag = null;
  /** @type {PointerEvent | null} */
  let latest = null;
  let scheduled = 0;

  const step = () => {
    scheduled = 0;
    if (!drag?.moving || !latest || drag.handle === null) return;
    const at = options.toWorld(latest.clientX, latest.clientY);
    options.move(drag.handle, [at[0] - drag.from[0], at[1] - drag.from[1]], at, latest);
    latest = null;
  };

  /** @param {PointerEvent} event */
  const down = (event) => {
    if (drag || event.button !== 0 || !event.isPrimary) return;
    const target = /** @type {Element} */ (event.target);
    drag = {
      handle: options.pick(target, event),
      id: event.pointerId,
      x: event.clientX,
      y: event.clientY,
      from: options.toWorld(event.clientX, event.clientY),
      moving: false,
    };
    if (drag.handle !== null) svg.setPointerCapture(event.pointerId);
  };

  /** @param {PointerEvent} event */
  const move = (event) => {
    if (!drag || event.pointerId !== drag.id || drag.handle === null) return;
    if (!drag.moving) {
      if (Math.hypot(event.clientX - drag.x, event.clientY - drag.y) < CLICK) return;
      drag.moving = true;
      options.start?.(drag.handle, drag.from);
    }
    latest = event;
    scheduled ||= requestAnimationFrame(step);
  };

  /** @param {boolean} kept */
  const finish = (kept) => {
    if (!drag) return;
    cancelAnimationFrame(scheduled);
    if (kept) step();
    scheduled = 0;
    const { handle, moving, from } = drag;
    drag = null;
    latest = null;
    if (moving && handle !== null) options.end(handle, kept);
    else if (kept) options.click?.(handle, from);
  };

  /** @param {PointerEvent} event */
  const up = (event) => event.pointerId === drag?.id && finish(true);
  /** @param {PointerEvent} event */
  const cancel = (event) => event.pointerId === drag?.id && finish(false);
  /** @param {KeyboardEvent} event */
  const key = (event) => {
    if (event.key !== "Escape" || !drag) return;
    event.stopPropagation();
    finish(false);
  };

  const stop = new AbortController();
  const { signal } = stop;
  svg.addEventListener("pointerdown", down, { signal });
  svg.addEventListener("pointermove", move, { signal });
  svg.addEventListener("pointerup", up, { signal });
  svg.addEventListener("pointercancel", cancel, { signal });
  window.addEventListener("keydown", key, { signal, capture: true });
  return () => stop.abort();
}
