/**
 * The events of all runs on the page, by one connection: whatever is read from the wire is read here.
 *
 * The browser's EventSource reconnects by itself and says where it stopped (`Last-Event-ID`). Where it gives up (a proxy
 * answered for a server that was away, a run was deleted, everything had ended), this asks how each run stands and goes
 * on with those that go on; a stream that begins anew begins with a snapshot, so nothing has to be remembered.
 * @import {Frame, Result, RunStatus, WorkerState} from "#js/learning/types.js"
 */
import { ApiError, api } from "#js/lib/api.js";
import { runApi, sharedKey } from "#js/lib/run-address.js";

/** @typedef {{ ahead: number | null, worker?: WorkerState }} Waiting */
/** @typedef {{ status: RunStatus, reason: string | null, number: number, latest: Record<string, Frame> } & Waiting} Snapshot */

/**
 * What a page hears. Numbers are those of the events in their run: what came, and what did not, can be told by them.
 * @typedef {object} Listener
 * @property {(runId: string, snapshot: Snapshot) => void} snapshot
 * @property {(runId: string, frame: Frame) => void} frame
 * @property {(runId: string, at: { learner: string, iteration: number, iterations: number, number: number }) => void} progress
 * @property {(runId: string, result: Result & { learner: string, number: number }) => void} learner
 * @property {(runId: string, waiting: Waiting) => void} queue
 * @property {(runId: string, status: RunStatus | "deleted", message: string, number: number | null) => void} end
 * @property {(isConnected: boolean) => void} connection
 */

/** Where the server is away for longer, the waits grow (ms). */
const WAITS_MS = [500, 1_000, 2_000, 4_000, 8_000];
/** A page that is seen again, and has heard nothing for so long, may hold a connection that died in its sleep (ms). */
const SILENCE_MS = 5_000;

export class RunStream {
  #listener;
  /** @type {string[]} runs that have not ended */
  #runs = [];
  /** @type {string[]} those of which every frame is wanted */
  #frames = [];
  /** @type {EventSource | null} */
  #source = null;
  #nFailures = 0;
  #timer = 0;
  #heardAt = 0;

  /**
   * @param {Listener} listener
   * @param {AbortSignal} signal
   */
  constructor(listener, signal) {
    this.#listener = listener;
    const wake = () => this.#wake();
    for (const type of ["visibilitychange", "resume"]) document.addEventListener(type, wake, { signal });
    for (const type of ["online", "pageshow"]) window.addEventListener(type, wake, { signal });
    signal.addEventListener("abort", () => this.follow([], []));
  }

  /**
   * Follow these runs from now on.
   * @param {string[]} runs
   * @param {string[]} frames those of which every frame is wanted
   */
  follow(runs, frames) {
    const isSame = String(runs) === String(this.#runs) && String(frames) === String(this.#frames);
    if (isSame) return;
    [this.#runs, this.#frames] = [runs, frames];
    this.#open();
  }

  #open() {
    this.#close();
    if (this.#runs.length === 0) return;
    const source = new EventSource(address(this.#runs, this.#frames));
    this.#source = source;
    this.#heardAt = performance.now();
    source.addEventListener("open", () => this.#connected());
    source.addEventListener("error", () => this.#failed(source));
    for (const kind of ["snapshot", "frame", "progress", "learner", "queue", "done", "failed"]) {
      source.addEventListener(kind, (event) => this.#hear(kind, JSON.parse(/** @type {MessageEvent} */ (event).data)));
    }
  }

  #close() {
    clearTimeout(this.#timer);
    this.#source?.close();
    this.#source = null;
  }

  /**
   * @param {string} kind
   * @param {any} data
   */
  #hear(kind, { run_id, ...data }) {
    this.#heardAt = performance.now();
    if (kind === "snapshot") this.#hearSnapshot(run_id, data);
    else if (kind === "done" || kind === "failed") this.#ended(run_id, data.status, data.message ?? "", data.number);
    else if (kind === "frame") this.#listener.frame(run_id, data);
    else if (kind === "progress") this.#listener.progress(run_id, data);
    else if (kind === "learner") this.#listener.learner(run_id, data);
    else this.#listener.queue(run_id, data);
  }

  /** @param {string} runId @param {Snapshot} snapshot */
  #hearSnapshot(runId, snapshot) {
    this.#listener.snapshot(runId, snapshot);
    const { status, reason, number } = snapshot;
    if (status !== "queued" && status !== "running") this.#ended(runId, status, reason ?? "", number);
  }

  /**
   * @param {string} runId
   * @param {RunStatus | "deleted"} status
   * @param {string} message
   * @param {number | null} [number]
   */
  #ended(runId, status, message, number = null) {
    if (!this.#runs.includes(runId)) return;
    this.#listener.end(runId, status, message, number);
    this.#runs = this.#runs.filter((one) => one !== runId);
    this.#frames = this.#frames.filter((one) => one !== runId);
    // The browser would come back to a stream that ended, for ever.
    if (this.#runs.length === 0) this.#close();
  }

  #connected() {
    this.#nFailures = 0;
    this.#listener.connection(true);
  }

  /** @param {EventSource} source */
  #failed(source) {
    if (source !== this.#source) return;
    if (source.readyState === EventSource.CONNECTING) this.#listener.connection(false);
    else void this.#recover();
  }

  /** The browser has given up: ask how every run stands, and follow those that go on. */
  async #recover() {
    this.#close();
    const source = this.#source;
    const answers = await Promise.all(this.#runs.map((id) => standing(id)));
    if (source !== this.#source) return;
    for (const answer of answers)
      if (answer && answer.status !== "away") this.#ended(answer.id, answer.status, answer.reason);
    if (this.#runs.length === 0) return;
    if (answers.some((answer) => answer?.status === "away")) this.#listener.connection(false);
    const wait = WAITS_MS[Math.min(this.#nFailures, WAITS_MS.length - 1)];
    this.#nFailures += 1;
    this.#timer = window.setTimeout(() => this.#open(), wait);
  }

  /** The page is seen again, or the network is back. */
  #wake() {
    if (document.visibilityState === "hidden" || this.#runs.length === 0) return;
    const isAlive = this.#source?.readyState === EventSource.OPEN;
    if (!isAlive || performance.now() - this.#heardAt > SILENCE_MS) this.#open();
  }
}

/**
 * How a run stands that the stream no longer tells of: null while it goes on.
 * @param {string} id
 * @returns {Promise<{ id: string, status: RunStatus | "deleted", reason: string } | { status: "away" } | null>}
 */
async function standing(id) {
  try {
    const { status, reason } = await api.get(runApi(id));
    return status === "queued" || status === "running" ? null : { id, status, reason: reason ?? "" };
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    return error.isTemporary ? { status: "away" } : { id, status: "deleted", reason: error.message };
  }
}

/**
 * @param {string[]} runs
 * @param {string[]} frames
 */
function address(runs, frames) {
  const query = new URLSearchParams([...runs.map((id) => ["run", id]), ...frames.map((id) => ["frames", id])]);
  const key = sharedKey();
  if (key !== null) query.set("key", key);
  return `/api/v1/events?${query}`;
}
