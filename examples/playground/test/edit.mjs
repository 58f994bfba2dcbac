// Editing: dragging stones, the fall, undo, adding and deleting blocks, and changing values and text.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drag, middle, open, sceneOf, shot, start, stop, verdict } from "./lib/page.mjs";

before(start);
after(stop);

test("the page loads with an arch that stands, its figure and its margins", async () => {
  const { page, close } = await open();
  await verdict(page, "stands");
  assert.match(await page.textContent("#verdict-detail"), /13 blocks/);
  await page.waitForFunction(() => /** @type {HTMLImageElement} */ (document.querySelector("#figure")).naturalWidth > 0);
  await page.waitForFunction(() => /stands from 0\.3/.test(document.querySelector("#slider-friction-note")?.textContent ?? ""));
  assert.match(await page.textContent("#version"), /^\d+\.\d+/);
  await page.screenshot({ path: shot("desktop"), fullPage: true });
  await close();
});

test("a stone that is dragged far enough falls, and undo brings it back", async () => {
  const { page, close } = await open({ example: "overhang" });
  await verdict(page, "stands");
  const before = await sceneOf(page);
  const from = await middle(page, "blocks/4");
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  let fell = -1;
  for (let i = 1; i <= 8; i++) {
    await page.mouse.move(from.x + (i - 1) * 9, from.y, { steps: 3 });
    await page.waitForTimeout(150);
    await page.screenshot({ path: shot(`drag-${i}`), clip: { x: 0, y: 60, width: 1040, height: 720 } });
    if (fell < 0 && (await page.getAttribute("#verdict", "data-state")) === "falls") fell = i;
  }
  await page.mouse.up();
  assert.ok(fell > 0, "it falls while it is dragged");
  await verdict(page, "falls");
  assert.ok((await page.locator(".body.moving").count()) > 0, "the falling blocks are coloured");
  await page.waitForTimeout(1500);
  assert.ok((await page.locator(".body[transform]").count()) > 0, "the fall is shown");
  await page.screenshot({ path: shot("drag-9"), clip: { x: 0, y: 60, width: 1040, height: 720 } });
  assert.notDeepEqual(await sceneOf(page), before);
  await page.keyboard.press("Control+z");
  await verdict(page, "stands");
  assert.deepEqual(await sceneOf(page), before);
  await page.keyboard.press("Control+Shift+z");
  await verdict(page, "falls");
  await close();
});

test("Escape during a drag puts the stone back", async () => {
  const { page, close } = await open({ example: "tower" });
  const before = await sceneOf(page);
  const from = await middle(page, "blocks/7");
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 150, from.y - 20, { steps: 6 });
  await page.keyboard.press("Escape");
  await page.mouse.up();
  assert.deepEqual(await sceneOf(page), before);
  assert.equal(await page.isDisabled("#redo"), true);
  await close();
});

test("a dragged stone snaps to its neighbours and does not enter them", async () => {
  const { page, close } = await open({ example: "blank" });
  for (const name of ["rectangle", "rectangle"]) {
    await page.selectOption("#shape", name);
    await page.click("#add");
  }
  // The first block is dragged down to the ground, the second until it rests on the first.
  for (const key of ["blocks/0", "blocks/1"]) await drag(page, await middle(page, key), { x: 3, y: 500 }, 30);
  await verdict(page, "stands");
  const { blocks } = await sceneOf(page);
  const [low, high] = blocks.map((/** @type {any} */ block) => Math.min(...block.polygon.map((/** @type {number[]} */ p) => p[1])));
  assert.equal(low, 0);
  assert.equal(high, Math.max(...blocks[0].polygon.map((/** @type {number[]} */ p) => p[1])));
  await close();
});

