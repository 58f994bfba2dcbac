// A report with interactive figures, opened from the disk without a network. Needs the program (DRYSTONE, or
// target/debug/drystone) and pkg/interactive.js.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { drag, middle, root, shot, start, stop, violations, visit, undoUntilItStands } from "./lib/page.mjs";

const program = process.env.DRYSTONE ?? path.join(root, "../../target/debug/drystone");
let folder = "";

before(async () => {
  await start();
  folder = await mkdtemp(path.join(os.tmpdir(), "report-"));
  execFileSync("node", [path.join(root, "interactive.mjs")]);
});
after(async () => {
  await stop();
  await rm(folder, { recursive: true });
});

/** The report of an example, opened. @param {string} name @param {any} [options] of the browser */
async function report(name, options) {
  const file = path.join(folder, `${name}.html`);
  execFileSync(program, ["--quiet", "report", path.join(root, "scenes", `${name}.json`), "-o", file, "--interactive", path.join(root, "pkg")]);
  const opened = await visit(pathToFileURL(file).href, { offline: true, ...options });
  await opened.page.locator(".stones-move").first().waitFor();
  return opened;
}

/** Waits for the verdict of the editor. @param {any} page @param {string} state */
async function verdict(page, state) {
  await page.waitForFunction((/** @type {string} */ s) => document.querySelector(".stones-verdict")?.getAttribute("data-state") === s, state, { timeout: 30_000 });
}

test("a stone is dragged until the arch falls, the verdict is announced, and the figure comes back", async () => {
  const { page, close } = await report("arch");
  assert.equal(await page.locator(".stones-move").count(), await page.locator(".plate").count());
  assert.deepEqual(await violations(page), []);
  await page.locator(".stones-move").first().click();
  await verdict(page, "stands");
  assert.deepEqual(await violations(page), []);
  await drag(page, await middle(page, "blocks/6"), { x: 4, y: -90 });
  await verdict(page, "falls");
  await page.waitForFunction(() => document.querySelector(".stones-spoken")?.textContent?.startsWith("It falls."));
  await page.screenshot({ path: shot("report-falls") });
  await page.waitForTimeout(3000);
  assert.deepEqual(await violations(page), []);
  await page.getByRole("button", { name: "As in the report" }).click();
  await verdict(page, "stands");
  await page.getByRole("button", { name: "Back to the figure" }).click();
  assert.equal(await page.locator(".stones").first().isVisible(), false);
  assert.equal(await page.locator(".plate .paper").first().isVisible(), true);
  assert.ok((await page.evaluate(() => performance.getEntriesByType("resource").map((e) => e.name))).every((/** @type {string} */ name) => /^(blob|data|file):/.test(name)));
  await close();
});

test("with the keyboard alone, on a dark page", async () => {
  const { page, close } = await report("overhang", { colorScheme: "dark" });
  await page.locator(".stones-move").first().focus();
  await page.keyboard.press("Enter");
  await verdict(page, "stands");
  await page.keyboard.press("Tab");
  for (let i = 0; i < 3; i++) await page.keyboard.press("PageDown");
  for (let i = 0; i < 14; i++) await page.keyboard.press("ArrowRight");
  await verdict(page, "falls");
  await page.waitForTimeout(3600);
  await page.screenshot({ path: shot("report-dark") });
  assert.deepEqual(await violations(page), []);
  await undoUntilItStands(page, ".stones-verdict");
  await close();
});

test("on a phone, the editor shows the step of the figure", async () => {
  const { page, close } = await report("figure-4", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  const plate = page.locator(".plate[data-step]").first();
  const step = Number(await plate.getAttribute("data-step"));
  await plate.locator(".stones-move").tap();
  await page.waitForFunction(() => document.querySelectorAll(".stones .body").length > 1);
  const shown = await page.evaluate(() => [...document.querySelectorAll(".stones .body:not(.ground)")].length);
  const text = JSON.parse(await page.locator("textarea.source").first().inputValue());
  const placed = new Set();
  for (const { place = [], remove = [] } of text.steps.slice(0, step)) {
    for (const id of remove) placed.delete(id);
    for (const id of place) placed.add(id);
  }
  assert.equal(shown, placed.size);
  await page.waitForTimeout(1500);
  await page.screenshot({ path: shot("report-phone") });
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  assert.deepEqual(await violations(page), []);
  await close();
});

test("several figures can be edited at the same time, each with its own verdict", async () => {
  const { page, close } = await report("arch");
  for (const button of await page.locator(".stones-move").all()) await button.click();
  await page.waitForFunction(() => [...document.querySelectorAll(".stones-verdict")].every((v) => v.getAttribute("data-state") === "stands"), null, { timeout: 30_000 });
  assert.ok((await page.locator(".stones").count()) > 1);
  await close();
});
