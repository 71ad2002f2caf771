/**
 * Attempts that a reload, a crash or a closed tab left unfinished: the newest goes on by itself, the others are offered
 * while no attempt is under way. (Where they are kept: unfinished.js.)
 */

import { byId } from "#js/lib/dom.js";
import { plural } from "#js/lib/format.js";
import { damagedSentence } from "#js/worlds/saving-words.js";
import { Unfinished } from "#js/worlds/unfinished.js";

/** @typedef {import("#js/worlds/session.js").Draft} Draft */

/** Said once, where the browser's storage is full or closed. */
const NO_ROOM =
  "This browser has no room to keep an attempt while you play it: finish it before you close or reload this page.";

export class LeftBehind {
  #session;
  #isKnown;
  #warn;
  #hasWarned = false;
  #store;
  /** @type {Draft[]} newest first */
  #drafts = [];

  /**
   * @param {import("#js/board/state.js").World} world
   * @param {import("#js/worlds/session.js").PlaySession} session
   * @param {object} options
   * @param {(id: string) => boolean} options.isKnown   whether this attempt was finished and is kept elsewhere
   * @param {(sentence: string) => void} options.warn
   */
  constructor(world, session, { isKnown, warn }) {
    this.#session = session;
    this.#isKnown = isKnown;
    this.#warn = warn;
    this.#store = Unfinished.open(world);
  }

  /** Find what was left; the newest goes on if nothing else has begun. @returns {Promise<string>} what to say, or "" */
  async recall() {
    const { drafts, nDamaged } = await (await this.#store).left();
    for (const draft of drafts) if (this.#isKnown(draft.id)) this.drop(draft.id);
    this.#drafts = drafts.filter((draft) => !this.#isKnown(draft.id));
    // A result that is being read stays on the page; the attempt is offered below it.
    const welcome = this.#session.hasOwnSteps ? "" : await this.takeUp();
    this.show();
    return [welcome, nDamaged > 0 && damagedSentence(nDamaged)].filter(Boolean).join(" ");
  }

  /** Keep the present state of the attempt being played. @param {number} when */
  keep(when) {
    const { id } = this.#session.attempt;
    if (!this.#session.hasOwnSteps) return this.drop(id);
    const draft = this.#session.draft(when);
    void this.#store.then((store) => {
      store.keep(draft);
      this.#warnOnce(store.lasts);
    });
    this.show();
  }

  /** The attempt being played makes room for another, and is offered again. @param {number} when */
  setAside(when) {
    if (this.#isIdle) return;
    this.keep(when);
    this.#drafts.unshift(this.#session.draft(when));
  }

  /** @param {string} id */
  drop(id) {
    void this.#store.then((store) => store.drop(id));
  }

  /** Go on with the newest that no other tab was quicker to take. @returns {Promise<string>} what to say, or "" */
  async takeUp() {
    const offered = this.#drafts.shift();
    if (!offered) return this.#offerNothing();
    const { isOver } = this.#session;
    const draft = await (await this.#store).take(offered.id);
    if (!draft) return this.takeUp();
    // Somebody quick has begun, or even finished, another attempt meanwhile.
    if (!this.#isIdle || this.#session.isOver !== isOver) return this.#putBack(draft);
    const now = performance.now();
    if (!this.#session.resume(draft, now, Math.max(0, Date.now() - draft.savedAt))) {
      this.drop(draft.id);
      return this.takeUp();
    }
    this.keep(now);
    return `Welcome back: you stood at step ${draft.actions.length}. Play on, or restart.`;
  }

  /** The person does not want the newest. Another tab that has taken it up meanwhile keeps it. */
  async forget() {
    const offered = this.#drafts.shift();
    this.show();
    if (offered && (await (await this.#store).take(offered.id))) this.drop(offered.id);
  }

  /** Offer what is left while no attempt is under way. */
  show() {
    const [draft] = this.#drafts;
    byId("left").hidden = draft === undefined || !this.#isIdle;
    if (draft === undefined) return;
    const words = `You also left an attempt after ${plural(draft.actions.length, "step")}.`;
    byId("left-words").textContent = words;
  }

  /** @param {boolean} lasts whether the step before was kept */
  #warnOnce(lasts) {
    if (lasts || this.#hasWarned) return;
    this.#hasWarned = true;
    this.#warn(NO_ROOM);
  }

  #offerNothing() {
    this.show();
    return "";
  }

  /** @param {Draft} draft */
  #putBack(draft) {
    this.#drafts.unshift(draft);
    this.show();
    return "";
  }

  get #isIdle() {
    return this.#session.isOver || !this.#session.hasOwnSteps;
  }
}
