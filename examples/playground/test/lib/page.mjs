// Serves the playground on a free port of this machine, and opens it in Chromium. A test fails if its page has errors
// or refused scripts, or sends requests to other hosts.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import http from "node:http";
import path from "node:path";
import { root } from "./root.mjs";
import { formatScene } from "../../format.js";

export { root };
const { chromium } = createRequire(path.join(process.env.PLAYGROUND_TOOLS ?? "", "package.json"))("playwright-core");

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".svg": "image/svg+xml", ".wasm": "application/wasm" };
const FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];

/** @type {import("node:http").Server} */
let server;
let browser;
let address = "";

export async function start() {
  server = http.createServer(async (request, response) => {
    const { pathname } = new URL(request.url ?? "/", "http://localhost");
    const file = path.join(root, path.normalize(pathname === "/" ? "/index.html" : decodeURIComponent(pathname)));
    try {
      const body = await readFile(file);
      response.writeHead(200, { "content-type": TYPES[path.extname(file)] ?? "text/plain" }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(undefined)));
  address = `http://127.0.0.1:${/** @type {any} */ (server.address()).port}/`;
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: FLAGS });
}

export async function stop() {
  await browser?.close();
  server?.close();
}

/**
 * Opens a page in a new context of the browser. @param {string} url @param {any} [options] those of the context
 */
export async function visit(url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, ...options });
  const page = await context.newPage();
  const faults = [];
  page.on("pageerror", (error) => faults.push(`error: ${error.stack ?? error}`));
  page.on("console", (message) => message.type() === "error" && faults.push(`console: ${message.text()}`));
  page.on("dialog", (dialog) => { faults.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  page.on("request", (request) => {
    if (!/^(http:\/\/127\.0\.0\.1:|file:|blob:|data:)/.test(request.url())) faults.push(`request: ${request.url()}`);
  });
  page.on("requestfailed", (request) => {
    // When a test reloads or closes the page, the browser stops loading files such as the icon. These requests are
    // not faults. A missing or refused file also causes an error in the console.
    const aborted = request.failure()?.errorText === "net::ERR_ABORTED";
    if (!aborted && !request.url().startsWith("blob:")) faults.push(`failed: ${request.url()}`);
  });
  await page.goto(url);
  const close = async () => {
    await context.close();
    assert.deepEqual(faults, []);
  };
  return { page, close, faults };
}

/**
 * Opens the playground in a new context of the browser.
 * @param {{ url?: string, hash?: string, example?: string, scene?: any, [option: string]: any }} [options] other options are those of the context
 */
export async function open({ url = address, hash = "", example, scene, ...options } = {}) {
  const { page, close, faults } = await visit(url + hash, options);
  await page.waitForFunction(() => document.querySelector("#version")?.textContent !== "…" && document.querySelector("#verdict")?.getAttribute("data-state") !== "waiting", null, { timeout: 30_000 });
  if (example) await page.selectOption("#examples", example);
  if (scene !== undefined) await page.fill("#source", typeof scene === "string" ? scene : formatScene(scene));
  if (example || scene !== undefined) await page.waitForTimeout(700);
  // The page has scrolled to the text field, because the scene was written there.
  await page.evaluate(() => { /** @type {HTMLElement} */ (document.activeElement)?.blur(); window.scrollTo(0, 0); });
  return { page, close, faults };
}

/** @param {any} page @returns {Promise<string[]>} the violations that axe finds */
export async function violations(page) {
  await page.evaluate(await readFile(process.env.PLAYGROUND_AXE ?? "", "utf8"));
  return page.evaluate(async () => {
    const found = await /** @type {any} */ (window).axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"] });
    return found.violations.flatMap((/** @type {any} */ v) => v.nodes.map((/** @type {any} */ n) => `${v.id}: ${n.target} ${n.failureSummary}`));
  });
}

/**
 * Undoes changes with the keyboard until the structure stands. Keys that are pressed in quick succession are undone
 * together, but on a busy machine they may be undone in several steps.
 * @param {any} page @param {string} selector of the element with the verdict
 */
export async function undoUntilItStands(page, selector) {
  const stands = `${selector}[data-state="stands"]`;
  for (let step = 0; step < 14; step++) {
    await page.keyboard.press("Control+z");
    const found = await page.waitForSelector(stands, { state: "attached", timeout: 5_000 }).catch(() => null);
    if (found) return;
  }
  throw new Error("it does not stand after 14 steps of undo");
}

/** Waits for a verdict. @param {any} page @param {"stands" | "falls" | "wrong" | "undecided"} state */
export async function verdict(page, state) {
  await page.waitForFunction((/** @type {string} */ s) => document.querySelector("#verdict")?.getAttribute("data-state") === s, state, { timeout: 20_000 });
}

/** The middle of a block on the screen. @param {any} page @param {string} key such as blocks/3 */
export async function middle(page, key) {
  const outline = page.locator(`[data-handle="body:${key}"] path`);
  await outline.scrollIntoViewIfNeeded();
  const box = await outline.boundingBox();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** Drags with the mouse in steps. @param {any} page @param {{ x: number, y: number }} from @param {{ x: number, y: number }} by @param {number} [steps] */
export async function drag(page, from, by, steps = 12) {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + by.x, from.y + by.y, { steps });
  await page.mouse.up();
}

/** The scene in the text field. @param {any} page */
export const sceneOf = async (page) => JSON.parse(await page.inputValue("#source"));

/** The path of a screenshot, which is written only for people to look at. @param {string} name */
export const shot = (name) => path.join(process.env.PLAYGROUND_SHOTS ?? "/tmp", `${name}.png`);
