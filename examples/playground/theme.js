// Sets the light or dark theme: that of the system, until the user chooses one.

const KEY = "drystone-theme";

export class Theme {
  /** @param {HTMLButtonElement} button @param {() => void} changed */
  constructor(button, changed) {
    this.button = button;
    this.system = matchMedia("(prefers-color-scheme: dark)");
    /** @type {string | null} */
    this.chosen = null;
    try {
      this.chosen = localStorage.getItem(KEY);
    } catch {
      // Without storage, the choice is lost when the page is closed.
    }
    button.addEventListener("click", () => {
      this.chosen = this.dark ? "light" : "dark";
      try {
        localStorage.setItem(KEY, this.chosen);
      } catch {
        // Without storage, the choice is lost when the page is closed.
      }
      this.show();
      changed();
    });
    this.system.addEventListener("change", () => {
      this.show();
      changed();
    });
    this.show();
  }

  get dark() {
    return this.chosen ? this.chosen === "dark" : this.system.matches;
  }

  show() {
    document.documentElement.dataset.theme = this.dark ? "dark" : "light";
    this.button.textContent = this.dark ? "Light" : "Dark";
  }
}
