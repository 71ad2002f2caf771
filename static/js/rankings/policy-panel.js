/**
 * "What it would learn from this order": asks the server whenever the order is another one, and shows the answer when it
 * comes. Nothing waits for it. What nobody looks at is not asked for.
 */

import { api } from "#js/lib/api.js";
import { byId } from "#js/lib/dom.js";
import { flat } from "#js/rankings/order.js";
import * as material from "#js/rankings/policy-material.js";
import { PolicyPicture } from "#js/rankings/policy-picture.js";
import { inTurns, Previews } from "#js/rankings/policy-previews.js";

/** @typedef {import("#js/rankings/policy-material.js").Learner} Learner */
/** @typedef {import("#js/rankings/policy-material.js").Preview} Preview */
/** @typedef {import("#js/rankings/policy-material.js").Question} Question */
/** @typedef {import("#js/lib/api.js").ApiError} ApiError */

/** What the person chose here is no work of theirs: it stays in this browser. */
const KEY = "irlfr:policy";

export class PolicyPanel {
  #parts;
  #box = /** @type {HTMLDetailsElement} */ (byId("policy"));
  #picture;
  #previews;
  /** @type {Learner | null} */
  #wish = null;
  #isSeen = false;
  /** What was looked at last. @type {import("#js/rankings/policy-material.js").Orders | null} */
  #orders = null;
  /** What is shown. @type {{preview: Preview, question: Question} | null} */
  #shown = null;
  #nShown = 0;
  /** @type {Set<() => void>} */
  #listeners = new Set();

