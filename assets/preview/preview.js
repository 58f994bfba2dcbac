// The page of `drystone render --watch --serve`: asks for changes, and shows the chosen scene.
"use strict";

const at = (id) => document.getElementById(id);
/** What the reader chose; it stays in the address, so that a reload keeps it. */
const chosen = { scene: "", kind: "", theme: "", ...Object.fromEntries(new URLSearchParams(location.hash.slice(1))) };
let scenes = [];
let version = 0;
let asked = 0;

async function get(path, words) {
  const answer = await fetch(`${path}?${new URLSearchParams(words)}`);
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
}

function choose(key, value) {
  chosen[key] = value;
  history.replaceState(null, "", `#${new URLSearchParams(chosen)}`);
  show().catch(lost);
}

/** The number of the chosen scene. */
function current() {
  return Math.max(0, scenes.findIndex(([name]) => name === chosen.scene));
}

function fill(key, names) {
  const select = at(key);
  if (select.options.length === 0) {
    select.replaceChildren(new Option("as in the command", ""), ...names.map((name) => new Option(name)));
    select.value = names.includes(chosen[key]) ? chosen[key] : "";
    select.addEventListener("change", () => choose(key, select.value));
  }
}

function tabs() {
  const buttons = scenes.map(([name, valid], number) => {
    const button = document.createElement("button");
    button.textContent = valid ? name : `✗ ${name}`;
    button.classList.toggle("wrong", !valid);
    if (number === current()) button.setAttribute("aria-current", "page");
    button.addEventListener("click", () => choose("scene", name));
    return button;
  });
  const focus = [...at("scenes").children].indexOf(document.activeElement);
  at("scenes").replaceChildren(...buttons);
  buttons[focus]?.focus();
}

async function show() {
  tabs();
  const mine = ++asked;
  const { svg, words, problem } = await get("picture", { scene: current(), kind: chosen.kind, theme: chosen.theme });
  // A later question may be answered sooner.
  if (mine !== asked) return;
  const name = scenes[current()][0];
  document.title = `${problem ? "✗ " : ""}${name} – drystone`;
  at("problem").textContent = problem;
  at("problem").hidden = problem === "";
  at("words").textContent = words;
  const picture = at("picture");
  picture.hidden = svg === "";
  picture.alt = `${name}: ${words}`;
  // The outlines of a scene with problems are not old.
  picture.classList.toggle("kept", words.startsWith("the last version"));
  if (svg) picture.src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
}

function lost() {
  at("words").textContent = "drystone does not answer. If it has ended, start it again with the same port.";
  version = 0;
  return new Promise((resolve) => setTimeout(resolve, 1000));
}

async function follow() {
  for (;;) {
    try {
      const state = await get("state", { since: version });
      if (state.version === version) continue;
      ({ scenes, version } = state);
      fill("kind", state.kinds);
      fill("theme", state.themes);
      await show();
    } catch {
      await lost();
    }
  }
}

follow();
