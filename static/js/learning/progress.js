/**
 * How far a run is, in words: one line a learner and one for all of them.
 * @import {Frame, LearnerInfo, Result, Run, RunStatus, WorkerState} from "#js/learning/types.js"
 */
import { listed, significant } from "#js/charts/figures.js";
import { durationInWords, waitingInWords } from "#js/learning/run-words.js";
import { plural } from "#js/lib/format.js";

/** @typedef {"waiting" | "learning" | "learned" | "ended"} Stage */

/** Visits from which on the core, too, calls a gap wide. */
const WIDE_GAP = 0.5;
const ORDINALS = ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth"];

/** @typedef {Pick<LearnerInfo, "name" | "title" | "family" | "seeks_visits">} Known */

/** How far a learner is; all there is of a run whose frames nobody looks at. @typedef {Pick<Frame, "learner" | "iteration" | "iterations"> & Partial<Frame>} Step */

export class RunProgress {
  /** @type {Map<string, Step>} */
  #latest = new Map();
  /** @type {Map<string, Result>} */
  #results = new Map();
  /** @type {RunStatus | "deleted"} */
  #status;
  #reason = "";
  /** @type {number | null | undefined} */
  #ahead;
  /** @type {WorkerState | undefined} */
  #worker;
  #whose;
  #nLeftOut = 0;
  /** @type {string[]} */
  #learners;
  /** @type {Map<string, Known>} */
  #known;

  /**
   * @param {Pick<Run, "status" | "reason" | "learners" | "ahead" | "worker">} run
   * @param {Known[]} learners all there are
   * @param {boolean} [isOwn] false: somebody else played
   */
  constructor(run, learners, isOwn = true) {
    this.#status = run.status;
    this.#reason = run.reason ?? "";
    this.#whose = isOwn ? "your" : "the player’s";
    this.wait(run);
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

  /** How many runs come before it while it waits; null when it does not. */
  get ahead() {
    return this.#ahead;
  }

  /** What the workers do. */
  get worker() {
    return this.#worker;
  }

  /** @param {Step} step a frame, or only how far a learner is */
  see(step) {
    this.#latest.set(step.learner, step);
    this.start();
  }

  /** A worker has taken it. */
  start() {
    if (this.#status === "queued") this.#status = "running";
  }

  /** @param {{ ahead?: number | null, worker?: WorkerState }} waiting */
  wait({ ahead, worker }) {
    this.#ahead = ahead;
    this.#worker = worker ?? this.#worker;
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
   * @param {RunStatus | "deleted"} status
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

  /** The share of all learners' iterations that lies behind, 0…1. */
  get share() {
    if (this.#status === "done") return 1;
    const shares = this.#learners.map((learner) => this.shareOf(learner));
    return shares.reduce((sum, share) => sum + share, 0) / Math.max(1, shares.length);
  }

  /**
   * @param {string} learner
   * @param {Step | null} [frame] the frame on the board; the latest when left out
   */
  sentenceOf(learner, frame = this.#latest.get(learner) ?? null) {
    const stage = this.stageOf(learner);
    if (frame) return [...howFarInWords(frame), gapInWords(frame.gap)].join(" · ");
    if (stage === "learned") return gapInWords(this.#results.get(learner)?.gap);
    if (stage === "ended") return "not reached";
    return this.#status === "queued" ? "waiting" : "waiting its turn";
  }

  /**
   * How a learner ended, in the words of the server; empty while it has not.
   * @param {string} learner
   */
  outcomeOf(learner) {
    return this.#results.get(learner)?.sentence ?? "";
  }

  /** @param {string} learner */
  endingOf(learner) {
    return this.#results.get(learner)?.outcome ?? null;
  }

  /** The whole run in one sentence. */
  get sentence() {
    switch (this.#status) {
      case "queued":
        return waitingInWords(this.#ahead, this.#worker);
      case "running":
        return this.#runningSentence();
      case "done":
        return this.#doneSentence();
      case "cancelled":
        return `Cancelled${this.#howFar()}. What was learned up to there stays on the boards.`;
      case "deleted":
        return "This run was deleted. What you see is all that is left of it.";
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
      return `The run is done. ${listed(astray.map((learner) => this.#titleOf(learner)))} ended far from ${this.#whose} play.${this.#leftOut}`;
    return (
      `The run is done. ${listed(diverged.map((learner) => this.#titleOf(learner)))} ran away instead of settling: ` +
      "shown are the last weights that were finite numbers. A smaller learning rate α or a larger λ_min keeps it in hand."
    );
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
    return count === 1 ? `${one} has learned from ${this.#whose} play` : `${who} have learned from ${this.#whose} play`;
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

/** @param {number | null | undefined} gap */
function gapInWords(gap) {
  if (gap === undefined) return "learning";
  if (gap === null || !Number.isFinite(gap)) return "the gap has no bound";
  return `gap ${significant(gap)} visits`;
}

/** @param {Step} frame */
function howFarInWords({ iteration, iterations, compute_ms }) {
  const words = [];
  if (iterations > 1) words.push(`iteration ${iteration} of ${iterations}`);
  if (compute_ms !== undefined && iteration > 0) words.push(durationInWords(compute_ms));
  return words;
}
