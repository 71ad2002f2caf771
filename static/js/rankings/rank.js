/** The rank page, put together: the sitting holds the state, every part shows it and says what was done. An entry script. */

import "#js/elements/irl-board.js";
import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { isTaken, letterOf } from "#js/lib/keys.js";
import { pageData } from "#js/lib/page-data.js";
import { CompareDialog } from "#js/rankings/compare-dialog.js";
import { Confirmation } from "#js/rankings/confirmation.js";
import { RankLists } from "#js/rankings/lists.js";
import { MagnitudePanel } from "#js/rankings/magnitude-panel.js";
import { PairwisePanel } from "#js/rankings/pairwise-panel.js";
import { PolicyPanel } from "#js/rankings/policy-panel.js";
import { SegmentsPanel } from "#js/rankings/segments-panel.js";
import { Sitting } from "#js/rankings/sitting.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */
/** @typedef {import("#js/rankings/sitting-state.js").Way} Way */

/**
 * What every part of the page gets.
 * @typedef {object} Parts
 * @property {Sitting} sitting
 * @property {any} world
 * @property {Map<string, any>} demonstrations   by id, discarded ones too
 * @property {boolean} showTotals
 * @property {any} data                          the page data
 */

class RankPage {
  #life = new AbortController();
  #root = byId("rank");
  #sitting;
  #lists;
  #confirmation;
  #magnitude;
  #segments;
  #pairwise;
  #comparing;
  /** Null where a study hides it: then nothing is asked. @type {PolicyPanel | null} */
  #policy;

  /** @param {Parts} parts */
  constructor(parts) {
    this.#sitting = parts.sitting;
    const onCompare = (
      /** @type {Outcome} */ outcome,
      /** @type {string} */ a,
      /** @type {string} */ b,
      /** @type {Means} */ means = "button",
    ) => this.#comparing.open(outcome, a, b, means);
    const onWatch = (/** @type {string} */ id, /** @type {Means} */ means) =>
      void this.#sitting.do({ type: "watch", means, id });
    this.#lists = new RankLists({ ...parts, root: this.#root, onWatch, onCompare });
    const onFocus = (/** @type {string} */ id) => this.#lists.focus(id);
    this.#confirmation = new Confirmation({ ...parts, onCompare, onFocus });
    this.#magnitude = new MagnitudePanel({ ...parts, lists: this.#lists });
    this.#segments = new SegmentsPanel(parts);
    this.#pairwise = new PairwisePanel(parts);
    this.#policy = parts.data.options.show_policy ? new PolicyPanel(parts) : null;
    this.#comparing = new CompareDialog({ ...parts, lists: this.#lists, policy: this.#policy });
  }

  start() {
    const { signal } = this.#life;
    this.#lists.start(signal);
    this.#confirmation.start(signal);
    this.#magnitude.start();
    this.#segments.start(signal);
    this.#pairwise.start(signal);
    this.#comparing.start(signal);
    this.#policy?.start(signal);
    this.#root.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.#root.addEventListener("change", (event) => this.#onChange(event), { signal });
    document.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    document.addEventListener("visibilitychange", () => this.#onVisibility(), { signal });
    this.#sitting.subscribe(() => this.#show());
    this.#show();
    // Until now a choice would have been heard by nobody.
    /** @type {HTMLFieldSetElement | null} */ (document.querySelector("#ways"))?.removeAttribute("disabled");
  }

  #show() {
    const { past, future, way } = this.#sitting.state;
    this.#root.dataset.way = way;
    // Not truly disabled: the last press would take the focus away.
    byId("undo").setAttribute("aria-disabled", String(past.length === 0));
    byId("redo").setAttribute("aria-disabled", String(future.length === 0));
    for (const radio of radios(this.#root)) radio.checked = radio.value === way;
  }

  /** @param {"undo" | "redo"} type @param {Means} means */
  #travel(type, means) {
    const isDone = this.#sitting.do({ type, means });
    if (type === "undo") announce(isDone ? "Undone." : "There is nothing to undo.");
    else announce(isDone ? "Done again." : "There is nothing to do again.");
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const { id } = (event.target instanceof Element ? event.target.closest("button") : null) ?? {};
    if (id === "undo" || id === "redo") this.#travel(id, "button");
  }

  /** @param {Event} event */
  #onChange(event) {
    const radio = event.target instanceof HTMLInputElement && event.target.name === "way" ? event.target : null;
    if (radio) this.#sitting.do({ type: "way", means: "button", way: /** @type {Way} */ (radio.value) });
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    const isChord = (event.ctrlKey || event.metaKey) && !event.altKey;
    if (isTaken(event) && !isChord) return;
    const letter = letterOf(event);
    if (letter === "z") this.#travel(event.shiftKey ? "redo" : "undo", "key");
    else if (letter === "y" && isChord) this.#travel("redo", "key");
    else return;
    event.preventDefault();
  }

  #onVisibility() {
    this.#sitting.do({ type: document.visibilityState === "hidden" ? "hidden" : "visible", means: "page" });
  }
}

/** @param {HTMLElement} root @returns {NodeListOf<HTMLInputElement>} */
function radios(root) {
  return root.querySelectorAll('[name="way"]');
}

const data = pageData();
const demonstrations = new Map(data.demonstrations.map((/** @type {any} */ one) => [one.id, one]));
const sitting = await Sitting.open(data);
new RankPage({ sitting, world: data.world, demonstrations, showTotals: data.options.show_totals, data }).start();
