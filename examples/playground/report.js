// Makes the figures of a report interactive. A button below each figure replaces it by an editor, in which the stones
// can be dragged. Another button shows the figure again. `interactive.mjs` packs this module for the report.

import { afterPause, html, svg } from "./dom.js";
import { Solver } from "./solver.js";
import { Workbench } from "./workbench.js";

const solver = new Solver();
const system = matchMedia("(prefers-color-scheme: dark)");

/** The editor that replaces one figure. */
class Stones {
  /** @param {HTMLElement} plate the figure @param {string} text of the scene @param {() => void} back */
  constructor(plate, text, back) {
    this.text = text;
    this.step = Number(plate.dataset.step) - 1;
    this.title = html("strong", {}, "…");
    this.detail = html("span", {}, "The solver is loading.");
    this.verdict = html("p", { class: "stones-verdict", "data-state": "waiting" }, this.title, " ", this.detail);
    this.spoken = html("p", { class: "stones-spoken", "aria-live": "polite" });
    this.forces = html("input", { type: "checkbox" });
    this.forces.checked = plate.dataset.kind !== "mechanism";
    this.play = button("Watch it fall", () => this.bench.play());
    this.undo = button("Undo", () => this.bench.store.undo());
    this.reset = button("As in the report", () => this.show());
    const root = svg("svg", {
      class: "stage", role: "group", tabindex: -1,
      "aria-label": "Structure. Arrow keys move the focused block, Page Down goes to the next, Delete removes it.",
    });
    this.root = html("div", { class: "stones" }, this.verdict, this.spoken, root,
      html("p", { class: "stones-help" }, "Drag a stone, or reach it with Tab and move it with the arrow keys."),
      html("div", { class: "stones-tools" }, this.undo, this.reset, this.play,
        html("label", {}, this.forces, " Forces"), button("Back to the figure", back)));
    plate.prepend(this.root);
    this.bench = new Workbench(/** @type {SVGSVGElement} */ (root), { solver: solver.another(), forces: () => this.forces.checked });
    this.bench.addEventListener("answer", (event) => this.answer(/** @type {CustomEvent} */ (event).detail.words));
    this.bench.store.addEventListener("scene", () => this.changed());
    this.forces.addEventListener("change", () => this.bench.draw());
    this.root.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this.key(event));
    this.announce = afterPause(500, (/** @type {string} */ words) => { this.spoken.textContent = words; });
    system.addEventListener("change", () => this.colour());
    this.colour();
    this.show();
    root.focus({ preventScroll: true });
  }

  /** Uses the light or dark colours of the report. */
  colour() {
    this.root.dataset.theme = getComputedStyle(document.documentElement).colorScheme.includes("dark") ? "dark" : "light";
  }

  /** Shows the unchanged step of the report. */
  show() {
    const { store } = this.bench;
    store.open(this.text);
    if (store.frame !== this.step) store.showFrame(this.step);
  }

  changed() {
    const { store } = this.bench;
    this.undo.disabled = store.past.length === 0;
    this.reset.disabled = store.text === this.text && !store.dragging;
  }

  /** @param {import("./verdict.js").Words} words */
  answer({ state, title, detail }) {
    this.verdict.dataset.state = state;
    this.title.textContent = `${title}.`;
    this.detail.textContent = detail;
    this.play.hidden = state !== "falls";
    this.announce(`${title}. ${detail}`);
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
    event.preventDefault();
    if (event.shiftKey) this.bench.store.redo();
    else this.bench.store.undo();
  }
}

/** @param {string} words @param {() => void} action @returns {HTMLButtonElement} */
function button(words, action) {
  const made = html("button", { type: "button" }, words);
  made.addEventListener("click", action);
  return made;
}

/** Adds a button to each figure of a scene. @param {Element} scene */
function prepare(scene) {
  const source = scene.querySelector("textarea.source");
  if (!(source instanceof HTMLTextAreaElement)) return;
  for (const plate of /** @type {NodeListOf<HTMLElement>} */ (scene.querySelectorAll(".plate[data-step]"))) {
    if (plate.querySelector(".stones-move")) continue;
    /** @type {Stones | null} */
    let stones = null;
    const move = button("Move the stones", () => {
      plate.classList.add("moved");
      stones ??= new Stones(plate, source.value, () => {
        plate.classList.remove("moved");
        move.focus();
      });
      stones.bench.stage.root.focus({ preventScroll: true });
    });
    move.className = "stones-move";
    plate.querySelector("figcaption")?.before(move);
  }
}

document.addEventListener("filled", (event) => prepare(/** @type {Element} */ (event.target)));
document.querySelectorAll("details.scene").forEach(prepare);
