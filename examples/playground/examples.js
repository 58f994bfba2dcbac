// The list of example scenes.

import { html } from "./dom.js";

/** The file names in the folder `scenes`, each with its name in the list. */
const GROUPS = [
  {
    label: "To begin with",
    scenes: [
      ["arch", "Round arch"],
      ["arch-thin", "Round arch, too thin"],
      ["lintel", "Lintel with a load"],
      ["corbel", "Corbel"],
      ["overhang", "Overhang"],
      ["buttress", "Arch with buttresses"],
      ["doorway", "Doorway, built with a crane"],
      ["wall", "Wall of bricks"],
      ["tower", "Leaning tower"],
      ["lattice", "Pile of triangles"],
      ["blank", "Empty ground"],
    ],
  },
  {
    label: "Figures of Vallat (2023)",
    scenes: [
      ["figure-1", "Figure 1: a block on a slope"],
      ["figure-2", "Figure 2: a block on one, against another"],
      ["figure-3b", "Figure 3b"],
      ["figure-4", "Figure 4: two robots, six steps"],
      ["figure-5", "Figure 5: one robot, six hexagons"],
      ["figure-6-kernel-0", "Figure 6: kernel 0"],
      ["figure-6-kernel-02", "Figure 6: kernel 0.2"],
      ["figure-6-kernel-05", "Figure 6: kernel 0.5"],
      ["figure-8-left", "Figure 8, left"],
      ["figure-8-right", "Figure 8, right"],
      ["figure-8-right-corners", "Figure 8, right, with corners"],
      ["figure-9a", "Figure 9a"],
      ["figure-9a-corners", "Figure 9a, with corners"],
      ["figure-9b", "Figure 9b"],
      ["figure-9b-torque", "Figure 9b, held by a torque"],
    ],
  },
];

/**
 * @param {HTMLSelectElement} select @param {import("./store.js").Store} store @param {(text: string) => void} say
 */
export function fillExamples(select, store, say) {
  select.replaceChildren(...GROUPS.map(({ label, scenes }) => html("optgroup", { label }, ...scenes.map(([name, title]) => html("option", { value: name }, title)))));
  select.addEventListener("change", () => loadExample(store, select.value).catch(() => say("The example could not be loaded.")));
}

/** @param {import("./store.js").Store} store @param {string} name */
export async function loadExample(store, name) {
  const response = await fetch(new URL(`./scenes/${name}.json`, import.meta.url));
  if (!response.ok) throw new Error(`no example ${name}`);
  store.open(await response.text());
}
