// Compares the module in pkg/ with the program: the same scenes must give the same bytes. Needs Node.js and the
// program (DRYSTONE, or target/debug/drystone).

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { root } from "./lib/root.mjs";

const top = path.resolve(root, "../..");
const program = process.env.DRYSTONE ?? path.join(top, "target/debug/drystone");
const before = process.cpuUsage();
const module = await import(path.join(root, "pkg/drystone.js"));
await module.default({ module_or_path: readFileSync(path.join(root, "pkg/drystone_bg.wasm")) });
const started = seconds(before);

/** The processor time since a moment. Unlike wall-clock time, it does not include the work of other programs. */
function seconds(/** @type {NodeJS.CpuUsage} */ since) {
  const { user, system } = process.cpuUsage(since);
  return (user + system) / 1e6;
}

/** All scene files below a folder, sorted. @param {string} folder @returns {string[]} */
function scenes(folder) {
  const entries = readdirSync(path.join(top, folder), { withFileTypes: true });
  return entries.sort((a, b) => (a.name < b.name ? -1 : 1)).flatMap((entry) => {
    const name = `${folder}/${entry.name}`;
    if (entry.isDirectory()) return entry.name === "pkg" || entry.name === "node_modules" ? [] : scenes(name);
    if (!entry.name.endsWith(".json")) return [];
    return /"drystone"\s*:\s*1\b/.test(readFileSync(path.join(top, name), "utf8").slice(0, 2000)) ? [name] : [];
  });
}

/** The output of the program, with any exit code. @param {string[]} words */
function printed(...words) {
  const { stdout, stderr, error } = spawnSync(program, words, { cwd: top, maxBuffer: 1 << 28, encoding: "utf8" });
  if (error) throw error;
  return { stdout, stderr };
}

/** Fails with only the first difference, because the texts are long. @param {string} own @param {string} program @param {string} name */
function same(own, program, name) {
  if (own === program) return;
  let at = 0;
  while (own[at] === program[at]) at++;
  const around = (/** @type {string} */ text) => text.slice(Math.max(0, at - 60), at + 60);
  assert.fail(`${name} differs at character ${at}:\n  module:  ${around(own)}\n  program: ${around(program)}`);
}

const files = ["assets", "examples", "tests/scenes"].flatMap(scenes);
const read = (/** @type {string} */ name) => readFileSync(path.join(top, name), "utf8");
/** The scenes that are compared. Large scenes are left out, because they take long. @type {string[]} */
let valid = [];

test("the first answer on the lintel, with its time", () => {
  // A browser would also download the file. Here it is read from the disk.
  const scene = read("tests/scenes/lintel.json");
  const begin = process.cpuUsage();
  assert.equal(JSON.parse(module.check(scene)).frames[0].verdict, "stable");
  const whole = started + seconds(begin);
  console.log(`processor time: ${started.toFixed(2)} s to start, ${whole.toFixed(2)} s with the answer`);
});

test("the program and the module have the same version", () => {
  assert.ok(existsSync(program), `${program} is missing: run cargo build`);
  assert.equal(execFileSync(program, ["--version"], { encoding: "utf8" }).trim().split(" ").at(-1), module.version());
});

test("at least 60 scenes are compared", () => {
  valid = files.filter((name) => read(name).length < 20_000 && module.problems(read(name)) === "[]");
  assert.ok(valid.length >= 60, `${valid.length} scenes`);
});

test("results have the same bytes", () => {
  for (const name of files.filter((name) => read(name).length < 20_000)) {
    const { stdout } = printed("check", "--json", "--no-timing", name);
    let own;
    try {
      own = module.check(read(name), JSON.stringify({ file: name }));
    } catch (error) {
      assert.deepEqual(/** @type {any} */ (error).problems, JSON.parse(stdout).problems, name);
      continue;
    }
    same(own, stdout, name);
  }
});

test("figures have the same bytes", () => {
  const kinds = JSON.parse(module.kinds()).map((/** @type {any} */ entry) => entry.kind).filter((/** @type {string} */ kind) => kind !== "freebody");
  const themes = ["thesis", "paper", "colourblind", "dark"];
  for (const [number, name] of valid.entries()) {
    const kind = kinds[number % kinds.length];
    const theme = themes[number % themes.length];
    const [options, words] = number % 3 === 0
      ? [{}, []]
      : [{ kind, theme, amounts: true, width_mm: 174 }, ["--kind", kind, "--theme", theme, "--amounts", "--width-mm", "174"]];
    const { stdout, stderr } = printed("render", name, "-o", "-", "--format", "svg", "--text", "names", "--no-source", ...words);
    assert.ok(stdout.startsWith("<svg"), `${name} ${words.join(" ")}: ${stderr}`);
    same(module.figure(read(name), JSON.stringify(options)), stdout, `${name} ${words.join(" ")}`);
  }
});

test("margins have the same bytes", () => {
  for (const name of ["assets/starter.json", "tests/scenes/lintel.json", "assets/thesis/figure-1.json"].filter((name) => valid.includes(name))) {
    const { stdout } = printed("check", "--json", "--no-timing", "--margins", name);
    same(module.check(read(name), JSON.stringify({ file: name, margins: true })), stdout, name);
  }
});

