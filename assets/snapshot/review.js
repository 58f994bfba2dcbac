// One handler for all: each stack of two pictures has a slider and a button beside it.
"use strict";
for (const box of document.querySelectorAll(".onion")) {
  const found = box.querySelector(".stack img + img");
  const slider = box.querySelector("input");
  const button = box.querySelector("button");
  const show = (share) => { found.style.opacity = share; };
  let timer = null;
  const stop = () => {
    clearInterval(timer);
    timer = null;
    button.setAttribute("aria-pressed", "false");
  };
  slider.addEventListener("input", () => { stop(); show(slider.value / 100); });
  button.addEventListener("click", () => {
    if (timer !== null) {
      stop();
      show(slider.value / 100);
      return;
    }
    let shown = true;
    button.setAttribute("aria-pressed", "true");
    timer = setInterval(() => { shown = !shown; show(shown ? 1 : 0); }, 600);
  });
  show(slider.value / 100);
}
for (const box of document.querySelectorAll(".command")) {
  box.querySelector("button").addEventListener("click", async (event) => {
    const text = box.querySelector("code").textContent;
    try {
      await navigator.clipboard.writeText(text);
      event.target.textContent = "Copied";
    } catch {
      // Without the right to the clipboard the words are selected, for the keyboard.
      getSelection().selectAllChildren(box.querySelector("code"));
    }
  });
}
