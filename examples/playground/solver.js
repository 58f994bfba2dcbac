// Sends requests to the workers. A worker cannot be interrupted, so only the newest request of each topic is kept:
// while the worker is busy, a newer request replaces the one that waits. Verdicts have a separate worker, so that a
// slow figure never delays them.

/** @typedef {{ value?: any, problems?: any[], error?: string, milliseconds?: number }} Answer */
/** @typedef {{ topic: string, message: any, resolve: (answer: Answer | null) => void }} Request */

/** The time limit of an analysis, in seconds. A step that takes longer is undecided. */
const PATIENCE = 10;

/** A worker with its waiting requests, at most one for each topic. */
class Lane {
  /** @param {() => Worker} start */
  constructor(start) {
    this.start = start;
    /** @type {Worker | null} */
    this.worker = null;
    /** @type {Map<string, Request>} */
    this.waiting = new Map();
    /** @type {Request | null} */
    this.current = null;
    this.id = 0;
    this.since = 0;
  }

  /** @param {string} topic @param {any} message @returns {Promise<Answer | null>} null if a newer request replaced this one */
  ask(topic, message) {
    return new Promise((resolve) => {
      this.waiting.get(topic)?.resolve(null);
      this.waiting.set(topic, { topic, message, resolve });
      this.next();
    });
  }

  next() {
    if (this.current || this.waiting.size === 0) return;
    const [request] = this.waiting.values();
    this.waiting.delete(request.topic);
    this.current = request;
    this.worker ??= this.open();
    this.since = performance.now();
    this.worker.postMessage({ ...request.message, id: ++this.id });
  }

  open() {
    const worker = this.start();
    // After a failure the library may be in any state, so the next request starts a new worker.
    const end = () => {
      worker.terminate();
      this.worker = null;
    };
    worker.onmessage = ({ data }) => {
      if (data.error) end();
      this.answer({ ...data, milliseconds: performance.now() - this.since });
    };
    worker.onerror = (event) => {
      event.preventDefault?.();
      end();
      this.answer({ error: event.message || "The solver could not be started. Is the folder pkg there?" });
    };
    return worker;
  }

  /** @param {Answer} answer */
  answer(answer) {
    const request = this.current;
    this.current = null;
    request?.resolve(answer);
    this.next();
  }
}

const startWorker = () => new Worker(new URL("./worker.js", import.meta.url), { type: "module" });

/** The number of solvers on the page. Each uses its number in its topics, so that solvers can share workers. */
let solvers = 0;

export class Solver {
  /** @param {{ fast: Lane, slow: Lane }} [lanes] workers that other solvers on the page use too */
  constructor(lanes = { fast: new Lane(startWorker), slow: new Lane(startWorker) }) {
    this.lanes = lanes;
    this.number = solvers++;
  }

  /** A solver for another structure on the page, in the same workers. */
  another() {
    return new Solver(this.lanes);
  }

  /** @param {"fast" | "slow"} lane @param {string} topic @param {any} message */
  ask(lane, topic, message) {
    return this.lanes[lane].ask(`${this.number} ${topic}`, message);
  }

  /** Requests the version and the kinds of figures. */
  about() {
    return this.ask("fast", "about", { task: "about" });
  }

  /** Requests the verdict for one step, from 0. @param {string} scene @param {number} frame */
  verdict(scene, frame) {
    return this.ask("fast", "verdict", { task: "check", scene, options: { frame: frame + 1, time_limit: PATIENCE } });
  }

  /** Requests the verdict for one step with margins. @param {string} scene @param {number} frame */
  margins(scene, frame) {
    return this.ask("slow", "margins", { task: "check", scene, options: { frame: frame + 1, margins: true, time_limit: PATIENCE } });
  }

  /** Requests the values of a number for which one step stands. @param {string} scene @param {string} name @param {[number, number]} range @param {number} frame */
  vary(scene, name, range, frame) {
    return this.ask("slow", "vary", { task: "vary", scene, name, range, frame, patience: PATIENCE });
  }

  /** @param {string} scene @param {any} options */
  figure(scene, options) {
    return this.ask("slow", "figure", { task: "figure", scene, options: { ...options, time_limit: PATIENCE } });
  }

  /** Requests the scene that a PNG or a PDF carries. @param {Uint8Array} bytes */
  sceneIn(bytes) {
    return this.ask("slow", "import", { task: "picture", bytes });
  }

  /** @param {string} text @param {string} format */
  importDrawing(text, format) {
    return this.ask("slow", "import", { task: "import", text, format });
  }
}
