// Asks the workers. A worker cannot be interrupted, so each topic keeps only its newest question: while an answer is
// awaited, a newer question replaces the one that waits. Verdicts have a worker of their own, so that a slow figure
// never delays them.

/** @typedef {{ value?: any, problems?: any[], error?: string, milliseconds?: number }} Answer */
/** @typedef {{ topic: string, message: any, resolve: (answer: Answer | null) => void }} Question */

/** After so many seconds the library gives up and calls a step undecided. */
const PATIENCE = 10;

class Lane {
  /** @param {() => Worker} start */
  constructor(start) {
    this.start = start;
    /** @type {Worker | null} */
    this.worker = null;
    /** @type {Map<string, Question>} */
    this.waiting = new Map();
    /** @type {Question | null} */
    this.asked = null;
    this.id = 0;
    this.since = 0;
  }

  /** @param {string} topic @param {any} message @returns {Promise<Answer | null>} null where a newer question replaced it */
  ask(topic, message) {
    return new Promise((resolve) => {
      this.waiting.get(topic)?.resolve(null);
      this.waiting.set(topic, { topic, message, resolve });
      this.next();
    });
  }

  next() {
    if (this.asked || this.waiting.size === 0) return;
    const [question] = this.waiting.values();
    this.waiting.delete(question.topic);
    this.asked = question;
    this.worker ??= this.open();
    this.since = performance.now();
    this.worker.postMessage({ ...question.message, id: ++this.id });
  }

  open() {
    const worker = this.start();
    // A library that failed may be in any state: the next question starts a new worker.
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
    const question = this.asked;
    this.asked = null;
    question?.resolve(answer);
    this.next();
  }
}

export class Solver {
  /** @param {() => Worker} [start] starts a worker that runs worker.js */
  constructor(start = () => new Worker(new URL("./worker.js", import.meta.url), { type: "module" })) {
    this.fast = new Lane(start);
    this.slow = new Lane(start);
  }

  /** Version and kinds of figures. */
  about() {
    return this.fast.ask("about", { task: "about" });
  }

  /** The verdict on one step, from 0. @param {string} scene @param {number} frame */
  verdict(scene, frame) {
    return this.fast.ask("verdict", { task: "check", scene, options: { frame: frame + 1, time_limit: PATIENCE } });
  }

  /** The same with margins. @param {string} scene @param {number} frame */
  margins(scene, frame) {
    return this.slow.ask("margins", { task: "check", scene, options: { frame: frame + 1, margins: true, time_limit: PATIENCE } });
  }

  /** @param {string} scene @param {any} options */
  figure(scene, options) {
    return this.slow.ask("figure", { task: "figure", scene, options: { ...options, time_limit: PATIENCE } });
  }

  /** @param {string} text @param {string} format */
  importDrawing(text, format) {
    return this.slow.ask("import", { task: "import", text, format });
  }
}
