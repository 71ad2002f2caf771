/**
 * The controls of the time line: the slider, the button that plays back, and where it stands in words.
 * @import {WatchedRun} from "#js/learning/watched-run.js"
 */
import { Timeline } from "#js/learning/timeline.js";

const NOWHERE = new Timeline();
/** A page that was not painted for a while does not leap: a frame moves the playback on by so much at most (ms). */
const LONGEST_FRAME_MS = 100;

export class Playback {
  #root;
  /** @type {WatchedRun | null} */
  #watched = null;
  #paintedAt = 0;

  /** @param {HTMLElement} root */
  constructor(root) {
    this.#root = root;
  }

  /** @param {AbortSignal} signal @param {() => void} moved */
  start(signal, moved) {
    const range = this.#part("range");
    range.addEventListener("input", () => this.moveTo(Number(range.value), moved), { signal });
    this.#part("play-back").addEventListener("click", () => this.#toggle(moved), { signal });
  }

  /** All boards show this iteration. @param {number} iteration @param {() => void} moved */
  moveTo(iteration, moved) {
    this.#watched?.timeline.moveTo(iteration);
    moved();
  }

  /** Go on, if it plays. @param {WatchedRun | null} watched @param {number} now of this animation frame */
  advance(watched, now) {
    this.#watched = watched;
    watched?.timeline.advance(Math.min(LONGEST_FRAME_MS, Math.max(0, now - this.#paintedAt)));
    this.#paintedAt = now;
    return watched?.timeline.isPlaying ?? false;
  }

  paint() {
    const { position, isPlaying } = this.#watched?.timeline ?? NOWHERE;
    const isEmpty = (this.#watched?.store.size ?? 0) === 0;
    const range = this.#part("range");
    range.max = String(this.#watched?.lastIteration ?? 1);
    range.value = String(position);
    range.disabled = isEmpty;
    range.setAttribute("aria-valuetext", `iteration ${position}`);
    this.#say("position", `iteration ${position}`);
    this.#part("play-back").disabled = isEmpty;
    this.#part("play-back").setAttribute("aria-pressed", String(isPlaying));
    this.#part("play-icon").hidden = isPlaying;
    this.#part("pause-icon").hidden = !isPlaying;
    this.#say("play-word", isPlaying ? "Pause" : "Play back");
  }

  /** @param {() => void} moved */
  #toggle(moved) {
    const timeline = this.#watched?.timeline;
    if (!timeline) return;
    if (timeline.isPlaying) timeline.pause();
    else timeline.play();
    this.#paintedAt = performance.now();
    moved();
  }

  /** @param {string} name @param {string} text */
  #say(name, text) {
    const part = this.#part(name);
    if (part.textContent !== text) part.textContent = text;
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"], [data-action="${name}"]`);
  }
}
