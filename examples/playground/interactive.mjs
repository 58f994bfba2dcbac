// Writes the script of `drystone report --interactive`: the editor of this page and the library in one file.
// usage: node interactive.mjs [pkg/interactive.js]     (needs pkg/)

import { writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { inert, packed, read, started } from "./bundle.mjs";

const out = process.argv[2] ?? path.join(path.dirname(fileURLToPath(import.meta.url)), "pkg/interactive.js");
const { version } = JSON.parse(await read("pkg/package.json"));
const style = (await read("stage.css")) + (await read("report.css"));
// The program accepts only a script of its own version, which it reads from the first line.
const script = `// drystone ${version}: interactive figures\n${started(inert({ ...(await packed("report.js", {})), style }))}\n`;
await writeFile(out, script);
console.log(`${path.basename(out)}: ${script.length} bytes`);
