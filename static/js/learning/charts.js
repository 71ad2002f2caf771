/**
 * The two charts of a run, the gap and the log-likelihood, side by side; what they mean, and their figures as tables.
 * @import {LearnPageData} from "#js/learning/types.js"
 * @import {WatchedRun} from "#js/learning/watched-run.js"
 * @import {Measure} from "#js/learning/chart-words.js"
 */
import { ConvergenceChart } from "#js/charts/convergence-chart.js";
import { chartInWords, figuresTable, measureHelp, measureTitle } from "#js/learning/chart-words.js";
import { FrameStore } from "#js/learning/frame-store.js";
import { lineChartSvg } from "#js/pictures/line-chart.js";
import { worldSentence } from "#js/pictures/picture.js";
import { SaveMenu } from "#js/pictures/save-menu.js";

const NOTHING = new FrameStore();
/** Iterations on the axis of a chart without a run. */
const EMPTY_AXIS = 500;
const MEASURES = /** @type {const} */ (["gap", "log_likelihood"]);

export class Charts {
  #root;
  #data;
  /** @type {Map<Measure, ConvergenceChart>} */
  #charts = new Map();
  /** @type {FrameStore} */
  #store = NOTHING;
  #drawn = -1;
  #last = 0;

  /**
   * @param {HTMLElement} root
   * @param {LearnPageData} data
   */
  constructor(root, data) {
    this.#root = root;
    this.#data = data;
  }

  /** @param {AbortSignal} signal @param {(iteration: number) => void} onPick */
  start(signal, onPick) {
    const learners = this.#data.learners.map(({ name }) => name);
    for (const measure of MEASURES) {
      const box = this.#part(measure, "chart");
      this.#charts.set(measure, new ConvergenceChart(box, this.#store, { learners, measure, onPick, signal }));
      this.#part(measure, "chart-title").textContent = measureTitle(measure, this.#isOwn);
      this.#part(measure, "chart-save").append(this.#saveMenu(measure));
    }
    this.#box.addEventListener("toggle", () => this.#paintFigures(), { signal });
  }

  /** @param {Measure} measure */
  #saveMenu(measure) {
    const menu = new SaveMenu();
    const title = measureTitle(measure, this.#isOwn);
    const svg = () => {
      const learners = this.#learners.map(({ name }) => name);
      const note = worldSentence(this.#data.world);
      return lineChartSvg(this.#store.columns(learners, measure), { learners, measure, last: this.#last, title, note });
    };
    menu.source = () => ({ name: `irlfr-${measure === "gap" ? "gap" : "log-likelihood"}`, title, svg });
    return menu;
  }

  /** @param {WatchedRun | null} watched */
  paint(watched) {
    const store = watched?.store ?? NOTHING;
    const last = watched?.lastIteration ?? EMPTY_AXIS;
    const position = watched?.timeline.position ?? 0;
    const isNew = store !== this.#store || store.version !== this.#drawn || last !== this.#last;
    if (!isNew) for (const chart of this.#charts.values()) chart.moveTo(position);
    else this.#draw(store, position, last);
  }

  /** @param {FrameStore} store @param {number} position @param {number} last */
  #draw(store, position, last) {
    [this.#store, this.#drawn, this.#last] = [store, store.version, last];
    for (const [measure, chart] of this.#charts) {
      chart.read(store);
      chart.update(position, last);
      this.#part(measure, "chart").setAttribute("aria-label", chartInWords(store, this.#learners, measure));
      this.#say(this.#part(measure, "measure-help"), measureHelp(measure, this.#learners, this.#isOwn));
    }
    this.#paintFigures();
  }

  #paintFigures() {
    if (!this.#box.open) return;
    for (const measure of MEASURES) {
      this.#part(measure, "figures").replaceChildren(figuresTable(this.#store, this.#learners, measure));
    }
  }

  /** Those that have something to show. */
  get #learners() {
    return this.#data.learners.filter(({ name }) => this.#store.latest(name));
  }

  get #isOwn() {
    return this.#data.is_own ?? true;
  }

  get #box() {
    return /** @type {HTMLDetailsElement} */ (this.#root.querySelector('[data-part="figures-box"]'));
  }

  /** @param {HTMLElement} part @param {string} text */
  #say(part, text) {
    if (part.textContent !== text) part.textContent = text;
  }

  /** The parts of the gap have plain names; those of the other measure say so. @param {Measure} measure @param {string} name */
  #part(measure, name) {
    const full = measure === "gap" ? name : `${name}-likelihood`;
    return /** @type {HTMLElement} */ (this.#root.querySelector(`[data-part="${full}"]`));
  }
}
