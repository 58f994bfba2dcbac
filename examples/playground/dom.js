// Small helpers to build the page. Text from scenes only becomes text nodes: innerHTML is never used.

const SVG = "http://www.w3.org/2000/svg";

/** @param {string} id @returns {any} */
export function byId(id) {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no #${id}`);
  return element;
}

/**
 * @param {Element} element
 * @param {Record<string, string | number | boolean | null | undefined>} attributes null and false remove one
 */
export function set(element, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) element.removeAttribute(name);
    else {
      const text = value === true ? "" : String(value);
      if (element.getAttribute(name) !== text) element.setAttribute(name, text);
    }
  }
}

/** @param {string} name @param {Record<string, any>} [attributes] @param {...(Node | string)} children @returns {SVGElement} */
export function svg(name, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, name);
  set(element, attributes);
  element.append(...children);
  return /** @type {SVGElement} */ (element);
}

/** @param {string} name @param {Record<string, any>} [attributes] @param {...(Node | string)} children @returns {any} */
export function html(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  set(element, attributes);
  element.append(...children);
  return element;
}

/**
 * Makes a name from a scene safe to read: invisible characters and marks that change the direction of text are shown as
 * code points, and long names are truncated.
 * @param {string} name @param {number} [most] characters
 */
export function legible(name, most = 60) {
  const shown = name.replace(/[\p{Cc}\p{Cf}\p{Zl}\p{Zp}\p{Co}\p{Cs}]/gu, (c) => `[U+${/** @type {number} */ (c.codePointAt(0)).toString(16).toUpperCase().padStart(4, "0")}]`);
  return shown.length > most ? `${[...shown].slice(0, most - 1).join("")}…` : shown;
}

/** @param {number} newtons "2.3 kN" */
export function newtons(newtons) {
  const size = Math.abs(newtons);
  if (size >= 1e6) return `${trim(newtons / 1e6)} MN`;
  if (size >= 1e3) return `${trim(newtons / 1e3)} kN`;
  return `${trim(newtons)} N`;
}

/** Formats a number for reading: three significant digits, without zeros at the end, with a true minus sign. @param {number} value */
export const trim = (value) => String(Number(value.toPrecision(3))).replace("-", "−");

/** Returns a function that runs `action` after no call for this time. @template {any[]} A @param {number} milliseconds @param {(...args: A) => void} action */
export function afterPause(milliseconds, action) {
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  return (/** @type {A} */ ...args) => {
    clearTimeout(timer);
    timer = setTimeout(() => action(...args), milliseconds);
  };
}
