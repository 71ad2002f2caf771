/**
 * What a person can do with runs: ask for one, cancel one, think of another, delete one. Refusals are said on the page.
 * @import {LearnPageData, Run} from "#js/learning/types.js"
 * @import {Head} from "#js/learning/head.js"
 * @import {LineUp} from "#js/learning/line-up.js"
 * @import {Runs} from "#js/learning/runs.js"
 * @import {SetUp} from "#js/learning/set-up.js"
 * @import {WatchedRun} from "#js/learning/watched-run.js"
 */
import { announce } from "#js/lib/announce.js";
import { ApiError, api } from "#js/lib/api.js";

const DOUBLE_PRESS_MS = 600;

/**
 * @typedef {object} Page
 * @property {HTMLElement} root
 * @property {LearnPageData} data
 * @property {Runs} runs
 * @property {Head} head
 * @property {SetUp} setUp
 * @property {LineUp} lineUp
 * @property {(run: Run | null) => void} show   put a run on the boards, or none
 * @property {() => void} changed
 */

export class Commands {
  #page;
  #askedAt = Number.NEGATIVE_INFINITY;
  isAsking = false;

  /** @param {Page} page */
  constructor(page) {
    this.#page = page;
  }

  /** Ask for a run of the chosen learners and watch it. */
  async learn() {
    const { data, head, lineUp, setUp, show, changed } = this.#page;
    if (this.isAsking) return;
    const learners = lineUp.chosen;
    const asked = setUp.read();
    if (learners.length === 0) return head.complain("Choose at least one learner: tick the box above its board.");
    if (!asked) return setUp.open();
    const body = { learners, settings: asked.settings, ...(asked.seed === null ? {} : { seed: asked.seed }) };
    this.isAsking = true;
    this.#askedAt = performance.now();
    head.complain("");
    changed();
    await this.#try(async () => {
      const run = /** @type {Run} */ (await api.post(`/worlds/${data.world.id}/runs`, body));
      show(run);
      announce("Learning has been asked for.");
    });
    this.isAsking = false;
    changed();
  }

  /** Cancel the run on the boards. The button stands where Learn was: the second press of a double press means nothing. */
  async cancelShown() {
    const run = this.#page.runs.shown;
    if (run && performance.now() - this.#askedAt >= DOUBLE_PRESS_MS) await this.cancel(run);
  }

  /** @param {WatchedRun} run */
  async cancel(run) {
    await this.#try(() => api.post(`/runs/${run.id}/cancellation`, {}));
  }

  /** Think of another run, beginning with what this one had; it goes on meanwhile. @param {WatchedRun | null} [run] */
  again(run = this.#page.runs.shown) {
    const { setUp, show, changed } = this.#page;
    show(null);
    if (run) setUp.fill(run.run.settings, Object.keys(run.run.learners));
    setUp.open();
    this.#part("learn").focus();
    announce("Choose other settings, then Learn. What is learning goes on.");
    changed();
  }

  /** Learn from failures that never reached the goal, too. */
  includeUnfinished() {
    this.#page.setUp.includeUnfinished();
    announce("Failures that never reached the goal are included now.");
    this.#part(this.#part("learn").hidden ? "cancel" : "learn").focus();
    this.#page.changed();
  }

  /** Ask first: nothing brings a run back. @param {WatchedRun} run */
  async remove(run) {
    if (!(await this.#isSure())) return;
    await this.#try(async () => {
      await api.delete(`/runs/${run.id}`);
      if (run === this.#page.runs.shown) this.#page.show(null);
      this.#page.runs.forget(run.id);
      announce("The run is deleted.");
      this.#focusAfterRemoval();
    });
  }

  /** The button that was pressed is gone with its line. */
  #focusAfterRemoval() {
    const title = this.#part("runs-title");
    (title.checkVisibility() ? title : this.#part("learn")).focus();
  }

  /** @returns {Promise<boolean>} */
  #isSure() {
    const dialog = /** @type {HTMLDialogElement} */ (this.#part("question"));
    dialog.returnValue = "";
    dialog.showModal();
    return new Promise((resolve) => {
      dialog.addEventListener("close", () => resolve(dialog.returnValue === "yes"), { once: true });
    });
  }

  /** @param {() => Promise<unknown>} act */
  async #try(act) {
    try {
      await act();
    } catch (error) {
      this.#refused(error);
    }
  }

  /** @param {unknown} error */
  #refused(error) {
    if (!(error instanceof ApiError)) throw error;
    const { setUp, head } = this.#page;
    const known = Object.entries(error.fields).filter(([name, sentence]) =>
      setUp.complain(name.split(".").at(-1) ?? "", String(sentence)),
    );
    if (known.length > 0) setUp.open();
    head.complain(error.message);
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#page.root.querySelector(`[data-part="${name}"], [data-action="${name}"]`);
  }
}