  /** @param {import("#js/rankings/rank.js").Parts} parts */
  constructor(parts) {
    this.#parts = parts;
    this.#picture = new PolicyPicture(byId("policy-picture"), parts.world);
    const path = `/worlds/${parts.world.id}/previews`;
    /** Asks the server, one question after the other. */
    this.post = inTurns((question, options) => api.post(path, question, options));
    this.#previews = new Previews(this.post, {
      onAnswer: (preview, question) => this.#show(preview, question),
      onRefusal: (error) => this.#refuse(error),
      onAsking: (isAsking) => this.#box.toggleAttribute("data-asking", isAsking),
    });
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    this.#recall();
    this.#box.addEventListener("toggle", () => this.#remember(), { signal });
    this.#box.addEventListener("change", (event) => this.#choose(event), { signal });
    window.addEventListener("online", () => this.#look({ isAnew: true }), { signal });
    this.#parts.sitting.subscribe(() => this.#look());
    const eye = new IntersectionObserver((seen) => this.#see(seen.at(-1)?.isIntersecting ?? false), {
      rootMargin: "200px",
    });
    eye.observe(byId("policy-body"));
    signal.addEventListener("abort", () => {
      eye.disconnect();
      this.#previews.stop();
    });
    this.#look();
  }

  /** What is shown, if it is of the order as it stands. @returns {{learner: Learner, preview: Preview} | null} */
  get current() {
    if (!this.#shown) return null;
    const { preview, question } = this.#shown;
    const isOfNow = isSame(question, material.questionOf(question.learner, this.#parts.sitting.orders));
    return isOfNow ? { learner: question.learner, preview } : null;
  }

  /** Whenever `current` may be another. @param {() => void} listener */
  subscribe(listener) {
    this.#listeners.add(listener);
  }

  /** @param {Event} event */
  #choose({ target }) {
    if (!(target instanceof HTMLInputElement)) return;
    this.#wish = /** @type {Learner} */ (target.value);
    this.#remember();
    this.#previews.stop();
    this.#look({ isAnew: true });
  }

  /** @param {boolean} isSeen */
  #see(isSeen) {
    this.#isSeen = isSeen;
    this.#look({ isAnew: isSeen });
  }

  /** Most events of a sitting leave the orders as they are. @param {{isAnew?: boolean}} [how] */
  #look({ isAnew = false } = {}) {
    const { orders } = this.#parts.sitting;
    if (orders === this.#orders && !isAnew) return;
    this.#orders = orders;
    const found = material.materialOf(orders, this.#parts.demonstrations);
    const able = material.BY_PREFERENCE.filter((learner) => material.canLearn(found, learner));
    const learner = able.find((one) => one === this.#wish) ?? able[0];
    this.#offer(able, learner);
    if (!learner) this.#miss(found);
    else if (this.#isSeen && this.#box.open) this.#previews.ask(material.questionOf(learner, orders));
  }

  /** @param {Learner[]} able @param {Learner | undefined} learner */
  #offer(able, learner) {
    const choice = byId("policy-learners");
    choice.hidden = able.length < 2;
    for (const radio of choice.querySelectorAll("input")) {
      const isAble = able.some((one) => one === radio.value);
      radio.checked = radio.value === learner;
      radio.disabled = !isAble;
      /** @type {HTMLElement} */ (radio.parentElement).hidden = !isAble;
    }
  }

  /** @param {import("#js/rankings/policy-material.js").Material} found */
  #miss(found) {
    this.#previews.stop();
    this.#shown = null;
    this.#box.dataset.state = "missing";
    this.#tell(material.missingWords(found), "");
  }

  /** @param {Preview} preview @param {Question} question */
  #show(preview, question) {
    const { world, demonstrations, sitting } = this.#parts;
    const { learner } = question;
    const before = this.#shown?.question.learner === learner ? this.#shown.preview : null;
    const turned = before ? material.turnedIn(world, before.policy, preview.policy) : [];
    const found = material.materialOf(sitting.orders, demonstrations);
    this.#picture.show(preview, { turned, unknown: this.#unknownTo(question) });
    this.#shown = { preview, question };
    this.#nShown += 1;
    Object.assign(this.#box.dataset, { state: "shown", shown: this.#nShown, learner, turned: turned.length });
    const lead = material.leadWords(world, preview.policy);
    this.#tell(before ? `${material.turnedWords(turned.length)} ${lead}` : lead, material.usedWords(learner, found));
    for (const listener of this.#listeners) listener();
  }

  /** Squares that none of its attempts came to. @param {Question} question @returns {boolean[]} */
  #unknownTo({ orders }) {
    const { world, demonstrations } = this.#parts;
    const unknown = new Array(world.rows * world.cols).fill(true);
    for (const wall of world.walls) unknown[wall] = false;
    const used = [...flat(orders.success ?? []), ...flat(orders.failure ?? [])].map((id) => demonstrations.get(id));
    for (const { outcome, ending, states } of used)
      if (outcome === "success" || ending === "goal") for (const state of states) unknown[state] = false;
    return unknown;
  }

  /** What was shown stays, and is said to be of an earlier order. @param {ApiError} error */
  #refuse(error) {
    this.#box.dataset.state = "refused";
    const sentence = error.status === 0 ? "No connection just now." : error.message;
    this.#tell(this.#shown ? `${sentence} The picture is of an earlier order.` : sentence, "");
  }

  /** @param {string} sentence @param {string} beside */
  #tell(sentence, beside) {
    byId("policy-told").textContent = sentence;
    byId("policy-used").textContent = beside;
  }

  #recall() {
    try {
      const { isOpen = true, learner = null } = JSON.parse(localStorage.getItem(KEY) ?? "{}");
      this.#box.open = isOpen === true;
      this.#wish = learner;
    } catch {
      // A browser that keeps nothing shows it open.
    }
  }

  #remember() {
    try {
      localStorage.setItem(KEY, JSON.stringify({ isOpen: this.#box.open, learner: this.#wish }));
    } catch {
      // It is remembered until the page is closed.
    }
    this.#look({ isAnew: this.#box.open });
  }
}

/** @param {Question} a @param {Question} b */
function isSame(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}
