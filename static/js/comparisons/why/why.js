/**
 * Why a learner does what it does: which attempt mattered most, what would be if, and what it does not know. Nothing is
 * asked of the server before somebody opens a question; what stands open is in the address.
 * @import {Asked} from "#js/comparisons/why/about.js"
 * @import {PartName, Shown} from "#js/comparisons/why/address.js"
 * @import {Parts} from "#js/elements/compare-page.js"
 */
import { marker } from "#js/charts/marker.js";
import { aboutOf } from "#js/comparisons/why/about.js";
import { PARTS, readShown, writeShown } from "#js/comparisons/why/address.js";
import { Doubt } from "#js/comparisons/why/doubt.js";
import { Mattered } from "#js/comparisons/why/mattered.js";
import { WhatIf } from "#js/comparisons/why/what-if.js";

/** Who is asked about unless somebody says otherwise, if it is there: the one this is named after. */
const FIRST = "irlfr";

export class Why {
  #root;
  #about;
  /** @type {Asked | undefined} */
  #who;
  /** @type {{ mattered: Mattered, "what-if": WhatIf, doubt: Doubt } | null} */
  #parts = null;

  /** @param {Parts} parts */
  constructor(parts) {
    this.#root = /** @type {HTMLElement} */ (parts.root.querySelector("#why"));
    this.#about = aboutOf(parts);
    const { learners } = this.#about;
    this.#who = learners.find(({ name }) => name === FIRST) ?? learners[0];
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    this.#root.hidden = !this.#who;
    if (!this.#who) return;
    this.#part("learners").append(...this.#about.learners.map((who) => this.#chip(who)));
    this.#tick(this.#who);
    this.#parts = {
      mattered: new Mattered(this.#part("mattered"), this.#about, signal),
      "what-if": new WhatIf(this.#part("what-if"), this.#about, () => this.#ask(), signal),
      doubt: new Doubt(this.#part("doubt"), this.#about, signal),
    };
    for (const part of PARTS) this.#part(part).addEventListener("toggle", () => this.#ask(), { signal });
    this.#part("learners").addEventListener("change", (/** @type {Event} */ event) => this.#choose(event), { signal });
    this.#part("list").addEventListener("click", (/** @type {Event} */ event) => this.#try(event), { signal });
    window.addEventListener("hashchange", () => this.#showAddress(), { signal });
    this.#showAddress();
  }

  /** What the address says stands open. */
  #showAddress() {
    const shown = readShown(location.hash);
    if (!shown) return;
    this.#show(shown);
    const first = shown.open[0];
    // After the boards above have found their size.
    if (first) requestAnimationFrame(() => this.#part(first).scrollIntoView({ block: "start" }));
  }

  /** @param {Shown} shown */
  #show({ learner, open, change }) {
    const parts = this.#parts;
    if (!parts) return;
    this.#who = this.#about.learners.find(({ name }) => name === learner) ?? this.#who;
    parts["what-if"].change = change;
    for (const part of PARTS) parts[part].panel.isOpen = open.includes(part);
    this.#ask();
  }

  /** Asks what stands open, and writes it into the address. */
  #ask() {
    const [parts, who] = [this.#parts, this.#who];
    if (!parts || !who) return;
    this.#tick(who);
    const open = PARTS.filter((part) => parts[part].panel.isOpen);
    for (const part of open) parts[part].ask(who);
    this.#write({ learner: who.name, open, change: parts["what-if"].change });
  }

  /** @param {Asked} who */
  #tick({ name }) {
    this.#part("learners").querySelector(`input[value="${name}"]`).checked = true;
  }

  /** @param {Shown} shown */
  #write(shown) {
    const fragment = writeShown(shown);
    if (fragment === location.hash || (fragment === "" && !readShown(location.hash))) return;
    history.replaceState(history.state, "", location.pathname + location.search + fragment);
  }

  /** @param {Event} event */
  #choose(event) {
    const { value } = /** @type {HTMLInputElement} */ (event.target);
    this.#who = this.#about.learners.find(({ name }) => name === value) ?? this.#who;
    this.#ask();
  }

  /** From "it mattered" to "what if it were not". @param {Event} event */
  #try(event) {
    const button = event.target instanceof Element ? event.target.closest('[data-why="try"]') : null;
    const id = button?.getAttribute("data-id");
    const whatIf = this.#parts?.["what-if"];
    if (!id || !whatIf) return;
    whatIf.change = { drop: id };
    whatIf.panel.isOpen = true;
    this.#ask();
    this.#part("what-if").scrollIntoView({ block: "start" });
    whatIf.focus();
  }

  /** @param {Asked} who */
  #chip({ name, title }) {
    const template = /** @type {HTMLTemplateElement} */ (this.#root.querySelector("#why-learner"));
    const chip = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
    chip.dataset.who = name;
    /** @type {HTMLInputElement} */ (chip.querySelector("input")).value = name;
    chip.querySelector("span")?.append(marker(name), title);
    return chip;
  }

  /** @param {PartName | "learners" | "list"} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-why="${name}"]`);
  }
}
