// Handles opening, dropping, saving and sharing of scenes.

import { afterPause, byId } from "./dom.js";
import { fileName, readFile, save, toPng } from "./files.js";
import { packed } from "./link.js";

/** A link longer than this is not written into the address bar automatically. */
const LONGEST_LINK = 30_000;

export class Outputs {
  /**
   * @param {import("./store.js").Store} store
   * @param {import("./solver.js").Solver} solver
   * @param {import("./figures.js").Figures} figures
   * @param {(text: string) => void} say
   */
  constructor(store, solver, figures, say) {
    this.store = store;
    this.solver = solver;
    this.figures = figures;
    this.say = say;
    /** @type {HTMLInputElement} */
    const input = byId("file");
    byId("open").addEventListener("click", () => input.click());
    input.addEventListener("change", () => {
      if (input.files?.[0]) this.read(input.files[0]);
      input.value = "";
    });
    this.acceptDrops(document.body);
    byId("save-svg").addEventListener("click", () => this.saveFigure("svg"));
    byId("save-png").addEventListener("click", () => this.saveFigure("png"));
    byId("save-json").addEventListener("click", () => save(`${fileName(store.scene)}.json`, new Blob([store.text], { type: "application/json" })));
    byId("share").addEventListener("click", () => this.share());
    const follow = afterPause(600, () => this.updateAddress());
    store.addEventListener("scene", follow);
    this.closeMenuOutside(byId("save-menu"));
  }

  /** @param {HTMLElement} element */
  acceptDrops(element) {
    element.addEventListener("dragover", (event) => {
      if (!event.dataTransfer?.types.includes("Files")) return;
      event.preventDefault();
      element.classList.add("dropping");
    });
    element.addEventListener("dragleave", (event) => {
      if (!event.relatedTarget) element.classList.remove("dropping");
    });
    element.addEventListener("drop", (event) => {
      element.classList.remove("dropping");
      const file = event.dataTransfer?.files[0];
      if (!file) return;
      event.preventDefault();
      this.read(file);
    });
  }

  /** @param {File} file */
  async read(file) {
    try {
      const { text, notes } = await readFile(file, this.solver);
      this.store.open(text);
      this.say([`The file was opened.`, ...notes.slice(0, 3)].join(" "));
    } catch (error) {
      this.say(`The file could not be opened. ${/** @type {Error} */ (error).message}`);
    }
  }

  /** @param {"svg" | "png"} format */
  async saveFigure(format) {
    byId("save-menu").open = false;
    const { svg, kind } = this.figures;
    if (!svg) return this.say("There is no figure yet.");
    const name = `${fileName(this.store.scene)}-${kind}.${format}`;
    try {
      save(name, format === "svg" ? new Blob([svg], { type: "image/svg+xml" }) : await toPng(svg, 2));
    } catch (error) {
      this.say(`The picture could not be saved. ${/** @type {Error} */ (error).message}`);
    }
  }

  async link() {
    const url = new URL(location.href);
    url.hash = await packed(this.store.text);
    return url.href;
  }

  /** Writes the scene into the address bar, so that a bookmark contains the scene. */
  async updateAddress() {
    if (this.store.dragging) return;
    const link = await this.link();
    if (link.length < LONGEST_LINK) history.replaceState(null, "", link);
  }

  async share() {
    const link = await this.link();
    history.replaceState(null, "", link);
    try {
      await navigator.clipboard.writeText(link);
      this.say(`The link was copied. It holds the whole scene in ${link.length} characters.`);
    } catch {
      this.say("The link is in the address bar: copy it from there.");
    }
  }

  /** @param {HTMLDetailsElement} menu */
  closeMenuOutside(menu) {
    document.addEventListener("pointerdown", (event) => {
      if (!menu.contains(/** @type {Node} */ (event.target))) menu.open = false;
    });
    menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      menu.open = false;
      menu.querySelector("summary")?.focus();
    });
  }
}
