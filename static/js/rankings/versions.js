/** Every order that was confirmed: which counts, what it looked like, and the way back to an earlier one. */

import { announce } from "#js/lib/announce.js";
import { api } from "#js/lib/api.js";
import { byId } from "#js/lib/dom.js";
import { capital, PLURAL, takenAgainSentence, versionsSummary, versionWords } from "#js/rankings/confirm-words.js";
import { flat, isSame, reconcile } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/standing.js").Ranking} Ranking */
/** @typedef {import("#js/rankings/standing.js").Newest} Newest */

export class Versions {
  #worldId;
  #sitting;
  #cards;
  #panel = /** @type {HTMLDetailsElement} */ (byId("versions"));
  /** @type {Newest} */
  #newest = { success: null, failure: null };
  /** What the open panel shows. */
  #shown = "";

  /**
   * @param {object} parts
   * @param {string} parts.worldId
   * @param {import("#js/rankings/sitting.js").Sitting} parts.sitting
   * @param {import("#js/rankings/mini-cards.js").MiniCards} parts.cards
   */
  constructor({ worldId, sitting, cards }) {
    this.#worldId = worldId;
    this.#sitting = sitting;
    this.#cards = cards;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    this.#panel.addEventListener("toggle", () => void this.#load(), { signal });
  }

  /** @param {Newest} newest */
  show(newest) {
    this.#newest = { ...newest };
    const there = rankingsOf(newest);
    this.#panel.hidden = there.length === 0;
    byId("versions-count").replaceChildren(...there.map((one) => element("span", versionsSummary(one.outcome, one))));
    void this.#load();
    this.#showWhatStands();
  }

  /** Put the cards as they stood in a version; confirming it makes a new one. @param {Ranking} version */
  take({ outcome, version, order }) {
    const ids = flat(this.#sitting.orders[outcome]);
    const known = flat(order);
    const added = ids.filter((id) => !known.includes(id));
    const wanted = reconcile(
      order,
      added,
      known.filter((id) => !ids.includes(id)),
    );
    this.#sitting.do({ type: "set", means: "button", outcome, order: wanted, by: "version" });
    announce(takenAgainSentence({ outcome, version, nNew: added.length }));
  }

  /** The list of all is fetched when somebody looks. */
  async #load() {
    const print = JSON.stringify(rankingsOf(this.#newest).map(({ outcome, version }) => [outcome, version]));
    if (!this.#panel.open || print === this.#shown) return;
    this.#shown = print;
    const outcomes = rankingsOf(this.#newest).map(({ outcome }) => outcome);
    const path = (/** @type {Outcome} */ outcome) => `/worlds/${this.#worldId}/rankings/${outcome}/versions`;
    try {
      const lists = await Promise.all(outcomes.map((outcome) => api.get(path(outcome))));
      byId("versions-lists").replaceChildren(...outcomes.map((outcome, i) => this.#section(outcome, lists[i])));
      this.#showWhatStands();
    } catch {
      this.#shown = "";
      byId("versions-lists").replaceChildren(
        element("p", "They cannot be fetched just now. Close this and open it again."),
      );
    }
  }

  /** @param {Outcome} outcome @param {Ranking[]} versions newest first */
  #section(outcome, versions) {
    const list = element("ol", "");
    list.className = "versions-list";
    list.append(...versions.map((one, i) => this.#item(one, i === 0)));
    const section = element("section", "");
    section.append(element("h3", capital(PLURAL[outcome])), list);
    return section;
  }

  /** @param {Ranking} one @param {boolean} counts */
  #item(one, counts) {
    const item = document.importNode(/** @type {HTMLTemplateElement} */ (byId("version-item")).content, true);
    const li = /** @type {HTMLElement} */ (item.firstElementChild);
    const find = (/** @type {string} */ selector) => /** @type {HTMLElement} */ (li.querySelector(selector));
    li.dataset.version = String(one.version);
    li.dataset.outcome = one.outcome;
    li.dataset.order = JSON.stringify(one.order);
    find(".version-words").textContent = versionWords(one, counts);
    const look = /** @type {HTMLDetailsElement} */ (find("details"));
    look.addEventListener("toggle", () => this.#cards.fill(find(".version-order"), one.order), { once: true });
    const take = find("button");
    take.setAttribute("aria-label", `Take version ${one.version} of your ${PLURAL[one.outcome]} again`);
    take.addEventListener("click", () => take.getAttribute("aria-disabled") !== "true" && this.take(one));
    return li;
  }

  /** The order on the page need not be taken again. */
  #showWhatStands() {
    for (const item of /** @type {NodeListOf<HTMLElement>} */ (
      byId("versions-lists").querySelectorAll("[data-version]")
    )) {
      const outcome = /** @type {Outcome} */ (item.dataset.outcome);
      const stands = isSame(JSON.parse(item.dataset.order ?? "[]"), this.#sitting.orders[outcome]);
      const button = /** @type {HTMLButtonElement} */ (item.querySelector("button"));
      button.textContent = stands ? "Stands so now" : "Take this order again";
      button.setAttribute("aria-disabled", String(stands));
    }
  }
}

/** @param {Newest} newest @returns {Ranking[]} */
function rankingsOf({ success, failure }) {
  return [success, failure].filter((one) => one != null);
}

/** @param {string} name @param {string} text */
function element(name, text) {
  const made = document.createElement(name);
  made.textContent = text;
  return made;
}
