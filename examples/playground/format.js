// Writes a scene as text, with one line for each block, step or load, as in a scene written by hand.

/** Objects and lists that fit in this many characters stay on one line. */
const WIDTH = 132;

/** @param {any} scene */
export function formatScene(scene) {
  return `${formatValue(scene, "", true)}\n`;
}

/** @param {any} value @param {string} indent @param {boolean} open whether it must be spread over lines @returns {string} */
function formatValue(value, indent, open) {
  const short = oneLine(value);
  if (!open && indent.length + short.length <= WIDTH) return short;
  if (Array.isArray(value)) {
    if (value.length === 0 || value.every((item) => typeof item !== "object")) return short;
    const lines = value.map((item) => `${indent}  ${formatValue(item, `${indent}  `, false)}`);
    return `[\n${lines.join(",\n")}\n${indent}]`;
  }
  if (value && typeof value === "object") {
    const lines = Object.entries(value).map(([key, item]) => {
      // In the lists of bodies, steps and loads, each entry gets a line, even if the list is short.
      const spread = indent === "" && Array.isArray(item) && item.some((entry) => entry && typeof entry === "object" && !Array.isArray(entry));
      return `${indent}  ${JSON.stringify(key)}: ${formatValue(item, `${indent}  `, spread)}`;
    });
    return lines.length > 0 ? `{\n${lines.join(",\n")}\n${indent}}` : "{}";
  }
  return short;
}

/** @param {any} value @returns {string} */
function oneLine(value) {
  if (Array.isArray(value)) return `[${value.map(oneLine).join(", ")}]`;
  if (value && typeof value === "object") {
    const parts = Object.entries(value).map(([key, item]) => `${JSON.stringify(key)}: ${oneLine(item)}`);
    return parts.length > 0 ? `{ ${parts.join(", ")} }` : "{}";
  }
  return JSON.stringify(value) ?? "null";
}
