/** What shows on a list where a dragged card came from and where it would land. */

import { boxOf } from "#js/rankings/group-list.js";
import { barAt, sideOf } from "#js/rankings/landing.js";

/** @typedef {import("#js/rankings/landing.js").Box} Box */
/** @typedef {import("#js/rankings/landing.js").GroupBox} GroupBox */
/** @typedef {import("#js/rankings/landing.js").Landing} Landing */

export class LandingMarks {
  #frame;

  /** @param {HTMLElement} frame holds the list and the marks */
  constructor(frame) {
    this.#frame = frame;
  }

  /** @param {{home: Box, groups: readonly GroupBox[], landing: Landing | null}} drag */
  show({ home, groups, landing }) {
    this.#put("home", home);
    const group = landing ? groups[landing.at].box : null;
    this.#put("bar", landing && landing.side !== "beside" && group ? barBox(group, barAt(groups, landing)) : null);
    this.#put("bracket", landing?.side === "beside" ? group : null);
    this.#put("side", group && sideOf(group));
    this.#frame.dataset.landing = landing?.side ?? "home";
  }

  hide() {
    for (const name of ["home", "bar", "bracket", "side"]) this.#put(name, null);
    delete this.#frame.dataset.landing;
  }

  /** @param {string} name @param {Box | null} box of the page */
  #put(name, box) {
    const mark = /** @type {HTMLElement} */ (this.#frame.querySelector(`[data-mark="${name}"]`));
    mark.hidden = box === null;
    if (!box) return;
    const frame = boxOf(this.#frame);
    mark.style.translate = `${box.left - frame.left}px ${box.top - frame.top}px`;
    mark.style.inlineSize = `${box.right - box.left}px`;
    mark.style.blockSize = `${box.bottom - box.top}px`;
  }
}

/** @param {Box} group @param {number} y @returns {Box} */
function barBox({ left, right }, y) {
  return { left, right, top: y, bottom: y };
}
