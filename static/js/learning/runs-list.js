/**
 * The list of this world's runs: how each stands, what learned and with which settings; open, cancel, again, delete.
 * @import {LearnPageData} from "#js/learning/types.js"
 * @import {Runs} from "#js/learning/runs.js"
 * @import {WatchedRun} from "#js/learning/watched-run.js"
 */
import { agoInWords, differencesInWords, learnersInWords, standingInWords } from "#js/learning/run-words.js";
import { plural } from "#js/lib/format.js";
import { runAddress } from "#js/lib/run-address.js";

/** @typedef {"cancel" | "again" | "delete"} Act */

export class RunsList {
  #root;
  #data;
  #runs;
  /** @type {Map<string, HTMLElement>} lines by run */
  #lines = new Map();

  /**
   * @param {HTMLElement} root
   * @param {LearnPageData} data
   * @param {Runs} runs
   */
  constructor(root, data, runs) {
    this.#root = root;
    this.#data = data;
    this.#runs = runs;
  }

  /** @param {AbortSignal} signal @param {(act: Act, run: WatchedRun) => void} onAct */
  start(signal, onAct) {
    this.#part("runs-list").addEventListener(
      "click",
      ({ target }) => {
        const button = target instanceof Element ? target.closest("button") : null;
        const run = this.#runs.find(button?.closest("li")?.dataset.run ?? "");
        if (button && run) onAct(/** @type {Act} */ (button.dataset.act), run);
      },
      { signal },
    );
  }

  paint() {
    const { all, others } = this.#runs;
    this.#part("runs").hidden = all.length === 0;
    this.#say(this.#part("runs-count"), String(all.length));
    this.#say(this.#part("others"), othersInWords(others));
    this.#part("others").hidden = others.length === 0;
    const lines = all.map((run) => this.#line(run));
    const list = this.#part("runs-list");
    if (lines.length !== list.children.length || lines.some((line, i) => list.children[i] !== line))
      list.replaceChildren(...lines);
  }

  /** @param {WatchedRun} watched */
  #line(watched) {
    const line = this.#lines.get(watched.id) ?? this.#newLine(watched);
    const { progress } = watched;
    const isShown = watched === this.#runs.shown;
    line.dataset.status = progress.status;
    if (isShown) line.setAttribute("aria-current", "true");
    else line.removeAttribute("aria-current");
    part(line, "run-open").hidden = isShown;
    part(line, "run-here").hidden = !isShown;
    this.#say(part(line, "run-standing"), standingInWords(progress.status, progress));
    this.#say(part(line, "run-ago"), agoInWords(watched.run.created_at));
    /** @type {HTMLProgressElement} */ (part(line, "run-share")).value = progress.share;
    part(line, "run-share").hidden = progress.isOver;
    part(line, "run-cancel").hidden = progress.isOver;
    part(line, "run-delete").hidden = !progress.isOver;
    return line;
  }

  /** @param {WatchedRun} watched */
  #newLine({ id, run }) {
    const template = /** @type {HTMLTemplateElement} */ (this.#root.querySelector("#run-line"));
    const copy = document.importNode(template.content, true);
    const line = /** @type {HTMLElement} */ (copy.firstElementChild);
    line.dataset.run = id;
    const learners = learnersInWords(Object.keys(run.learners), this.#data.learners);
    part(line, "run-learners").textContent = learners;
    part(line, "run-settings").textContent = differencesInWords(run, this.#data.settings, this.#data.presets ?? []);
    part(line, "run-share").setAttribute("aria-label", `How far this run of ${learners} is`);
    /** @type {HTMLAnchorElement} */ (part(line, "run-open")).href = runAddress(id);
    this.#lines.set(id, line);
    return line;
  }

  /** @param {HTMLElement} element @param {string} text */
  #say(element, text) {
    if (element.textContent !== text) element.textContent = text;
  }

  /** @param {string} name */
  #part(name) {
    return part(this.#root, name);
  }
}

/** @param {WatchedRun[]} others */
function othersInWords(others) {
  const going = others.filter(({ progress }) => progress.status === "running");
  const waiting = others.length - going.length;
  const words = [];
  if (going.length > 0) words.push(`${plural(going.length, "other run")} learning`);
  if (waiting > 0) words.push(`${plural(waiting, going.length > 0 ? "run" : "other run")} waiting`);
  return words.join(", ");
}

/** @param {HTMLElement} element @param {string} name */
function part(element, name) {
  return /** @type {HTMLElement} */ (element.querySelector(`[data-part="${name}"]`));
}
