// Writes the whole playground as one HTML file, which works from a disk, an email or a learning platform. Browsers do not
// load modules from files on a disk, so the HTML file contains the modules and gives them to the browser as blobs.
// usage: node single.mjs [playground.html]     (needs pkg/)

import { createHash } from "node:crypto";
import { readFile, readdir, writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { deflateRawSync } from "node:zlib";

const here = path.dirname(fileURLToPath(import.meta.url));
const read = (/** @type {string} */ name) => readFile(path.join(here, name), "utf8");

/**
 * Starts the page. This function runs in the browser; `files` contains all modules and scenes.
 * @param {{ modules: Record<string, string>, scenes: Record<string, string> }} files
 */
async function boot({ modules, scenes }) {
  const url = (/** @type {BlobPart} */ part, /** @type {string} */ type) => JSON.stringify(URL.createObjectURL(new Blob([part], { type })));
  const places = Object.fromEntries(Object.entries(scenes).map(([name, text]) => [name, JSON.parse(url(text, "application/json"))]));
  /** @type {Record<string, string>} */
  const done = {};
  // Each module comes after those that it imports; addresses of files are replaced by addresses of blobs.
  const load = (/** @type {string} */ name) => {
    done[name] ??= url(
      modules[name]
        .replace(/(from |import )"\.\/([\w./-]+)"/g, (_, word, other) => `${word}${load(other)}`)
        .replace('new URL("./worker.js", import.meta.url), { type: "module" }', () => load("worker.js"))
        .replace("new URL(`./scenes/${name}.json`, import.meta.url)", () => `(${JSON.stringify(places)})[name]`),
      "text/javascript",
    );
    return done[name];
  };
  await import(JSON.parse(load("main.js")));
}

/**
 * Returns the worker with the library as text and packed bytes. A worker from a file may neither import nor fetch
 * anything, and it may not be a module.
 * @param {string} worker @param {string} library @param {string} wasm in base64
 */
function joined(worker, library, wasm) {
  const names = [...library.matchAll(/^export (?:async )?(?:function|class) (\w+)/gm)].map(([, name]) => name);
  const inside = library
    .replace(/^export (?=(async )?(function|class) )/gm, "")
    .replace(/^export \{[^}]*\};?$/gm, "")
    .replace("new URL('drystone_bg.wasm', import.meta.url)", () => `(${unpack})("${wasm}")`);
  return `const [init, drystone] = (() => {\n${inside}\nreturn [__wbg_init, { ${names.join(", ")} }];\n})();\n${worker.replace(/^import init.*$/m, "")}`;
}

/** Runs in the worker. @param {string} text packed bytes in base64 @returns {Promise<ArrayBuffer>} */
function unpack(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).arrayBuffer();
}

/** @returns {Promise<string>} the HTML file */
export async function single() {
  const names = (await readdir(here)).filter((name) => name.endsWith(".js"));
  const modules = Object.fromEntries(await Promise.all([...names, "pkg/drystone.js"].map(async (name) => [name, await read(name)])));
  const scenes = Object.fromEntries(await Promise.all((await readdir(path.join(here, "scenes"))).map(async (name) => [path.parse(name).name, await read(`scenes/${name}`)])));
  const wasm = deflateRawSync(await readFile(path.join(here, "pkg/drystone_bg.wasm")), { level: 9 }).toString("base64");
  modules["worker.js"] = joined(modules["worker.js"], modules["pkg/drystone.js"], wasm);
  delete modules["pkg/drystone.js"];
  const files = JSON.stringify({ modules, scenes }).replaceAll("<", "\\u003c");
  const script = `(${boot})(JSON.parse(document.getElementById("files").textContent));`;
  const style = await read("style.css");
  const icon = `data:image/svg+xml,${encodeURIComponent(await read("icon.svg"))}`;
  const hash = (/** @type {string} */ text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
  const policy = `default-src 'none'; script-src ${hash(script)} blob: 'wasm-unsafe-eval'; worker-src blob:; connect-src blob:; style-src ${hash(style)}; img-src blob: data:; base-uri 'none'; form-action 'none'`;
  return (await read("index.html"))
    .replace(/(Content-Security-Policy" content=")[^"]*/, (_, start) => `${start}${policy}`)
    .replaceAll('"icon.svg"', () => `"${icon}"`)
    .replace('<link rel="stylesheet" href="style.css">', () => `<style>${style}</style>`)
    .replace('<script type="module" src="main.js"></script>', "")
    .replace("</body>", () => `<script type="application/json" id="files">${files}</script>\n<script>${script}</script>\n</body>`);
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const out = process.argv[2] ?? "playground.html";
  const page = await single();
  await writeFile(out, page);
  console.log(`wrote ${out}, ${Math.round(page.length / 1000)} kB`);
}
