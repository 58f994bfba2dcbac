// Packs modules of the page and the library into text that needs no other file. Browsers do not load modules from files
// on a disk, so the text contains the modules and gives them to the browser as blobs.

import { readFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { deflateRawSync } from "node:zlib";

const here = path.dirname(fileURLToPath(import.meta.url));

/** @param {string} name relative to this folder */
export const read = (name) => readFile(path.join(here, name), "utf8");

/**
 * Starts the module `main`. This function runs in the browser; `files` contains all modules and scenes.
 * @param {{ main: string, modules: Record<string, string>, scenes: Record<string, string>, style?: string }} files
 */
async function boot({ main, modules, scenes, style }) {
  if (style) document.head.append(Object.assign(document.createElement("style"), { textContent: style }));
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
  await import(JSON.parse(load(main)));
}

/**
 * Returns the worker with the library as text and packed bytes. On a page that is opened from a
 * disk, a worker may neither import nor fetch anything, and it may not be a module.
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

/** Unpacks the compressed library. This function runs in the worker. @param {string} text packed bytes in base64 @returns {Promise<ArrayBuffer>} */
function unpack(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).arrayBuffer();
}

/** Returns a module with all modules that it imports, by name. @param {string} main @returns {Promise<Record<string, string>>} */
async function modulesOf(main) {
  /** @type {Record<string, string>} */
  const modules = {};
  const add = async (/** @type {string} */ name) => {
    if (name in modules) return;
    modules[name] = await read(name);
    for (const [, other] of modules[name].matchAll(/(?:from |import )"\.\/([\w./-]+)"/g)) await add(other);
  };
  await add(main);
  return modules;
}

/**
 * Returns the files that `started` needs: a module, all modules that it imports, and the library.
 * @param {string} main @param {Record<string, string>} scenes by name
 */
export async function packed(main, scenes) {
  const wasm = deflateRawSync(await readFile(path.join(here, "pkg/drystone_bg.wasm")), { level: 9 }).toString("base64");
  const modules = await modulesOf(main);
  modules["worker.js"] = joined(await read("worker.js"), await read("pkg/drystone.js"), wasm);
  return { main, modules, scenes };
}

/** Returns a value as JSON that contains no HTML markup. @param {any} value */
export const inert = (value) => JSON.stringify(value).replaceAll("<", "\\u003c");

/** Returns a script that starts packed files. @param {string} files a JavaScript expression of the files */
export const started = (files) => `(${boot})(${files});`;
