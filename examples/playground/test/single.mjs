// The playground as one file, opened from the disk.

import assert from "node:assert/strict";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { single } from "../single.mjs";
import { drag, middle, open, root, start, stop, verdict, visit } from "./lib/page.mjs";

before(start);
after(stop);

test("the single file needs no other file and works from the disk", async () => {
  const folder = await mkdtemp(path.join(os.tmpdir(), "playground-"));
  const file = path.join(folder, "playground.html");
  await writeFile(file, await single());
  const { page, close } = await open({ url: pathToFileURL(file).href, example: "overhang" });
  await verdict(page, "stands");
  await drag(page, await middle(page, "blocks/4"), { x: 60, y: 0 });
  await verdict(page, "falls");
  await page.waitForFunction(() => /** @type {HTMLImageElement} */ (document.querySelector("#figure")).naturalWidth > 0);
  assert.ok((await page.evaluate(() => performance.getEntriesByType("resource").map((e) => e.name))).every((/** @type {string} */ name) => /^(blob|data|file):/.test(name)));
  await close();
  await rm(folder, { recursive: true });
});

test("the page shows instructions if it is opened from the disk, but not from a server", async () => {
  const { page } = await visit(pathToFileURL(path.join(root, "index.html")).href);
  const note = page.locator("#not-started");
  assert.equal(await note.isVisible(), false);
  await note.waitFor({ state: "visible" });
  assert.match(await note.innerText(), /single\.mjs/);
  await page.context().close();
  const served = await open();
  assert.equal(await served.page.locator("#not-started").count(), 0);
  await served.close();
});
