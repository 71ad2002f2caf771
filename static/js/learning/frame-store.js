/**
 * The recorded frames of a run, kept by learner and iteration. A frame that comes twice (a stream that resumed) takes
 * the place of its twin, so replays do no harm; frames may come in any order.
 * @import {Frame, LearnerInfo} from "#js/learning/types.js"
 */
import { largestSize } from "#js/learning/visits.js";

/** @typedef {{ frames: Frame[], largest: number }} Track one learner's frames by rising iteration; the largest |reward| */

export class FrameStore {
  /** @type {Map<string, Track>} */
  #tracks = new Map();

  /** Rises with every frame that is added. */
  version = 0;

  /** The iterations any learner recorded, rising. */
  get iterations() {
    const all = new Set([...this.#tracks.values()].flatMap((track) => track.frames.map((frame) => frame.iteration)));
    return [...all].sort((a, b) => a - b);
  }

  /** How many frames are kept. */
  get size() {
    return [...this.#tracks.values()].reduce((sum, track) => sum + track.frames.length, 0);
  }

  /** The last iteration any learner recorded. */
  get lastIteration() {
    return Math.max(0, ...[...this.#tracks.values()].map((track) => track.frames.at(-1)?.iteration ?? 0));
  }

  /** @param {Frame} frame */
  add(frame) {
    const track = this.#trackOf(frame.learner);
    const place = firstAtOrAfter(track.frames, frame.iteration);
    const isTwin = track.frames[place]?.iteration === frame.iteration;
    track.frames.splice(place, isTwin ? 1 : 0, frame);
    track.largest = Math.max(track.largest, largestSize(frame.reward));
    this.version += 1;
  }

  /**
   * What a learner showed at an iteration: its last frame up to there, its first if that lies later.
   * @param {string} learner
   * @param {number} iteration
   * @returns {Frame | null}
   */
  at(learner, iteration) {
    const frames = this.#tracks.get(learner)?.frames ?? [];
    const after = firstAtOrAfter(frames, iteration + 1);
    return frames[Math.max(0, after - 1)] ?? null;
  }

  /** @param {string} learner */
  latest(learner) {
    return this.at(learner, Number.POSITIVE_INFINITY);
  }

  /**
   * The largest |reward| at the ends of a learner's colour scale. One that descends has one scale for its whole time line,
   * so that colours can be compared between iterations: the largest it ever showed. Others may begin anywhere, as a
   * Markov chain does, and would end pale; theirs is that of their last frame.
   * @param {Pick<LearnerInfo, "name" | "seeks_visits">} learner
   */
  largestReward({ name, seeks_visits }) {
    const track = this.#tracks.get(name);
    return seeks_visits ? (track?.largest ?? 0) : largestSize(track?.frames.at(-1)?.reward ?? []);
  }

  /**
   * One column a learner, aligned with `iterations`; null where a learner has no frame.
   * @param {string[]} learners
   * @param {"gap" | "log_likelihood"} measure
   * @returns {{ iterations: number[], columns: (number | null)[][] }}
   */
  columns(learners, measure) {
    const iterations = this.iterations;
    const rowOf = new Map(iterations.map((iteration, row) => [iteration, row]));
    const columns = learners.map((learner) => {
      /** @type {(number | null)[]} */
      const column = new Array(iterations.length).fill(null);
      for (const frame of this.#tracks.get(learner)?.frames ?? []) {
        column[rowOf.get(frame.iteration) ?? 0] = frame[measure] ?? null;
      }
      return column;
    });
    return { iterations, columns };
  }

  /** @param {string} learner */
  #trackOf(learner) {
    const track = this.#tracks.get(learner) ?? { frames: [], largest: 0 };
    this.#tracks.set(learner, track);
    return track;
  }
}

/**
 * Binary search: the place of the first frame whose iteration is not before `iteration`.
 * @param {Frame[]} frames
 * @param {number} iteration
 */
function firstAtOrAfter(frames, iteration) {
  let low = 0;
  let high = frames.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (/** @type {Frame} */ (frames[middle]).iteration < iteration) low = middle + 1;
    else high = middle;
  }
  return low;
}
