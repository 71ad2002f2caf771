/**
 * The head of the page: how the run stands in a sentence, and the buttons that fit that.
 * @import {LearnPageData} from "#js/learning/types.js"
 * @import {LineUp} from "#js/learning/line-up.js"
 * @import {SetUp} from "#js/learning/set-up.js"
 * @import {WatchedRun} from "#js/learning/watched-run.js"
 */
import { describeMaterial, isOtherMaterial, lacksFinished, wayThere } from "#js/learning/material.js";
import { setStep } from "#js/lib/path.js";
import { runAddress } from "#js/lib/run-address.js";

const OLD =
  "You played or ranked again after this run; the boards show what it learned from. Learn again to use what you have now.";
/** Under the finger the buttons change into each other; the focus goes along to the first of these that is there. */
const HEIRS = ["cancel", "compare", "learn", "again"];

export class Head {
  #root;
  #data;
  #lineUp;
  #setUp;

  /**
   * @param {HTMLElement} root
   * @param {LearnPageData} data
   * @param {LineUp} lineUp
   * @param {SetUp} setUp
   */
  constructor(root, data, lineUp, setUp) {
    this.#root = root;
    this.#data = data;
    this.#lineUp = lineUp;
    this.#setUp = setUp;
  }

  /**
   * @param {WatchedRun | null} watched
   * @param {{ isConnected: boolean, isAsking: boolean }} how
   */
  paint(watched, { isConnected, isAsking }) {
    const focused = document.activeElement;
    const status = watched?.progress.status ?? "none";
    const isGoing = watched !== null && !watched.progress.isOver;
    this.#say("sentence", this.#sentence(watched, isGoing && !isConnected));
    this.#root.dataset.connected = String(isConnected);
    this.#paintCompare(watched, status);
    if (this.#isOwn) this.#paintActions(watched, isGoing);
    // Not `disabled`, which would let go of the focus.
    this.#part("learn").setAttribute("aria-disabled", String(isAsking));
    this.#keepFocus(focused);
    if (status !== "none") this.#paintPath(status);
  }

  /** @param {string} sentence */
  complain(sentence) {
    this.#say("problem", sentence);
    this.#part("problem").hidden = sentence === "";
  }

  get #isOwn() {
    return this.#data.is_own ?? true;
  }

  /** @param {WatchedRun | null} watched @param {boolean} isCutOff */
  #sentence(watched, isCutOff) {
    const { demonstrations, rankings } = this.#data;
    if (!watched) return describeMaterial(demonstrations, rankings);
    const { sentence } = watched.progress;
    return isCutOff ? `${sentence} The connection was lost; trying again … The learning itself goes on.` : sentence;
  }

  /** @param {WatchedRun | null} watched @param {string} status */
  #paintCompare(watched, status) {
    const compare = this.#part("compare");
    compare.hidden = status !== "done";
    compare.href = watched ? runAddress(watched.id, "/comparison") : "#";
  }

  /** @param {WatchedRun | null} watched @param {boolean} isGoing */
  #paintActions(watched, isGoing) {
    const canLearn = this.#data.learners.some((learner) => !learner.missing);
    const isOld = watched !== null && !isGoing && isOtherMaterial(watched.run, this.#data);
    const isDone = watched?.progress.status === "done";
    this.#say("notice", isOld ? OLD : "");
    this.#part("notice").hidden = !isOld;
    this.#part("cancel").hidden = !isGoing;
    this.#part("again").hidden = !isGoing;
    this.#part("learn").hidden = isGoing || !canLearn;
    this.#part("learn").textContent = watched ? "Learn again" : "Learn";
    this.#part("learn").classList.toggle("button--primary", !isDone || isOld);
    this.#part("compare").classList.toggle("button--primary", !isOld);
    this.#part("include").hidden = isGoing || !this.#isStuckOnUnfinished;
    this.#paintWayThere(canLearn, isGoing);
  }

  get #isStuckOnUnfinished() {
    const { learners, demonstrations } = this.#data;
    const isLeftOut = this.#setUp.unfinished !== "include";
    return isLeftOut && learners.some((learner) => learner.missing && lacksFinished(demonstrations, learner));
  }

  /** The way to what the first learner that cannot start misses. @param {boolean} canLearn @param {boolean} isGoing */
  #paintWayThere(canLearn, isGoing) {
    const { world, demonstrations } = this.#data;
    const stuck = this.#lineUp.learners.find((learner) => learner.missing);
    const link = this.#part("way-there");
    link.hidden = !stuck || isGoing;
    if (!stuck) return;
    const way = wayThere(world, demonstrations, stuck, this.#setUp.unfinished);
    link.href = way.href;
    link.textContent = way.text;
    link.classList.toggle("button--primary", !canLearn);
  }

  /** @param {Element | null} focused */
  #keepFocus(focused) {
    const hasVanished = focused instanceof HTMLElement && focused.hidden && this.#root.contains(focused);
    if (!hasVanished) return;
    const heir = HEIRS.map((name) => this.#part(name)).find((one) => !one.hidden);
    heir?.focus();
  }

  /** The path at the top of the page moves on with the run. @param {string} status */
  #paintPath(status) {
    if (!this.#isOwn) return;
    setStep("learn", { state: status, isDone: status === "done" });
    if (status === "done") setStep("compare", { href: this.#part("compare").href });
  }

  /** @param {string} name @param {string} text */
  #say(name, text) {
    const part = this.#part(name);
    if (part.textContent !== text) part.textContent = text;
  }

  /** A named part of the markup; which element it is stands in the template. @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"], [data-action="${name}"]`);
  }
}
