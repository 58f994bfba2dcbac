// Shows the figures of the library, one tab for each kind. A figure is shown as an image, so that text of a scene
// cannot run scripts or load anything.

import { html } from "./dom.js";

/** The kinds of figures on the page, in this order. Kinds that the library does not have are left out. */
const KINDS = [
  { kind: "forces", label: "Forces", help: "Every force between the blocks, and in red what is missing." },
  { kind: "flow", label: "Flow", help: "How the weight runs down through the blocks." },
  { kind: "thrust", label: "Thrust line", help: "Where the resultant crosses each joint." },
  { kind: "mechanism", label: "Mechanism", help: "How it falls: hinges and slips." },
  { kind: "capacity", label: "Capacity", help: "How large a force the selected block can carry in each direction." },
  { kind: "joints", label: "Joints", help: "Where forces act in the joints, and how much friction they use." },
  { kind: "mechanism-tilt", label: "Tilt", help: "How it falls if it is tilted too far." },
];

export class Figures {
  /**
   * @param {{ tabs: HTMLElement, panel: HTMLElement, image: HTMLImageElement, note: HTMLElement }} parts
   * @param {(options: any) => Promise<import("./solver.js").Answer | null>} ask
   * @param {(kind: string) => any} options the options of the page: frame, theme, selected block
   */
  constructor(parts, ask, options) {
    this.parts = parts;
    this.ask = ask;
    this.options = options;
    this.kind = "forces";
    /** The figure that is shown, as SVG text. */
    this.svg = "";
    this.url = "";
    /** @type {HTMLButtonElement[]} */
    this.buttons = [];
  }

  /** @param {any[]} kinds names of the kinds that the library has */
  offer(kinds) {
    const known = new Set(kinds.map((kind) => (typeof kind === "string" ? kind : kind?.kind ?? kind?.name)));
    this.buttons = KINDS.filter(({ kind }) => known.has(kind.split("-")[0])).map(({ kind, label, help }) => {
      const button = html("button", { type: "button", role: "tab", id: `tab-${kind}`, "aria-controls": "figure-panel", title: help }, label);
      button.dataset.kind = kind;
      button.addEventListener("click", () => this.choose(kind));
      return button;
    });
    this.parts.tabs.replaceChildren(...this.buttons);
    this.parts.tabs.addEventListener("keydown", (event) => this.key(event));
    this.choose(this.kind);
  }

  /** Moves from tab to tab with the arrow keys. @param {KeyboardEvent} event */
  key(event) {
    const now = this.buttons.findIndex((button) => button.dataset.kind === this.kind);
    const last = this.buttons.length - 1;
    const goals = { ArrowRight: now === last ? 0 : now + 1, ArrowLeft: now === 0 ? last : now - 1, Home: 0, End: last };
    const goal = goals[/** @type {keyof goals} */ (event.key)];
    if (goal === undefined) return;
    event.preventDefault();
    this.choose(this.buttons[goal].dataset.kind ?? this.kind);
    this.buttons[goal].focus();
  }

  /** @param {string} kind */
  choose(kind) {
    this.kind = kind;
    for (const button of this.buttons) {
      const chosen = button.dataset.kind === kind;
      button.setAttribute("aria-selected", String(chosen));
      button.tabIndex = chosen ? 0 : -1;
    }
    this.parts.panel.setAttribute("aria-labelledby", `tab-${kind}`);
    this.parts.note.textContent = KINDS.find((entry) => entry.kind === kind)?.help ?? "";
    this.refresh();
  }

  /** Requests the figure again. The old figure stays visible, but pale, until the new one arrives. */
  async refresh() {
    this.parts.image.classList.add("stale");
    const options = this.options(this.kind);
    let answer = await this.ask({ kind: this.kind, ...options });
    let note = KINDS.find((entry) => entry.kind === this.kind)?.help ?? "";
    // If the library rejects the option for the block, request the figure without it.
    if (answer?.error && options.capacity) answer = await this.ask({ kind: this.kind, ...options, capacity: undefined });
    if (answer?.problems) {
      // The scene is not valid. If its outlines can be read, the library draws them with the problems marked.
      note = "The figure follows once the scene is valid.";
      answer = await this.ask({ broken: true, theme: options.theme });
    }
    if (!answer) return;
    if (typeof answer.value !== "string") {
      this.parts.note.textContent = answer.error ?? note;
      return;
    }
    this.svg = answer.value;
    URL.revokeObjectURL(this.url);
    this.url = URL.createObjectURL(new Blob([answer.value], { type: "image/svg+xml" }));
    this.parts.image.src = this.url;
    this.parts.image.alt = description(answer.value);
    this.parts.image.hidden = false;
    this.parts.image.classList.remove("stale");
    this.parts.note.textContent = note;
  }
}

/** Returns the description in the figure, for people who cannot see it. @param {string} svg */
function description(svg) {
  const page = new DOMParser().parseFromString(svg, "image/svg+xml");
  return page.querySelector("svg > desc")?.textContent ?? "Figure";
}