test("the forces that a block can carry and sensitivities have the same bytes", () => {
  const name = "tests/scenes/lintel.json";
  const scene = read(name);
  const { id, at } = carried(scene);
  /** @type {[any, string[]][]} */
  const cases = [
    [{ capacity: id }, ["--capacity", id]],
    [{ capacity: `${id}@${at}`, for_all: "tilt=±1,friction=0.5..0.7" }, ["--capacity", `${id}@${at}`, "--for-all", "tilt=±1,friction=0.5..0.7"]],
    [{ sensitivity: "load_factor" }, ["--sensitivity", "load_factor"]],
    [{ sensitivity: "horizontal_load" }, ["--sensitivity", "horizontal-load"]],
  ];
  for (const [options, words] of cases) {
    const { stdout } = printed("check", "--json", "--no-timing", name, ...words);
    same(module.check(scene, JSON.stringify({ file: name, ...options })), stdout, words.join(" "));
    const found = JSON.parse(stdout).frames.at(-1);
    assert.ok(options.capacity ? found.capacity.vertices.length > 0 : found.sensitivity, words.join(" "));
  }
  const words = ["--kind", "capacity", "--capacity", `${id}@${at}`];
  const { stdout } = printed("render", name, "-o", "-", "--format", "svg", "--text", "names", "--no-source", ...words);
  same(module.figure(scene, JSON.stringify({ kind: "capacity", capacity: `${id}@${at}` })), stdout, words.join(" "));
});

/** The last block of a scene, and the mean of its corners. @param {string} scene */
function carried(scene) {
  const { id, vertices } = JSON.parse(module.check(scene, '{"blocks": true}')).frames.at(-1).blocks.at(-1);
  const mean = (/** @type {number} */ axis) => vertices.reduce((/** @type {number} */ sum, /** @type {number[]} */ v) => sum + v[axis], 0) / vertices.length;
  return { id, at: `${mean(0)},${mean(1)}` };
}

test("a drawing becomes the same scene", () => {
  const drawing = module.figure(read("assets/starter.json"));
  const { stdout } = spawnSync(program, ["import", "-", "--format", "svg"], { input: drawing, encoding: "utf8" });
  assert.equal(JSON.parse(module.importDrawing(drawing, "svg")).scene, stdout);
});

test("the values of a number at which it stands are those of the program", () => {
  const name = "examples/playground/scenes/lintel.json";
  for (const [number, from, to] of [["friction", 0.1, 1], ["kernel", 0, 0.9], ["nonsense", 0, 1]]) {
    const found = JSON.parse(module.vary(read(name), number, from, to, 1, 60));
    assert.deepEqual([found[0].from, found.at(-1).to], [from, to]);
    const { stdout, stderr } = printed("vary", name, `${number}=${from}..${to}`, "--digits", "3", "--json");
    if (number === "nonsense") assert.ok(found[0].state === "no_scene" && stderr.includes("unknown key"));
    else assert.deepEqual(found.map((/** @type {any} */ f) => f.state), JSON.parse(stdout).intervals.map((/** @type {any} */ f) => f.state), number);
  }
  // Without time, nothing is decided.
  assert.deepEqual(JSON.parse(module.vary(read(name), "friction", 0, 1, 1, 0)).map((/** @type {any} */ f) => f.state), ["undecided"]);
  assert.throws(() => module.vary(read(name), "friction", 1, 0, 1, 60));
  assert.throws(() => module.vary(read(name), "friction", 0, 1, 9, 60));
});

test("a session gives what the functions give", () => {
  const [one, other] = [read("assets/starter.json"), read("assets/starter-falls.json")];
  const session = new module.Session(one);
  assert.equal(session.verdict(), "stable");
  assert.equal(session.set(other), "unstable");
  assert.equal(session.result(), module.check(other));
  assert.equal(session.figure(), module.figure(other));
  assert.throws(() => session.set("{"), (error) => /** @type {any} */ (error).problems.length === 1);
  assert.equal(session.verdict(), "unstable");
  // The result of the session does not contain the capacity of a block. The figure computes it.
  const picture = JSON.stringify({ kind: "capacity", capacity: carried(other).id });
  assert.equal(session.figure(picture), module.figure(other, picture));
});

test("the example in the documentation runs", () => {
  const page = read("src/doc/library.md");
  const example = page.split("```js\n")[1].split("```")[0].replace(/^import.*\nawait init.*\n/m, "");
  const logged = [];
  new Function("drystone", "console", example)(module, { log: (/** @type {any[]} */ ...words) => logged.push(words) });
  assert.equal(logged[0][0], "stable");
  assert.ok(logged[0][1] > 1000);
});

test("options that are not valid are refused by name", () => {
  const scene = read("assets/starter.json");
  const refused = (/** @type {() => unknown} */ work) => assert.throws(work, (error) => error instanceof Error && /** @type {any} */ (error).problems.length === 0);
  refused(() => module.check(scene, '{"margin": true}'));
  refused(() => module.check(scene, '{"frame": 99}'));
  refused(() => module.figure(scene, '{"kind": "picture"}'));
  refused(() => module.figure(scene, '{"zoom": "no such block"}'));
  refused(() => module.check(scene, '{"capacity": "no such block"}'));
  refused(() => module.check(scene, '{"for_all": "tilt=±2"}'));
  refused(() => module.check(scene, '{"sensitivity": "robots"}'));
  refused(() => module.figure(scene, '{"kind": "capacity", "capacity": "no such block"}'));
  refused(() => module.importDrawing("", "dwg"));
});
