// Runs the library in a worker, so that the page never waits for a result.
// Each message { id, task, ... } gets one answer: { id, value } or { id, problems } or { id, error }.

import init, * as drystone from "./pkg/drystone.js";

const ready = init();
// If the library cannot start, the answer to the first request contains the error. Until then, the browser must not
// report the error as unhandled.
ready.catch(() => {});

/** @type {Record<string, (message: any) => any>} */
const tasks = {
  about: () => ({ version: drystone.version(), kinds: JSON.parse(drystone.kinds()) }),
  check: ({ scene, options }) => shortened(JSON.parse(drystone.check(scene, JSON.stringify(options)))),
  figure: ({ scene, options }) => drystone.figure(scene, JSON.stringify(options)),
  problems: ({ scene }) => JSON.parse(drystone.problems(scene)),
  vary: ({ scene, name, range, frame, patience }) => JSON.parse(drystone.vary(scene, name, range[0], range[1], frame + 1, patience)),
  picture: ({ bytes }) => drystone.sceneIn(bytes),
  import: ({ text, format }) => JSON.parse(drystone.importDrawing(text, format)),
};

/** Removes the parts of a result that the page does not show, so that less is copied between threads. @param {any} result */
function shortened(result) {
  for (const frame of result.frames ?? []) {
    delete frame.effects;
    delete frame.proof;
    delete frame.solve;
    if (frame.margins) delete frame.margins.mechanisms;
  }
  return result;
}

self.onmessage = async ({ data }) => {
  try {
    await ready;
    self.postMessage({ id: data.id, value: tasks[data.task](data) });
  } catch (thrown) {
    const error = /** @type {any} */ (thrown);
    // For an invalid scene, the answer is the list of its problems, each with its line.
    if (error?.problems?.length > 0) self.postMessage({ id: data.id, problems: error.problems });
    else self.postMessage({ id: data.id, error: String(error?.message ?? error) });
  }
};
