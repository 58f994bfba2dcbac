(() => {
  "use strict";
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const make = (name, words, more = {}) => Object.assign(document.createElement(name), { textContent: words }, more);

  /* A scene's body is plain text until somebody opens it, so that a page of a thousand scenes opens at once. */
  const fill = (scene) => {
    const text = scene.querySelector(":scope > noscript");
    if (!text) return;
    const body = document.createElement("div");
    body.innerHTML = text.textContent;
    text.replaceWith(...body.childNodes);
    enlarging(scene);
    marks(scene);
    copying(scene);
    scene.dispatchEvent(new Event("filled", { bubbles: true }));
  };
  const scenes = document.getElementById("scenes");
  for (const scene of all("details.scene")) {
    scene.addEventListener("toggle", () => scene.open && fill(scene));
    if (scenes.dataset.open === "true") { scene.open = true; fill(scene); }
  }
  addEventListener("beforeprint", () => all("details.scene").forEach((scene) => { scene.open = true; fill(scene); }));

  /* A link to a scene or to one of its steps opens it. */
  const follow = () => {
    const name = decodeURIComponent(location.hash.slice(1));
    const scene = document.getElementById(name.replace(/-step-.*/, ""));
    if (!scene || !scene.matches("details.scene")) return;
    scene.open = true;
    fill(scene);
    const target = document.getElementById(name) || scene;
    target.scrollIntoView();
  };
  addEventListener("hashchange", follow);

  /* What the mouse or the keyboard points at in a figure is marked in the table, and the other way round. */
  function marks(scene) {
    for (const step of all(".step", scene)) {
      const readout = step.querySelector(".readout");
      if (!readout) continue;
      const still = readout.textContent;
      const parts = new Map();
      for (const touch of all("g.touch", step)) {
        const mark = touch.id.replace(/^.*-/, "");
        parts.set(mark, [...(parts.get(mark) || []), touch]);
        touch.dataset.mark = mark;
      }
      const rows = all("tr[data-mark]", step);
      for (const row of rows) parts.get(row.dataset.mark)?.push(row);
      const point = (mark) => {
        for (const on of all(".on", step)) on.classList.remove("on");
        const found = parts.get(mark) || [];
        for (const part of found) part.classList.add("on");
        readout.textContent = found.length ? found[0].querySelector("title")?.textContent || still : still;
      };
      const marked = (event) => event.target.closest?.("[data-mark]")?.dataset.mark;
      /* What has the focus stays marked where the mouse points at nothing: the page scrolls under a mouse that lies still. */
      const kept = () => step.contains(document.activeElement) ? marked({ target: document.activeElement }) : undefined;
      step.addEventListener("mouseover", (event) => point(marked(event) ?? kept()));
      step.addEventListener("mouseleave", () => point(kept()));
      step.addEventListener("focusin", (event) => point(marked(event)));
      /* One row of a table is in the order of the tab key; up and down go on from there. */
      for (const table of all("table", step)) {
        const own = all("tr[data-mark]", table);
        own.forEach((row, i) => { row.tabIndex = i ? -1 : 0; });
        table.addEventListener("keydown", (event) => {
          const by = { ArrowUp: -1, ArrowDown: 1 }[event.key];
          const to = own[own.indexOf(event.target) + (by || 0)];
          if (!by || !to || !own.includes(event.target)) return;
          event.preventDefault();
          event.target.tabIndex = -1;
          to.tabIndex = 0;
          to.focus();
        });
      }
    }
  }

  /* On a phone a figure grows to the size at which its letters are legible, and is pushed about. */
  function enlarging(scene) {
    for (const plate of all(".plate", scene)) {
      const button = make("button", "Enlarge", { type: "button", className: "enlarge" });
      button.addEventListener("click", () => {
        button.textContent = plate.classList.toggle("large") ? "Reduce" : "Enlarge";
      });
      plate.append(button);
    }
  }

  function copying(scene) {
    const source = scene.querySelector("textarea.source");
    if (!source) return;
    const button = make("button", "Select all to copy", { type: "button" });
    button.addEventListener("click", async () => {
      source.select();
      try { await navigator.clipboard.writeText(source.value); button.textContent = "Copied"; } catch { /* it is selected */ }
    });
    source.before(button);
  }

  /* The table of all scenes: sorted by its heads, filtered by words and verdict. */
  const table = document.querySelector("table[data-sortable]");
  if (table) {
    const body = table.tBodies[0];
    const rows = [...body.rows];
    const heads = all("thead th", table);
    for (const row of rows) [...row.cells].forEach((cell, i) => { if (i > 2) cell.dataset.label = heads[i].textContent; });
    heads.forEach((head, column) => {
      const kind = head.dataset.sort;
      if (!kind) return;
      const button = make("button", head.textContent, { type: "button" });
      head.replaceChildren(button);
      const value = (row) => row.cells[column].dataset.value ?? row.cells[column].textContent.trim();
      button.addEventListener("click", () => {
        const down = head.getAttribute("aria-sort") === "ascending";
        heads.forEach((other) => other.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        const order = kind === "number" ? (a, b) => value(a) - value(b) : (a, b) => value(a).localeCompare(value(b), "en");
        rows.sort((a, b) => (down ? order(b, a) : order(a, b)));
        body.append(...rows);
      });
    });
    const controls = make("div", "", { className: "controls" });
    const search = make("label", "Search");
    const words = make("input", "", { type: "search" });
    search.append(words);
    const filter = make("label", "Verdict");
    const verdict = make("select", "");
    for (const choice of ["any", "stands", "falls", "undecided"]) verdict.append(make("option", choice, { value: choice }));
    filter.append(verdict);
    const count = make("span", "", { className: "small" });
    count.setAttribute("role", "status");
    const select = () => {
      const wanted = words.value.trim().toLowerCase();
      let shown = 0;
      for (const row of rows) {
        const kept = row.textContent.toLowerCase().includes(wanted)
          && (verdict.value === "any" || row.dataset.verdict === verdict.value);
        row.hidden = !kept;
        shown += kept;
      }
      count.textContent = `${shown} of ${rows.length} shown`;
    };
    words.addEventListener("input", select);
    verdict.addEventListener("change", select);
    select();
    controls.append(search, filter, count);
    table.closest(".wide").before(controls);
  }
  follow();
})();
