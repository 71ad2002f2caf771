/**
 * Who learns: a board for each learner that the page begins with, a line in a list for the others. Who is ticked in the
 * list gets a board like everybody, and keeps it while it is ticked or has something to show.
 * @import {Material} from "#js/learning/material.js"
 * @import {LearnerInfo, LearnPageData} from "#js/learning/types.js"
 */
import { marker } from "#js/charts/marker.js";
import { columnsFor } from "#js/learning/columns.js";
import { LearnerPanel } from "#js/learning/learner-panel.js";

export { columnsFor };

export class LineUp {
  #root;
  #data;
  /** @type {Material} */
  #material;
  /** @type {LearnerPanel[]} in the order of the learners */
  #panels = [];
  /** @type {Map<string, HTMLElement>} the lines of the list, by learner */
  #lines = new Map();

  /**
   * @param {HTMLElement} root
   * @param {LearnPageData} data
   */
  constructor(root, data) {
    this.#root = root;
    this.#data = data;
    this.#material = data;
    const { run, learners } = data;
    const begins = (/** @type {LearnerInfo} */ { name, preselected }) => (run ? name in run.learners : preselected);
    this.#panels = learners.filter(begins).map((learner) => this.#panel(learner));
    for (const panel of this.#panels) panel.checkbox.checked = !panel.learner.missing;
    for (const learner of learners) if (!begins(learner)) this.#lines.set(learner.name, this.#line(learner));
    this.#part("more-list").replaceChildren(...this.#lines.values());
    this.#part("more").hidden = this.#lines.size === 0;
    this.#place();
  }

  /** What is learned from on the boards. @param {Material} material */
  set material(material) {
    if (material === this.#material) return;
    this.#material = material;
    for (const panel of this.#panels) panel.learnFrom(material);
  }

  get panels() {
    return this.#panels;
  }

  /** Names of those who shall learn: a run on the boards may show others, which could not start now. */
  get chosen() {
    const chosen = this.#panels.filter(({ checkbox, learner }) => checkbox.checked && !learner.missing);
    return chosen.map(({ learner }) => learner.name);
  }

  /** The learners that have a board. */
  get learners() {
    return this.#panels.map((panel) => panel.learner);
  }

  /** Tick exactly these, as far as they can learn. @param {string[]} names */
  choose(names) {
    for (const name of names) this.#join(name);
    for (const { name, missing } of this.#data.learners) this.#tick(name, names.includes(name) && missing === null);
    for (const [name, line] of this.#lines) {
      if (!names.includes(name) && !(name in (this.#data.run?.learners ?? {}))) this.#leave(name, line, false);
    }
  }

  /** Empty boards, and the learners of a run ticked. @param {string[]} names */
  begin(names) {
    for (const name of names) this.#join(name);
    for (const panel of this.#panels) {
      panel.clear();
      this.#tick(panel.learner.name, names.includes(panel.learner.name));
    }
  }

  /** What this learner misses has changed. @param {LearnerInfo} learner */
  weigh(learner) {
    const line = this.#lines.get(learner.name);
    if (line) tell(line, learner);
    const panel = this.#panels.find((one) => one.learner === learner);
    panel?.weigh();
    if (panel) this.#tick(learner.name, panel.checkbox.checked);
  }

  /** @param {boolean} isLocked */
  set isLocked(isLocked) {
    for (const panel of this.#panels) panel.checkbox.disabled = isLocked || panel.learner.missing !== null;
    for (const [name, line] of this.#lines) box(line).disabled = isLocked || this.#learner(name).missing !== null;
  }

  /** A box was ticked or cleared, on a board or in the list. @param {HTMLInputElement} control */
  change({ name, value, checked }) {
    if (name === "more-learner" && checked) this.#join(value);
    const line = this.#lines.get(value);
    if (!line) return;
    this.#tick(value, checked);
    if (!checked && !(value in (this.#data.run?.learners ?? {}))) this.#leave(value, line, name === "learner");
  }

  /** @param {string} name */
  #join(name) {
    const learner = this.#data.learners.find((one) => one.name === name);
    if (!learner || this.#panels.some((panel) => panel.learner === learner)) return;
    const order = this.#data.learners;
    this.#panels.push(this.#panel(learner));
    this.#panels.sort((a, b) => order.indexOf(a.learner) - order.indexOf(b.learner));
    this.#place();
  }

  /**
   * @param {string} name
   * @param {HTMLElement} line
   * @param {boolean} hadFocus its board had, so that the focus goes to its line
   */
  #leave(name, line, hadFocus) {
    this.#panels = this.#panels.filter((panel) => panel.learner.name !== name);
    this.#place();
    if (!hadFocus) return;
    this.#part("more").open = true;
    box(line).focus();
  }

  /**
   * @param {string} name
   * @param {boolean} isChosen
   */
  #tick(name, isChosen) {
    const panel = this.#panels.find((one) => one.learner.name === name);
    if (panel) panel.checkbox.checked = isChosen;
    const line = this.#lines.get(name);
    if (line) box(line).checked = isChosen;
  }

  /** Boards beside the play and the true reward, in rows of equal length, and the key of the charts. */
  #place() {
    const given = [...this.#root.querySelectorAll(".agent-panel--given")];
    const boards = this.#part("boards");
    boards.replaceChildren(...given, ...this.#panels.map((panel) => panel.element));
    boards.style.setProperty("--columns", String(columnsFor(boards.childElementCount, 7)));
    const key = this.learners.map(({ name, title }) => {
      const item = document.createElement("li");
      item.append(marker(name), title);
      return item;
    });
    this.#part("chart-key").replaceChildren(...key);
  }

  /** @param {LearnerInfo} learner */
  #panel(learner) {
    return new LearnerPanel(this.#template("learner-panel"), learner, this.#data.world, this.#material);
  }

  /** @param {LearnerInfo} learner */
  #line(learner) {
    const copy = document.importNode(this.#template("more-learner").content, true);
    const line = /** @type {HTMLElement} */ (copy.firstElementChild);
    part(line, "marker").replaceWith(marker(learner.name));
    part(line, "title").textContent = learner.title;
    part(line, "scores").hidden = !learner.uses_scores;
    part(line, "summary").id = `more-${learner.name}`;
    box(line).value = learner.name;
    box(line).setAttribute("aria-describedby", `more-${learner.name}`);
    tell(line, learner);
    return line;
  }

  /** @param {string} name */
  #learner(name) {
    return /** @type {LearnerInfo} */ (this.#data.learners.find((one) => one.name === name));
  }

  /** @param {string} id */
  #template(id) {
    return /** @type {HTMLTemplateElement} */ (this.#root.querySelector(`#${id}`));
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return part(this.#root, name);
  }
}

/** What it does, or what it misses. @param {HTMLElement} line @param {LearnerInfo} learner */
function tell(line, { summary, missing }) {
  part(line, "summary").textContent = missing ?? summary;
  box(line).disabled = missing !== null;
}

/** @param {HTMLElement} line */
function box(line) {
  return /** @type {HTMLInputElement} */ (line.querySelector("input"));
}

/** @param {HTMLElement} element @param {string} name */
function part(element, name) {
  return /** @type {HTMLElement} */ (element.querySelector(`[data-part="${name}"]`));
}
