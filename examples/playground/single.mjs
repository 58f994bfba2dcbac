// Writes the whole playground as one HTML file, which works from a disk, an email or a learning platform.
// usage: node single.mjs [playground.html]     (needs pkg/)

import { createHash } from "node:crypto";
import { readdir, writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { inert, packed, read, started } from "./bundle.mjs";

const scenesFolder = path.join(path.dirname(fileURLToPath(import.meta.url)), "scenes");

/** @returns {Promise<string>} the HTML file */
export async function single() {
  const names = await readdir(scenesFolder);
  const scenes = Object.fromEntries(await Promise.all(names.map(async (name) => [path.parse(name).name, await read(`scenes/${name}`)])));
  const files = inert(await packed("main.js", scenes));
  const script = started('JSON.parse(document.getElementById("files").textContent)');
  const style = (await read("style.css")) + (await read("stage.css"));
  const icon = `data:image/svg+xml,${encodeURIComponent(await read("icon.svg"))}`;
  const hash = (/** @type {string} */ text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
  const policy = `default-src 'none'; script-src ${hash(script)} blob: 'wasm-unsafe-eval'; worker-src blob:; connect-src blob:; style-src ${hash(style)}; img-src blob: data:; base-uri 'none'; form-action 'none'`;
  return (await read("index.html"))
    .replace(/(Content-Security-Policy" content=")[^"]*/, (_, start) => `${start}${policy}`)
    .replaceAll('"icon.svg"', () => `"${icon}"`)
    .replace('<link rel="stylesheet" href="style.css">\n<link rel="stylesheet" href="stage.css">', () => `<style>${style}</style>`)
    .replace('<script type="module" src="main.js"></script>', "")
    .replace("</body>", () => `<script type="application/json" id="files">${files}</script>\n<script>${script}</script>\n</body>`);
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const out = process.argv[2] ?? "playground.html";
  const page = await single();
  await writeFile(out, page);
  console.log(`wrote ${out}, ${Math.round(page.length / 1000)} kB`);
}
