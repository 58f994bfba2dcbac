// Links, files, and scenes with harmful content.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { drag, middle, open, root, sceneOf, shot, start, stop, verdict } from "./lib/page.mjs";

before(start);
after(stop);

/** Drops a file on the page. @param {any} page @param {string} name @param {string} text */
async function drop(page, name, text) {
  const transfer = await page.evaluateHandle(([n, t]) => {
    const data = new DataTransfer();
    data.items.add(new File([t], n));
    return data;
  }, [name, text]);
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
}

test("a link opens the same scene in a fresh browser", async () => {
  const first = await open({ example: "buttress" });
  await drag(first.page, await middle(first.page, "blocks/18"), { x: 90, y: 0 });
  await verdict(first.page, "falls");
  const scene = await sceneOf(first.page);
  await first.page.click("#share");
  await first.page.waitForFunction(() => /link/i.test(document.querySelector("#status")?.textContent ?? "") && location.hash.length > 100);
  const { hash } = new URL(first.page.url());
  await first.close();
  const second = await open({ hash });
  await verdict(second.page, "falls");
  assert.deepEqual(await sceneOf(second.page), scene);
  await second.page.waitForTimeout(1400);
  await second.page.screenshot({ path: shot("link") });
  await second.close();
});

test("a damaged link is reported, and the page still works", async () => {
  const { page, close } = await open({ hash: "#s=AAAA_-notdeflate" });
  await verdict(page, "stands");
  assert.match(await page.textContent("#status"), /damaged/);
  await close();
});

for (const [name, blocks] of /** @type {const} */ ([["arch.svg", 5], ["lintel.dxf", 3]])) {
  test(`${name} is imported by dropping it`, async () => {
    const { page, close } = await open();
    await drop(page, name, await readFile(path.join(root, "../../assets/import", name), "utf8"));
    await page.waitForFunction(() => /opened/.test(document.querySelector("#status")?.textContent ?? ""), null, { timeout: 20_000 });
    const scene = await sceneOf(page);
    assert.ok(scene.blocks.length >= blocks, `${scene.blocks.length} blocks`);
    await page.waitForTimeout(300);
    assert.notEqual(await page.getAttribute("#verdict", "data-state"), "wrong");
    await close();
  });
}

test("a scene is opened by dropping it, and other files are refused", async () => {
  const { page, close } = await open();
  await drop(page, "scene.json", await readFile(path.join(root, "scenes/overhang.json"), "utf8"));
  await page.waitForFunction(() => document.querySelectorAll(".body.block").length === 5);
  await drop(page, "photo.jpg", "…");
  await page.waitForFunction(() => /could not be opened/.test(document.querySelector("#status")?.textContent ?? ""));
  assert.equal((await sceneOf(page)).blocks.length, 5);
  await close();
});

test("figure and scene are saved as SVG, PNG and JSON", async () => {
  const { page, close } = await open({ example: "overhang" });
  await page.waitForFunction(() => /** @type {HTMLImageElement} */ (document.querySelector("#figure")).naturalWidth > 0);
  for (const [format, magic] of [["svg", "<svg"], ["png", "\u0089PNG"], ["json", "{"]]) {
    await page.click("#save-menu summary");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(`#save-${format}`)]);
    assert.match(download.suggestedFilename(), new RegExp(`^an-overhang.*\\.${format}$`));
    const bytes = await readFile(await download.path());
    assert.equal(bytes.toString("latin1").slice(0, magic.length), magic);
    if (format === "json") await page.keyboard.press("Escape");
  }
  await close();
});

test("hostile names stay text", async () => {
  const evil = '<img src=x onerror="document.title=1"><svg onload=alert(1)>';
  const bidi = "stone\u202Eevil\u2066\u200B";
  const scene = {
    drystone: 1, title: `${evil} ]]><script>alert(2)</script>`, friction: 0.7,
    materials: { __proto__: null, constructor: { density: 2000 }, [evil]: { density: 2500, fill: "#aabbcc" } },
    ground: [{ polygon: [[-1, -1], [5, -1], [5, 0], [-1, 0]] }],
    blocks: [
      { id: evil, material: evil, polygon: [[0, 0], [3, 0], [3, 1], [0, 1]] },
      { id: bidi, material: "constructor", polygon: [[0, 1], [3, 1], [3, 2], [0, 2]] },
      { id: "toString", shape: "__proto__" },
    ],
    shapes: JSON.parse('{ "__proto__": { "polygon": [[0, 2], [3, 2], [3, 3], [0, 3]] } }'),
    robots: [{ id: "javascript:alert(3)", holds: bidi }],
    loads: [{ block: evil, force: [5, 0] }],
    steps: undefined,
  };
  const text = JSON.stringify(scene, null, 1).replace('"shapes": {}', '"shapes": { "__proto__": { "polygon": [[0, 2], [3, 2], [3, 3], [0, 3]] } }');
  const { page, close } = await open({ scene: text });
  await page.waitForTimeout(1500);
  assert.equal(await page.title(), "drystone playground");
  assert.equal(await page.locator("main img").count(), 1, "only the figure's own image");
  assert.equal(await page.locator("main script, main iframe, main object, main foreignObject").count(), 0);
  const shown = await page.evaluate(() => [...document.querySelectorAll("#stage [aria-label], option")].map((e) => e.getAttribute("aria-label") ?? e.textContent).join("\n"));
  assert.ok(shown.includes("<img src=x onerror"), "the name is shown as it is");
  assert.ok(!/[\u202E\u2066\u200B]/.test(shown), "characters that reverse or hide text are not shown");
  assert.ok(shown.includes("[U+202E]"));
  for (const tab of await page.locator("#tabs button").all()) await tab.click();
  // The same with problems, whose messages quote the names.
  await page.fill("#source", text.replace(`"material": "constructor"`, `"material": ${JSON.stringify(evil + bidi)}x`.replace("x", "")));
  await page.waitForTimeout(900);
  assert.equal(await page.locator("#problems img, #verdict img").count(), 0);
  await page.screenshot({ path: shot("hostile") });
  await close();
});

test("text that is not a scene is refused with a message", async () => {
  const { page, close } = await open();
  for (const text of ["", "[]", "null", "12", "{", '{"drystone":1}', '{"drystone":1,"blocks":[{"polygon":5}]}', '{"drystone":1,"blocks":[null],"steps":[null],"ground":"x","grid":{"kind":"square"}}']) {
    await page.fill("#source", text);
    await verdict(page, "wrong");
    assert.ok((await page.textContent("#verdict-detail")).length > 5, text);
  }
  await close();
});
