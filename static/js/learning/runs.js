/**
 * All runs of this world that the page knows, newest first: which is on the boards, what they wait for, how each goes on,
 * by one stream for all.
 * @import {LearnPageData, Run} from "#js/learning/types.js"
 * @import {Listener} from "#js/learning/run-stream.js"
 */
import { isOtherMaterial } from "#js/learning/material.js";
import { RunStream } from "#js/learning/run-stream.js";
import { WatchedRun } from "#js/learning/watched-run.js";
import { ApiError, api } from "#js/lib/api.js";

/** The server follows so many at once. */
const MOST_FOLLOWED = 20;

/**
 * @typedef {object} Heed
 * @property {() => void} changed                                       something is to be painted anew
 * @property {(run: WatchedRun, learner: string) => void} learned       a learner has come to its end
 * @property {(run: WatchedRun) => void} ended
 */

export class Runs {
  #data;
  #heed;
  #signal;
  #stream;
  /** @type {WatchedRun[]} */
  #all = [];
  /** @type {WatchedRun | null} */
  #shown = null;
  isConnected = true;

  /**
   * @param {LearnPageData} data
   * @param {Heed} heed
   * @param {AbortSignal} signal
   */
  constructor(data, heed, signal) {
    this.#data = data;
    this.#heed = heed;
    this.#signal = signal;
    this.#stream = new RunStream(this.#listener(), signal);
  }

  /** Newest first. */
  get all() {
    return this.#all;
  }

  /** The run on the boards; null while another is thought of. */
  get shown() {
    return this.#shown;
  }

  /** Those that go on beside the one on the boards. */
  get others() {
    return this.#all.filter((one) => one !== this.#shown && !one.progress.isOver);
  }

  /** Put a run on the boards, and follow it. @param {Run} run */
  show(run) {
    const watched = this.#watched(run);
    this.#shown = watched;
    this.#follow();
    if (watched.progress.isOver) void this.#fill(watched);
    if (!watched.material && isOtherMaterial(run, this.#data)) void this.#fetchMaterial(watched);
  }

  /** Nothing is on the boards; what goes on goes on. */
  showNone() {
    this.#shown = null;
    this.#follow();
  }

  /** The list as the server has it: runs that were asked for before, or on another page. */
  async load() {
    try {
      const runs = /** @type {Run[]} */ (
        await api.get(`/worlds/${this.#data.world.id}/runs`, { signal: this.#signal })
      );
      for (const run of runs) this.#watched(run);
      this.#follow();
      this.#heed.changed();
    } catch (error) {
      // The list is for convenience: without it the run on the boards goes on.
      if (!(error instanceof ApiError) && !this.#signal.aborted) throw error;
    }
  }

  /** @param {string} id */
  find(id) {
    return this.#all.find((one) => one.id === id);
  }

  /** It is no more. @param {string} id */
  forget(id) {
    this.#all = this.#all.filter((one) => one.id !== id);
    this.#follow();
    this.#heed.changed();
  }

  /** @param {Run} run */
  #watched(run) {
    const known = this.find(run.id);
    if (known) return known;
    const watched = new WatchedRun(run, this.#data.learners, this.#data.is_own ?? true);
    this.#all = [watched, ...this.#all].sort((a, b) => b.run.created_at.localeCompare(a.run.created_at));
    return watched;
  }

  #follow() {
    const going = this.#all.filter((one) => !one.progress.isOver);
    // The one on the boards first: no limit may cut it off.
    going.sort((a, b) => Number(b === this.#shown) - Number(a === this.#shown));
    const ids = going.slice(0, MOST_FOLLOWED).map(({ id }) => id);
    this.#stream.follow(ids, this.#shown && !this.#shown.progress.isOver ? [this.#shown.id] : []);
  }

  /** @returns {Listener} */
  #listener() {
    return {
      snapshot: this.#heard((watched, snapshot) => {
        const isBehind = snapshot.number > 0;
        watched.begin(snapshot);
        if (isBehind && watched === this.#shown) void this.#fill(watched);
      }),
      frame: this.#heard((watched, frame) => watched.see(frame)),
      progress: this.#heard((watched, step) => watched.progress.see(step)),
      learner: this.#heard((watched, result) => {
        watched.settle(result);
        this.#heed.learned(watched, result.learner);
      }),
      queue: this.#heard((watched, waiting) => watched.progress.wait(waiting)),
      end: this.#heard((watched, status, message) => {
        watched.end(status, message);
        if (status !== "deleted") void this.#fill(watched);
        else if (watched !== this.#shown) this.forget(watched.id);
        this.#heed.ended(watched);
        this.#follow();
      }),
      connection: (isConnected) => {
        this.isConnected = isConnected;
        this.#heed.changed();
      },
    };
  }

  /**
   * @template {unknown[]} Told
   * @param {(watched: WatchedRun, ...told: Told) => void} act
   * @returns {(id: string, ...told: Told) => void}
   */
  #heard(act) {
    return (id, ...told) => {
      const watched = this.find(id);
      if (!watched) return;
      act(watched, ...told);
      this.#heed.changed();
    };
  }

  /** @param {WatchedRun} watched */
  async #fetchMaterial(watched) {
    await watched.fetchMaterial(this.#signal);
    this.#heed.changed();
  }

  /** @param {WatchedRun} watched */
  async #fill(watched) {
    if (watched !== this.#shown) return;
    await watched.fill(this.#signal);
    this.#heed.changed();
  }
}