test("corners, grips, loads and their forces can be dragged", async () => {
  const { page, close } = await open({ example: "lintel" });
  const changes = async (/** @type {string} */ selector, by = { x: 25, y: -30 }) => {
    const before = JSON.stringify(await sceneOf(page));
    const box = await page.locator(selector).boundingBox();
    await drag(page, { x: box.x + box.width / 2, y: box.y + box.height / 2 }, by);
    assert.notEqual(JSON.stringify(await sceneOf(page)), before, selector);
  };
  await changes('[data-handle="force:0"]');
  await changes('[data-handle="load:0"]', { x: 10, y: 10 });
  const block = await middle(page, "blocks/3");
  await page.mouse.click(block.x, block.y);
  await changes('[data-handle="corner:2"]');
  assert.equal((await sceneOf(page)).blocks[3].polygon.length, 4);
  await changes('[data-handle="edge:1"]');
  assert.equal((await sceneOf(page)).blocks[3].polygon.length, 5);
  await page.click("#hold");
  assert.equal((await sceneOf(page)).robots[0].holds, "stone");
  await changes('[data-handle="grip:r0"]', { x: 12, y: 8 });
  await page.click("#hold");
  assert.equal((await sceneOf(page)).robots[0].holds, undefined);
  await close();
});

test("a free polygon is drawn with clicks, and deleted", async () => {
  const { page, close } = await open({ example: "blank" });
  const { x, y } = await page.locator("#stage").boundingBox();
  await page.click("#draw");
  for (const [dx, dy] of [[300, 120], [420, 120], [440, 200], [280, 200], [300, 120]]) await page.mouse.click(x + dx, y + dy);
  assert.equal((await sceneOf(page)).blocks[0].polygon.length, 4);
  await page.click("#delete");
  assert.equal((await sceneOf(page)).blocks.length, 0);
  await close();
});

test("lattice shapes are added and move by whole steps", async () => {
  const { page, close } = await open({ example: "figure-9a" });
  await page.selectOption("#shape", "hexagon");
  await page.click("#add");
  const { blocks } = await sceneOf(page);
  assert.equal(blocks.at(-1).shape, "hexagon");
  await drag(page, await middle(page, `blocks/${blocks.length - 1}`), { x: 83, y: -41 });
  const { at } = (await sceneOf(page)).blocks.at(-1);
  assert.ok(at.every(Number.isInteger), String(at));
  await close();
});

test("sliders change the scene, and their notes give the values for which it stands", async () => {
  const { page, close } = await open({ example: "lintel" });
  await page.waitForFunction(() => /stands up to/.test(document.querySelector("#slider-load-note")?.textContent ?? ""));
  const set = (/** @type {string} */ id, /** @type {string} */ value) =>
    page.locator(id).evaluate((/** @type {HTMLInputElement} */ input, /** @type {string} */ v) => {
      input.value = v;
      input.dispatchEvent(new Event("input"));
    }, value);
  await set("#slider-friction", "0.1");
  await verdict(page, "falls");
  assert.equal((await sceneOf(page)).friction, 0.1);
  await set("#slider-friction", "0.7");
  await verdict(page, "stands");
  await set("#slider-tilt", "-30");
  await verdict(page, "falls");
  assert.ok((await sceneOf(page)).gravity[0] < 0);
  await set("#slider-tilt", "0");
  await set("#slider-load", "0");
  await verdict(page, "stands");
  assert.deepEqual((await sceneOf(page)).loads[0].force, [0, 0]);
  await set("#slider-load", "3");
  await verdict(page, "falls");
  assert.deepEqual((await sceneOf(page)).loads[0].force, [4500, 0]);
  await close();
});

