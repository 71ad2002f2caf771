/**
 * One run as this page knows it: its frames, where its time line stands, how far it is. What the stream left out (it
 * sends at most 30 frames a second, and a page that was away gets a snapshot) is fetched from the record of the run.
 * @import {Frame, LearnerInfo, Result, Run, RunStatus} from "#js/learning/types.js"
 * @import {Material} from "#js/learning/material.js"
 * @import {Snapshot} from "#js/learning/run-stream.js"
 */
import { FrameStore } from "#js/learning/frame-store.js";
import { snapshotOf } from "#js/learning/material.js";
import { RunProgress } from "#js/learning/progress.js";
import { Timeline } from "#js/learning/timeline.js";
import { ApiError, api } from "#js/lib/api.js";
import { runApi } from "#js/lib/run-address.js";

/** An answer with fewer frames than this holds the rest of the record. */
const FEW = 50;

export class WatchedRun {
  store = new FrameStore();
  timeline = new Timeline();
  /** What it learned from, where that is not what stands there now. @type {Material | null} */
  material = null;
  #heard = new Heard();
  /** @type {Promise<void> | null} */
  #filling = null;

  /**
   * @param {Run} run
   * @param {LearnerInfo[]} learners all there are
   * @param {boolean} [isOwn]
   */
  constructor(run, learners, isOwn = true) {
    this.run = run;
    this.progress = new RunProgress(run, learners, isOwn);
    for (const [learner, result] of Object.entries(run.learners)) {
      this.#seeResult(learner, result, run.compute_ms?.[learner]);
    }
  }

  get id() {
    return this.run.id;
  }

  /** The right end of the time line: the limit while learning, so that nothing moves; then what was reached. */
  get lastIteration() {
    const limit = this.progress.limit || Number(this.run.settings?.iterations ?? 500);
    return this.progress.isOver ? Math.max(1, this.timeline.last || limit) : Math.max(limit, this.timeline.last);
  }

  /** What a learner shows where the time line stands. @param {string} learner @returns {Frame | null} */
  shownOf(learner) {
    const { isFollowing, position } = this.timeline;
    return isFollowing ? this.store.latest(learner) : this.store.at(learner, position);
  }

  /** @param {Frame} frame */
  see(frame) {
    this.store.add(frame);
    this.progress.see(frame);
    this.timeline.extendTo(frame.iteration);
    this.#heard.add(frame.number);
  }

  /** @param {Result & { learner: string, number?: number }} result */
  settle({ learner, number, ...result }) {
    this.progress.settle(learner, result);
    this.#heard.add(number);
  }

  /** @param {Snapshot} snapshot */
  begin({ status, ahead, worker, latest }) {
    if (!this.progress.isOver && status === "running") this.progress.start();
    this.progress.wait({ ahead, worker });
    for (const frame of Object.values(latest)) {
      this.store.add(frame);
      this.progress.see(frame);
      this.timeline.extendTo(frame.iteration);
    }
  }

  /**
   * @param {RunStatus | "deleted"} status
   * @param {string} message
   */
  end(status, message) {
    this.progress.end(status, message);
  }

  /** Fetch what the stream did not send; one question at a time. @param {AbortSignal} signal @returns {Promise<void>} */
  fill(signal) {
    this.#filling ??= this.#fetch(signal).finally(() => {
      this.#filling = null;
    });
    return this.#filling;
  }

  /** Fetch what it learned from: since then something else was played or ranked. @param {AbortSignal} signal */
  async fetchMaterial(signal) {
    const answer = await fetch(`/api/v1${runApi(this.id, "/demonstrations.jsonl")}`, { signal }).catch(() => null);
    // Without it the boards speak of what stands there now, and the page says that this has changed.
    if (answer?.ok) this.material = snapshotOf(await answer.text());
  }

  /** @param {AbortSignal} signal */
  async #fetch(signal) {
    try {
      await Promise.all([this.#fetchFrames(signal), this.#fetchResults(signal)]);
    } catch (error) {
      // What the stream sent is on the boards; the end of the run asks again.
      if (!(error instanceof ApiError) && !signal.aborted) throw error;
    }
  }

  /** Long records come in several answers. @param {AbortSignal} signal */
  async #fetchFrames(signal) {
    let isMore = true;
    while (isMore) {
      const { frames, last } = await api.get(runApi(this.id, `/frames?after=${this.#heard.upTo}`), { signal });
      for (const frame of frames) this.see(frame);
      this.#heard.all(last);
      isMore = frames.length >= FEW;
    }
  }

  /** A learner may have come to its end in what the stream left out. @param {AbortSignal} signal */
  async #fetchResults(signal) {
    const { learners } = /** @type {Run} */ (await api.get(runApi(this.id), { signal }));
    for (const [learner, result] of Object.entries(learners)) {
      if (result.outcome && !this.progress.endingOf(learner)) this.settle({ learner, ...result });
    }
  }

  /**
   * A finished learner is on its board before the record has come.
   * @param {string} learner
   * @param {Result} result
   * @param {number | undefined} compute_ms
   */
  #seeResult(learner, result, compute_ms) {
    if (!result.policy || !result.reward || !result.visitation) return;
    const iterations = result.iterations ?? 0;
    this.store.add({
      learner,
      iteration: iterations,
      iterations,
      gap: result.gap ?? Number.NaN,
      log_likelihood: result.log_likelihood ?? null,
      reward: result.reward.flat(),
      policy: result.policy,
      visitation: result.visitation.flat(),
      compute_ms,
    });
    this.timeline.extendTo(iterations);
  }
}

/** The numbers of the events that have come: up to which one there is no gap. */
class Heard {
  #later = new Set();
  upTo = 0;

  /** @param {number | undefined} number */
  add(number) {
    if (number === undefined || number <= this.upTo) return;
    this.#later.add(number);
    while (this.#later.delete(this.upTo + 1)) this.upTo += 1;
  }

  /** @param {number} number nothing up to here is missing */
  all(number) {
    this.upTo = Math.max(this.upTo, number);
    for (const later of this.#later) if (later <= this.upTo) this.#later.delete(later);
    while (this.#later.delete(this.upTo + 1)) this.upTo += 1;
  }
}
