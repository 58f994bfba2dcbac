// Accessibility: the playground with the keyboard, with a screen reader, in light and dark, and on a phone.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { open, sceneOf, shot, start, stop, verdict, violations, undoUntilItStands } from "./lib/page.mjs";

before(start);
after(stop);

const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 };

for (const [name, options, example] of /** @type {const} */ ([
  ["light", {}, "lintel"],
  ["dark", { colorScheme: "dark" }, "arch-thin"],
  ["phone", PHONE, "figure-4"],
  ["phone, dark", { ...PHONE, colorScheme: "dark" }, "doorway"],
])) {
  test(`axe finds nothing: ${name}`, async () => {
    const { page, close } = await open({ ...options, example });
    await page.locator("#blocks").selectOption("blocks/1");
    await page.waitForTimeout(3600);
    assert.deepEqual(await violations(page), []);
    await page.screenshot({ path: shot(name.replace(", ", "-")), fullPage: true });
    await page.fill("#source", '{ "drystone": 1, "blocks": [{ "polygon": [[0, 0], [1, 0]] }], "x": 1 }');
    await verdict(page, "wrong");
    await page.waitForTimeout(400);
    assert.deepEqual(await violations(page), []);
    await close();
  });
}

test("the button switches between light and dark, and the page remembers it", async () => {
  const { page, close } = await open();
  const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
  assert.equal(await theme(), "light");
  await page.click("#theme");
  assert.equal(await theme(), "dark");
  await page.reload();
  assert.equal(await theme(), "dark");
  await close();
});

test("nothing is wider than a phone of 360 pixels", async () => {
  for (const example of ["doorway", "figure-4", "wall"]) {
    const { page, close } = await open({ ...PHONE, viewport: { width: 360, height: 740 }, example });
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 360, example);
    await close();
  }
});

test("a finger drags a stone", async () => {
  const { page, close } = await open({ ...PHONE, example: "overhang" });
  const before = await sceneOf(page);
  await page.locator("#stage").scrollIntoViewIfNeeded();
  const box = await page.locator('[data-handle="body:blocks/4"] path').boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const touch = await page.context().newCDPSession(page);
  const send = (/** @type {string} */ type, /** @type {any[]} */ points) => touch.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  await send("touchStart", [{ x, y }]);
  for (let i = 1; i <= 10; i++) {
    await send("touchMove", [{ x: x + 6 * i, y }]);
    await page.waitForTimeout(20);
  }
  await send("touchEnd", []);
  await verdict(page, "falls");
  assert.notDeepEqual(await sceneOf(page), before);
  await close();
});

test("everything can be done with the keyboard", async () => {
  const { page, close } = await open({ example: "overhang" });
  await verdict(page, "stands");
  const { keyboard } = page;
  const active = () => page.evaluate(() => document.activeElement?.getAttribute("data-handle") ?? document.activeElement?.id ?? "");
  // The page draws in the next frame of the screen, and only then moves the focus.
  const focused = (/** @type {string} */ start) =>
    page.waitForFunction((start) => (document.activeElement?.getAttribute("data-handle") ?? document.activeElement?.id ?? "").startsWith(start), start);
  const tabTo = async (/** @type {RegExp} */ goal) => {
    for (let i = 0; i < 60; i++) {
      await keyboard.press("Tab");
      if (goal.test(await active())) return;
    }
    assert.fail(`Tab never reaches ${goal}`);
  };
  await page.evaluate(() => /** @type {HTMLElement} */ (document.activeElement)?.blur());
  await tabTo(/^body:blocks/);
  await focused("body:blocks/0");
  for (let i = 1; i <= 4; i++) {
    await keyboard.press("PageDown");
    await focused(`body:blocks/${i}`);
  }
  const outline = await page.evaluate(() => getComputedStyle(/** @type {Element} */ (document.activeElement?.querySelector("path"))).strokeWidth);
  assert.ok(parseFloat(outline) > 4, "the focus is visible");
  for (let i = 0; i < 8; i++) await keyboard.press("Shift+ArrowRight");
  await verdict(page, "falls");
  // The verdict is announced when it no longer changes.
  await page.waitForFunction(() => /^It falls/.test(document.querySelector("#announcement")?.textContent ?? ""));
  await undoUntilItStands(page, "#verdict");
  await focused("body:blocks/4");
  const original = await sceneOf(page);
  await keyboard.press("r");
  assert.notDeepEqual((await sceneOf(page)).blocks[4], original.blocks[4]);
  await keyboard.press("Control+z");
  await focused("body:blocks/4");
  await keyboard.press("Tab");
  await focused("corner:0");
  await keyboard.press("ArrowUp");
  assert.notDeepEqual((await sceneOf(page)).blocks[4], original.blocks[4]);
  await keyboard.press("Control+z");
  await focused("corner:0");
  await keyboard.press("Shift+Tab");
  await focused("body:blocks/4");
  await keyboard.press("Delete");
  assert.equal((await sceneOf(page)).blocks.length, 4);
  // Draw a polygon with the keyboard.
  await page.focus("#draw");
  await keyboard.press("Enter");
  for (const [key, times] of /** @type {const} */ ([["ArrowRight", 0], ["ArrowRight", 4], ["ArrowUp", 4], ["ArrowLeft", 4]])) {
    for (let i = 0; i < times; i++) await keyboard.press(key);
    await keyboard.press(" ");
  }
  await keyboard.press("Enter");
  assert.equal((await sceneOf(page)).blocks.length, 5);
  await focused("body:blocks");
  // Choose another figure.
  await page.focus('#tabs [aria-selected="true"]');
  await keyboard.press("ArrowRight");
  assert.equal(await page.evaluate(() => document.activeElement?.getAttribute("aria-selected")), "true");
  await close();
});