test("any number has a slider, whose band shows for which values it stands", async () => {
  const { page, close } = await open();
  assert.ok(await page.locator("#number").isHidden(), "nothing is selected, and nothing pushes");
  await page.selectOption("#examples", "lintel");
  await page.waitForSelector("#number:enabled");
  const choices = await page.locator("#number option").allTextContents();
  assert.ok(choices.some((/** @type {string} */ words) => words.includes("force to the right")), choices.join(", "));
  await page.selectOption("#number", "loads[0].force[0]");
  await page.waitForFunction(() => /^stands from/.test(document.querySelector("#slider-number-note")?.textContent ?? ""));
  const most = Number(await page.locator("#slider-number").getAttribute("max"));
  await page.locator("#slider-number").evaluate((/** @type {HTMLInputElement} */ input, /** @type {number} */ value) => {
    input.value = String(value);
    input.dispatchEvent(new Event("input"));
  }, most);
  assert.equal((await sceneOf(page)).loads[0].force[0], most);
  await page.screenshot({ path: shot("number") });
  await close();
});

test("text and stage follow each other, and problems are marked at their lines", async () => {
  const { page, close } = await open({ example: "lintel" });
  const text = await page.inputValue("#source");
  await page.fill("#source", text.replace('"friction": 0.7', '"friction": "rough"'));
  await verdict(page, "wrong");
  await page.waitForSelector("#gutter .problem");
  const line = text.split("\n").findIndex((/** @type {string} */ l) => l.includes('"friction"')) + 1;
  assert.equal(await page.textContent("#gutter .problem"), String(line));
  await page.click("#problems button");
  assert.equal(await page.evaluate(() => document.activeElement?.id), "source");
  await page.fill("#source", text.slice(0, -30));
  await verdict(page, "wrong");
  await page.fill("#source", text.replace('"id": "stone"', '"id": "boulder"').replace('"block": "stone"', '"block": "boulder"'));
  await verdict(page, "stands");
  await page.waitForSelector('[aria-label^="Block boulder"]');
  await close();
});

test("the figures change with their tabs", async () => {
  const { page, close } = await open({ example: "arch-thin" });
  const seen = new Set();
  for (const tab of await page.locator("#tabs button").all()) {
    const before = await page.getAttribute("#figure", "src");
    await tab.click();
    await page.waitForFunction((/** @type {string} */ old) => document.querySelector("#figure")?.getAttribute("src") !== old && !document.querySelector("#figure")?.classList.contains("stale"), before, { timeout: 20_000 }).catch(() => {});
    seen.add(await page.getAttribute("#figure", "src"));
  }
  assert.ok(seen.size >= 5, `${seen.size} different figures`);
  await close();
});

test("the capacity tab shows what the selected block can carry", async () => {
  const { page, close } = await open();
  // The page may draw a figure again when it is idle, so wait for the words of the figure and not for a new image.
  const shows = (/** @type {string} */ words) =>
    page.waitForFunction((/** @type {string} */ words) => {
      const figure = document.querySelector("#figure");
      return figure?.getAttribute("alt")?.includes(words) && !figure.classList.contains("stale");
    }, words, { timeout: 20_000 });
  await page.click("#tab-capacity");
  // If no block is selected, the figure shows the last block.
  await shows("on block 13 it carries");
  const block = await middle(page, "blocks/4");
  await page.mouse.click(block.x, block.y);
  await shows("on block 5 it carries");
  await page.locator("#figure-panel").screenshot({ path: shot("capacity") });
  await close();
});

test("the workbench can be used alone, in another page", async () => {
  const { page, close } = await open();
  const state = await page.evaluate(async () => {
    const [{ Workbench }, { Solver }] = await Promise.all([import(/** @type {any} */ ("./workbench.js")), import(/** @type {any} */ ("./solver.js"))]);
    const root = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    root.style.width = "400px";
    root.style.height = "300px";
    document.body.append(root);
    const bench = new Workbench(root, { solver: new Solver() });
    const answer = new Promise((resolve) => bench.addEventListener("answer", (/** @type {any} */ event) => resolve(event.detail.words.state)));
    bench.store.open('{ "drystone": 1, "blocks": [{ "polygon": [[0, 0], [1, 0], [1, 1]] }] }');
    return answer;
  });
  assert.equal(state, "falls");
  await close();
});
