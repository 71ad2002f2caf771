/**
 * How far a run is, in words: one line a learner and one for all of them.
 * @import {Frame, LearnerInfo, Result, Run, RunStatus} from "#js/learning/types.js"
 */
import { listed, significant } from "#js/charts/figures.js";
import { plural } from "#js/lib/format.js";

/** @typedef {"waiting" | "learning" | "learned" | "ended"} Stage */

/** Visits from which on the core, too, calls a gap wide. */
const WIDE_GAP = 0.5;
const ORDINALS = ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth"];

/** @typedef {Pick<LearnerInfo, "name" | "title" | "family" | "seeks_visits">} Known */

export class RunProgress {
  /** @type {Map<string, Frame>} */
  #latest = new Map();
  /** @type {Map<string, Result>} */
  #results = new Map();
  /** @type {RunStatus} */
  #status;
  #reason = "";
  #nLeftOut = 0;
  /** @type {string[]} */
  #learners;
  /** @type {Map<string, Known>} */
  #known;

  /**
   * @param {Pick<Run, "status" | "reason" | "learners">} run
   * @param {Known[]} learners all there are
   */
  constructor(run, learners) {
    this.#status = run.status;
    this.#reason = run.reason ?? "";
    this.#learners = Object.keys(run.learners);
    this.#known = new Map(learners.map((learner) => [learner.name, learner]));
    for (const [learner, result] of Object.entries(run.learners)) if (result.outcome) this.settle(learner, result);
  }

  get status() {
    return this.#status;
  }

  get isOver() {
    return this.#status !== "queued" && this.#status !== "running";
  }

  /** The most iterations that any learner seen so far may take. */
  get limit() {
    return Math.max(0, ...[...this.#latest.values()].map(({ iterations }) => iterations));
  }

  /** @param {Frame} frame */
  see(frame) {
    this.#latest.set(frame.learner, frame);
    if (this.#status === "queued") this.#status = "running";
  }

  /**
   * @param {string} learner
   * @param {Result} result
   */
  settle(learner, result) {
    this.#results.set(learner, result);
    this.#nLeftOut = Math.max(this.#nLeftOut, result.n_left_out ?? 0);
  }

  /**
   * @param {"done" | "failed" | "cancelled"} status
   * @param {string} [reason]
   */
  end(status, reason = "") {
    this.#status = status;
    this.#reason = reason;
  }

  /**
   * @param {string} learner
   * @returns {Stage}
   */
  stageOf(learner) {
    if (this.#results.has(learner)) return "learned";
    if (this.isOver) return "ended";
    return this.#latest.has(learner) ? "learning" : "waiting";
  }

  /**
   * The share of its iterations a learner has behind it, 0…1.
   * @param {string} learner
   */
  shareOf(learner) {
    if (this.#results.has(learner)) return 1;
    const frame = this.#latest.get(learner);
    return frame ? Math.min(1, frame.iteration / Math.max(1, frame.iterations)) : 0;
  }

  /**
   * @param {string} learner
   * @param {Frame | null} [frame] the frame on the board; the latest when left out
   */
  sentenceOf(learner, frame = this.#latest.get(learner) ?? null) {
    const stage = this.stageOf(learner);
    if (frame && frame.iterations > 1)
      return `iteration ${frame.iteration} of ${frame.iterations} · ${gapInWords(frame.gap)}`;
    if (frame) return gapInWords(frame.gap);
    if (stage === "learned") return gapInWords(this.#results.get(learner)?.gap ?? Number.NaN);
    if (stage === "ended") return "not reached";
    return this.#status === "queued" ? "waiting for a free worker" : "waiting its turn";
  }

  /**
   * How a learner ended, in the words of the server; empty while it has not.
   * @param {string} learner
   */
  outcomeOf(learner) {
    return this.#results.get(learner)?.sentence ?? "";
  }

  /** The whole run in one sentence. */
  get sentence() {
    switch (this.#status) {
      case "queued":
        return "Queued: learning starts as soon as a worker is free.";
      case "running":
        return this.#runningSentence();
      case "done":
        return this.#doneSentence();
      case "cancelled":
        return `Cancelled${this.#howFar()}. What was learned up to there stays on the boards.`;
      default:
        return `The run failed: ${this.#reason || "no reason was given"}`;
    }
  }

  #runningSentence() {
    const current = this.#learners.findLast((learner) => this.stageOf(learner) === "learning");
    if (!current) return "Learning starts …";
    if (this.#learners.length === 1) return `${this.#titleOf(current)} is learning.`;
    const place = ORDINALS[this.#learners.indexOf(current)] ?? "next";
    return `${this.#titleOf(current)} is learning, the ${place} of ${plural(this.#learners.length, "learner")}.`;
  }

  #doneSentence() {
    const diverged = this.#learners.filter((learner) => this.#results.get(learner)?.outcome === "diverged");
    const astray = this.#learners.filter((learner) => this.#isAstray(learner));
    if (diverged.length === 0 && astray.length === 0) return `${this.#everybody}.${this.#leftOut}`;
    if (diverged.length === 0)
      return `The run is done. ${listed(astray.map((learner) => this.#titleOf(learner)))} ended far from your play.${this.#leftOut}`;
    return `The run is done. ${listed(diverged.map((learner) => this.#titleOf(learner)))} ran away instead of settling.`;
  }

  /** Ended far from the play, although it sought to come near. @param {string} learner */
  #isAstray(learner) {
    const isWide = (this.#results.get(learner)?.gap ?? 0) >= WIDE_GAP;
    return isWide && (this.#known.get(learner)?.seeks_visits ?? true);
  }

  get #everybody() {
    const count = this.#learners.length;
    const who = count === 2 ? "Both learners" : `All ${count} learners`;
    const one = this.#titleOf(this.#learners[0] ?? "");
    // Some baselines learn nothing at all.
    if (this.#learners.some((learner) => this.#known.get(learner)?.family === "baseline"))
      return count === 1 ? `${one} is done` : `${who} are done`;
    return count === 1 ? `${one} has learned from your play` : `${who} have learned from your play`;
  }

  get #leftOut() {
    if (this.#nLeftOut === 0) return "";
    const verb = this.#nLeftOut === 1 ? "was" : "were";
    return ` ${plural(this.#nLeftOut, "failure")} that never reached the goal ${verb} left out.`;
  }

  #howFar() {
    const finished = this.#learners.filter((learner) => this.#results.has(learner)).length;
    return finished > 0 ? ` after ${finished} of ${plural(this.#learners.length, "learner")}` : "";
  }

  /** @param {string} learner */
  #titleOf(learner) {
    return this.#known.get(learner)?.title ?? learner.toUpperCase();
  }
}

/** @param {number} gap */
export function gapInWords(gap) {
  if (!Number.isFinite(gap)) return "the gap to your play has no bound";
  return `the gap to your play is ${significant(gap)} visits`;
}
