// Puts the page together: the document in the middle, and around it everything that shows or changes it.

import { Controller } from "./controller.js";
import { afterPause, byId } from "./dom.js";
import { fillExamples, loadExample } from "./examples.js";
import { Fall } from "./fall.js";
import { drawPlumb } from "./plumb.js";
import { Figures } from "./figures.js";
import { Frame } from "./frame.js";
import { unpacked } from "./link.js";
import { Outputs } from "./outputs.js";
import { standing } from "./scene.js";
import { Sliders } from "./sliders.js";
import { Solver } from "./solver.js";
import { Source } from "./source.js";
import { Stage } from "./stage.js";
import { Store } from "./store.js";
import { Theme } from "./theme.js";
import { Toolbar } from "./toolbar.js";
import { faultyBodies, inWords } from "./verdict.js";

const store = new Store();
const solver = new Solver();
const stage = new Stage(byId("stage"));
const fall = new Fall(stage);
const say = (/** @type {string} */ text) => { byId("status").textContent = text; };
const page = { snap: () => byId("snap").checked, redraw: () => schedule(), say };
const controller = new Controller(store, stage, page);
const toolbar = new Toolbar(store, stage, controller, page);
const sliders = new Sliders(byId("sliders"), store);
const source = new Source({ area: byId("source"), gutter: byId("gutter"), list: byId("problems") }, store);
const theme = new Theme(byId("theme"), () => figures.refresh());
const steps = new Frame(store, byId);
const figures = new Figures(
  { tabs: byId("tabs"), panel: byId("figure-panel"), image: byId("figure"), note: byId("figure-note") },
  (options) => solver.figure(store.text, options),
  (kind) => figureOptions(kind),
);
new Outputs(store, solver, figures, say);

/** The newest answer for the shown step. @type {{ result: any, faulty: Set<string>, stale: boolean }} */
const answer = { result: null, faulty: new Set(), stale: true };
let scheduled = 0;

/** Draws before the next picture of the screen, however often it is called. */
function schedule() {
  scheduled ||= requestAnimationFrame(() => {
    scheduled = 0;
    stage.draw({
      scene: store.scene, resolved: store.resolved, frame: store.frame, selected: store.selected,
      result: answer.result, faulty: answer.faulty, stale: answer.stale, forces: byId("show-forces").checked,
    });
    drawPlumb(byId("plumb"), store.scene);
    controller.afterDrawing();
  });
}

/** @param {string} kind */
function figureOptions(kind) {
  const body = store.body(store.selected) ?? store.resolved.bodies.findLast((b) => b.list === "blocks" && store.current.placed.has(b.id));
  const capacity = kind === "capacity" && body?.list === "blocks" ? { capacity: `${body.id}@${body.centre.map((c) => c.toFixed(6)).join(",")}` } : {};
  return { frame: store.frame + 1, theme: theme.dark ? "dark" : "thesis", ...capacity };
}

/** Asks for the verdict; while blocks are dragged, as often as the worker can answer. */
async function solve() {
  const text = store.dragging ? JSON.stringify(store.scene) : store.text;
  const reply = await solver.verdict(text, store.frame);
  if (!reply) return;
  const problems = reply.problems ?? [];
  answer.result = reply.value?.frames?.at(-1) ?? null;
  answer.faulty = faultyBodies(problems);
  answer.stale = false;
  const words = inWords(reply, standing(store.resolved, store.frame).filter((b) => b.list === "blocks").length);
  showVerdict(words, reply.milliseconds ?? 0);
  if (!store.dragging) source.show(problems, reply.value?.notes ?? []);
  schedule();
  fallLater();
}

/** @param {import("./verdict.js").Words} words @param {number} milliseconds */
function showVerdict({ state, title, detail }, milliseconds) {
  const box = byId("verdict");
  box.dataset.state = state;
  byId("verdict-title").textContent = title;
  byId("verdict-detail").textContent = detail;
  byId("play").hidden = state !== "falls";
  byId("time").textContent = `${Math.max(1, Math.round(milliseconds))} ms`;
  announce(`${title}. ${detail}`);
}

/** Read aloud once the verdict has settled: not for every position of a drag. */
const announce = afterPause(500, (/** @type {string} */ text) => {
  if (byId("announcement").textContent !== text) byId("announcement").textContent = text;
});

/** A structure that has just begun to fall shows how, once. */
let shownFall = "";
const fallLater = afterPause(350, () => {
  if (store.dragging || answer.stale || answer.result?.verdict !== "unstable" || shownFall === store.text + store.frame) return;
  shownFall = store.text + store.frame;
  play();
});

function play() {
  if (answer.result) fall.play(answer.result.mechanism, store.resolved, schedule);
}

/** What takes longer than a verdict waits until the hand rests. */
const refine = afterPause(200, async () => {
  if (store.dragging) return;
  figures.refresh();
  const reply = await solver.margins(store.text, store.frame);
  if (reply) sliders.showMargins(reply.value?.frames?.at(-1)?.margins ?? null);
});

store.addEventListener("scene", (event) => {
  const { fit, from } = /** @type {CustomEvent} */ (event).detail ?? {};
  fall.stop();
  // While a block is moved the last answer stays until the next, so that nothing flickers.
  answer.stale = from !== "drag" && from !== "edit";
  if (answer.stale) answer.result = null;
  if (fit) stage.fit(store.resolved);
  if (from !== "drag") {
    source.refresh();
    toolbar.refresh();
    steps.refresh();
    refine();
  }
  sliders.refresh();
  schedule();
  solve();
});
store.addEventListener("selection", () => {
  toolbar.refresh();
  steps.refresh();
  if (figures.kind === "capacity") figures.refresh();
  schedule();
});
store.addEventListener("history", () => {
  byId("undo").disabled = store.past.length === 0;
  byId("redo").disabled = store.future.length === 0;
});

byId("undo").addEventListener("click", () => store.undo());
byId("redo").addEventListener("click", () => store.redo());
byId("play").addEventListener("click", play);
byId("show-forces").addEventListener("change", schedule);
document.addEventListener("keydown", (event) => {
  // In the text the browser's own undo works letter by letter.
  if (!(event.ctrlKey || event.metaKey) || event.target === byId("source")) return;
  const key = event.key.toLowerCase();
  if (key !== "z" && key !== "y") return;
  event.preventDefault();
  if (key === "y" || event.shiftKey) store.redo();
  else store.undo();
});

new ResizeObserver(() => {
  const before = stage.view.width;
  stage.resize();
  if (Math.abs(stage.view.width - before) > 1) stage.fit(store.resolved);
  schedule();
}).observe(byId("stage"));

/** The scene of the link, or the first example. */
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

stage.resize();
window.addEventListener("hashchange", begin);
fillExamples(byId("examples"), store, say);
begin();
solver.about().then((reply) => {
  if (!reply?.value) return;
  byId("version").textContent = reply.value.version;
  figures.offer(reply.value.kinds);
});
