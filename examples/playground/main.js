// Builds the page: the workbench, and around it all parts that show or change the scene.

import { afterPause, byId, legible } from "./dom.js";
import { fillExamples, loadExample } from "./examples.js";
import { Figures } from "./figures.js";
import { Frame } from "./frame.js";
import { unpacked } from "./link.js";
import { NumberSlider } from "./number.js";
import { Outputs } from "./outputs.js";
import { drawPlumb } from "./plumb.js";
import { Sliders } from "./sliders.js";
import { Solver } from "./solver.js";
import { Source } from "./source.js";
import { Theme } from "./theme.js";
import { Toolbar } from "./toolbar.js";
import { Workbench } from "./workbench.js";

byId("not-started").remove();

const say = (/** @type {string} */ text) => { byId("status").textContent = text; };
const snap = () => byId("snap").checked;
const solver = new Solver();
const bench = new Workbench(byId("stage"), { solver, snap, forces: () => byId("show-forces").checked });
const { store, stage, controller } = bench;
const toolbar = new Toolbar(store, stage, controller, { say, snap, redraw: () => bench.draw() });
const sliders = new Sliders(byId("sliders"), store);
const number = new NumberSlider(byId("sliders"), store, (name, range) => solver.vary(store.text, name, range, store.frame));
const source = new Source({ area: byId("source"), gutter: byId("gutter"), list: byId("problems") }, store);
const theme = new Theme(byId("theme"), () => figures.refresh());
const steps = new Frame(store, byId);
const figures = new Figures(
  { tabs: byId("tabs"), panel: byId("figure-panel"), image: byId("figure"), note: byId("figure-note") },
  (options) => solver.figure(store.text, options),
  (kind) => figureOptions(kind),
);
new Outputs(store, solver, figures, say);

/** @param {string} kind */
function figureOptions(kind) {
  const body = store.body(store.selected) ?? store.resolved.bodies.findLast((b) => b.list === "blocks" && store.current.placed.has(b.id));
  const capacity = kind === "capacity" && body?.list === "blocks" ? { capacity: `${body.id}@${body.centre.map((c) => c.toFixed(6)).join(",")}` } : {};
  // Give the figure the width of its panel, so that its letters are as large as those of the page.
  const width = Math.max(340, Math.round(byId("figure-panel").clientWidth));
  return { frame: store.frame + 1, theme: theme.dark ? "dark" : undefined, width_px: width, ...capacity };
}

/** @param {import("./verdict.js").Words} words @param {number} milliseconds */
function showVerdict({ state, title, detail }, milliseconds) {
  byId("verdict").dataset.state = state;
  byId("verdict-title").textContent = title;
  byId("verdict-detail").textContent = detail;
  byId("play").hidden = state !== "falls";
  byId("time").textContent = `${Math.max(1, Math.round(milliseconds))} ms`;
  announce(`${title}. ${detail}`);
}

/** Announces the verdict to screen readers when it no longer changes, and not for every position of a drag. */
const announce = afterPause(500, (/** @type {string} */ text) => {
  if (byId("announcement").textContent !== text) byId("announcement").textContent = text;
});

/** Updates the parts that take longer than a verdict, after the user has stopped dragging. */
const refine = afterPause(200, async () => {
  if (store.dragging) return;
  figures.refresh();
  const reply = await solver.margins(store.text, store.frame);
  if (reply) sliders.showMargins(reply.value?.frames?.at(-1)?.margins ?? null);
  number.find();
});

bench.addEventListener("answer", (event) => {
  const { reply, words } = /** @type {CustomEvent} */ (event).detail;
  showVerdict(words, reply.milliseconds ?? 0);
  if (!store.dragging) source.show(reply.problems ?? [], reply.value?.notes ?? []);
});
bench.addEventListener("drawn", () => drawPlumb(byId("plumb"), store.scene));

store.addEventListener("scene", (event) => {
  sliders.refresh();
  number.refresh();
  byId("title").textContent = legible(typeof store.scene.title === "string" ? store.scene.title : "", 120);
  if (/** @type {CustomEvent} */ (event).detail?.from === "drag") return;
  source.refresh();
  toolbar.refresh();
  steps.refresh();
  refine();
});
store.addEventListener("selection", () => {
  toolbar.refresh();
  steps.refresh();
  number.refresh();
  if (figures.kind === "capacity") figures.refresh();
  number.find();
});
store.addEventListener("history", () => {
  byId("undo").disabled = store.past.length === 0;
  byId("redo").disabled = store.future.length === 0;
});

byId("undo").addEventListener("click", () => store.undo());
byId("redo").addEventListener("click", () => store.redo());
byId("play").addEventListener("click", () => bench.play());
byId("show-forces").addEventListener("change", () => bench.draw());
document.addEventListener("keydown", (event) => {
  // The text field uses the undo of the browser, which works letter by letter.
  if (!(event.ctrlKey || event.metaKey) || event.target === byId("source")) return;
  const key = event.key.toLowerCase();
  if (key !== "z" && key !== "y") return;
  event.preventDefault();
  if (key === "y" || event.shiftKey) store.redo();
  else store.undo();
});

/** Opens the scene of the link, or the first example. */
async function begin() {
  let text = null;
  try {
    text = await unpacked(location.hash);
  } catch {
    say("The link is damaged: its scene cannot be read.");
  }
  if (text !== null) store.open(text);
  else await loadExample(store, byId("examples").value);
}

window.addEventListener("hashchange", begin);
fillExamples(byId("examples"), store, say);
begin();
solver.about().then((reply) => {
  if (!reply?.value) return say(reply?.error ?? "The solver could not be started.");
  byId("version").textContent = reply.value.version;
  figures.offer(reply.value.kinds);
});
