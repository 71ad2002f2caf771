/**
 * `<compare-page>`: everybody walks the same world in step; below, the figures, what each learner believes, and how to
 * compute it all again.
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 * @import {ComparePageData, Entry, Rollouts} from "#js/comparisons/types.js"
 */
import "#js/elements/irl-board.js";
import { mountDotPlot } from "#js/charts/dot-plot.js";
import { figure } from "#js/charts/figures.js";
import { marker } from "#js/charts/marker.js";
import { AgentPanel } from "#js/comparisons/agent-panel.js";
import { fileName, reproduceCommand } from "#js/comparisons/reproduce.js";
import { resultRows } from "#js/comparisons/result-table.js";
import { episodeOf, lengthOf } from "#js/comparisons/rollouts.js";
import {
  backgroundSentence,
  isLearner,
  onStage,
  posteriorSentences,
  resultSentence,
  softSentence,
} from "#js/comparisons/sentences.js";
import { Transport } from "#js/comparisons/transport.js";
import { columnsFor } from "#js/learning/line-up.js";
import { untouched } from "#js/learning/material.js";
import { announce } from "#js/lib/announce.js";
import { pageData } from "#js/lib/page-data.js";

/** Agents in one row on a wide screen: so many boards are still seen whole beside the transport. */
const MOST_IN_A_ROW = 7;

export class ComparePage extends HTMLElement {
  #life = new AbortController();
  /** @type {ComparePageData} */
  #data = pageData();
  #transport = new Transport();
  /** @type {AgentPanel[]} */
  #panels = [];
  #episode = 0;
  #painting = 0;
  #paintedAt = 0;

  connectedCallback() {
    this.#life = new AbortController();
    const { signal } = this.#life;
    this.#buildWords();
    this.#buildStage();
    this.#buildBeliefs();
    mountDotPlot(this.#part("plot"), this.#entries, signal);
    this.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.addEventListener("change", (event) => this.#onChange(event), { signal });
    this.#part("range").addEventListener("input", () => this.seek(Number(this.#part("range").value)), { signal });
    this.show(0);
  }

  disconnectedCallback() {
    this.#life.abort();
    cancelAnimationFrame(this.#painting);
    this.#painting = 0;
  }

  /** Put an episode on stage, everybody at the start. @param {number} episode 0, 1, … */
  show(episode) {
    this.#episode = episode;
    this.#transport.load(lengthOf(this.#rollouts, episode));
    this.#schedule();
  }

  togglePlay() {
    if (this.#transport.isPlaying) this.#transport.pause();
    else this.#transport.play();
    this.#paintedAt = performance.now();
    this.#schedule();
  }

  /** @param {number} step */
  seek(step) {
    this.#transport.pause();
    this.#transport.seek(step);
    this.#schedule();
  }

  /** @param {number} by */
  nudge(by) {
    this.#transport.nudge(by);
    this.#schedule();
  }

  /** @returns {Entry[]} by place, the person spoken to as "You" */
  get #entries() {
    return this.#data.comparison.entries.map((entry) => (entry.who === "human" ? { ...entry, title: "You" } : entry));
  }

  /** @returns {Rollouts} the person's are their attempts as they were recorded */
  get #rollouts() {
    return this.#data.rollouts;
  }

  #schedule() {
    if (this.#painting || !this.isConnected) return;
    this.#painting = requestAnimationFrame((now) => {
      this.#painting = 0;
      const hasMoved = this.#transport.advance(Math.min(250, now - this.#paintedAt));
      this.#paintedAt = now;
      if (hasMoved || !this.#transport.isPlaying || this.dataset.playing !== "true") this.#paint();
      if (this.#transport.isPlaying) this.#schedule();
    });
  }

  #paint() {
    const { step, length, isPlaying } = this.#transport;
    const shown = /** @type {const} */ ({
      ground: this.#ground,
      arrows: this.#isOn("arrows"),
      numbers: this.#isOn("numbers"),
    });
    for (const panel of this.#panels) {
      const episodes = this.#rollouts[panel.entry.who];
      const episode = episodeOf(episodes, this.#episode);
      if (episode) panel.show(episode, step, shown, this.#nameOf(panel.entry, episodes?.length ?? 1));
    }
    const range = this.#part("range");
    range.max = String(length);
    range.value = String(step);
    range.setAttribute("aria-valuetext", `step ${step} of ${length}`);
    this.#part("step").textContent = `step ${step} of ${length}`;
    this.#part("play-word").textContent = isPlaying ? "Pause" : "Play";
    this.#part("play-icon").hidden = isPlaying;
    this.#part("pause-icon").hidden = !isPlaying;
    this.#part("play").setAttribute("aria-pressed", String(isPlaying));
    this.dataset.step = String(step);
    this.dataset.episode = String(this.#episode + 1);
    this.dataset.playing = String(isPlaying);
  }

  #buildWords() {
    const { run } = this.#data;
    const attempts = (this.#rollouts.human ?? []).map(({ total }) => total);
    this.#part("sentence").textContent = resultSentence(this.#entries);
    this.#part("background").textContent = backgroundSentence(this.#entries, attempts);
    this.#part("rows").replaceChildren(...resultRows(this.#entries));
    this.#part("intervals").replaceChildren(
      ...posteriorSentences(this.#entries, run.learners, this.#data.world).map(paragraph),
    );
    this.#part("soft-words").textContent = softSentence(this.#entries, run.learners);
    this.#part("failure-words").hidden = !("irlf" in run.learners || "irlfr" in run.learners);
    this.#part("command").textContent = reproduceCommand(run);
    this.#part("download").href = `/api/v1/runs/${run.id}/demonstrations.jsonl`;
    this.#part("download").download = fileName(run);
    this.#part("watch-link").href = `/runs/${run.id}`;
    const count = Math.max(1, ...Object.values(this.#rollouts).map((episodes) => episodes.length));
    const options = Array.from({ length: count }, (_, i) => new Option(`${i + 1} of ${count}`, String(i)));
    this.#part("episode").replaceChildren(...options);
  }

  #buildStage() {
    const template = /** @type {HTMLTemplateElement} */ (this.querySelector("#agent-panel"));
    this.#panels = onStage(this.#entries, Object.keys(this.#data.run.learners)).map(
      (entry) =>
        new AgentPanel(template, {
          entry,
          world: this.#data.world,
          result: this.#data.run.learners[entry.who],
          unknown: isLearner(entry) ? this.#unknownTo(entry.who) : null,
        }),
    );
    this.#part("stage").replaceChildren(...this.#panels.map((panel) => panel.element));
    this.#part("stage").style.setProperty("--columns", String(columnsFor(this.#panels.length, MOST_IN_A_ROW)));
  }

  #buildBeliefs() {
    const learners = onStage(this.#entries, Object.keys(this.#data.run.learners)).filter(isLearner);
    const { world, run } = this.#data;
    const truth = this.#belief("The world", null, `True reward of the world.`);
    const boards = learners.map((entry) => {
      const values = run.learners[entry.who]?.reward?.flat() ?? [];
      const belief = this.#belief(entry.title, entry.who, `Reward that ${entry.title} learned.`);
      const largest = Math.max(...values.map(Math.abs));
      const scale = /** @type {[number, number]} */ ([-(largest || 1), largest || 1]);
      belief.board.view = { values, unknown: this.#unknownTo(entry.who), scale };
      belief.lowest.textContent = figure(-largest);
      belief.highest.textContent = `+${figure(largest)}`;
      if (!largest) wordsFor(belief.ramp, "learns no reward");
      return belief.element;
    });
    wordsFor(truth.ramp, `deeper is dearer; goal +${world.rows + world.cols}`);
    this.#part("beliefs").replaceChildren(truth.element, ...boards);
    this.#part("beliefs").style.setProperty("--columns", String(columnsFor(boards.length + 1)));
  }

  /** @param {string} title @param {string | null} who @param {string} label */
  #belief(title, who, label) {
    const template = /** @type {HTMLTemplateElement} */ (this.querySelector("#belief"));
    const element = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
    const part = (/** @type {string} */ name) =>
      /** @type {HTMLElement} */ (element.querySelector(`[data-part="${name}"]`));
    const board = /** @type {IrlBoard} */ (element.querySelector("irl-board"));
    part("title").textContent = title;
    if (who) {
      element.dataset.who = who;
      part("marker").replaceWith(marker(who));
    } else {
      part("marker").remove();
    }
    board.world = this.#data.world;
    board.label = label;
    return { element, board, ramp: part("ramp"), lowest: part("lowest"), highest: part("highest") };
  }

  /** @param {string} learner */
  #unknownTo(learner) {
    const { world, demonstrations } = this.#data;
    // Who does not look at failures does not know a square where only a failure came.
    const uses_failures = this.#data.learners.find(({ name }) => name === learner)?.uses_failures ?? true;
    return untouched(world, demonstrations, { uses_failures });
  }

  /** @param {Entry} entry @param {number} count */
  #nameOf({ who }, count) {
    return who === "human" ? `attempt ${(this.#episode % count) + 1}/${count}` : `episode ${this.#episode + 1}`;
  }

  /** @param {Event} event */
  #onClick(event) {
    const action =
      event.target instanceof Element ? event.target.closest("[data-action]")?.getAttribute("data-action") : null;
    if (action === "play") this.togglePlay();
    if (action === "start") this.seek(0);
    if (action === "back") this.nudge(-1);
    if (action === "forward") this.nudge(1);
    if (action === "copy-command") this.#copy(reproduceCommand(this.#data.run), "The command is copied.");
    if (action === "copy-link") this.#copy(location.href, "The link is copied.");
  }

  /** @param {Event} event */
  #onChange(event) {
    const control = /** @type {HTMLInputElement} */ (event.target);
    if (control.name === "episode") this.show(Number(control.value));
    if (control.name === "speed") this.#transport.speed = Number(control.value);
    if (control.name === "loop") this.#transport.loop = control.checked;
    if (["ground", "arrows", "numbers"].includes(control.name)) this.#paint();
  }

  /** @param {string} text @param {string} sentence */
  async #copy(text, sentence) {
    try {
      await navigator.clipboard.writeText(text);
      this.#part("copied").textContent = sentence;
    } catch {
      this.#part("copied").textContent = `Your browser does not let this page copy. Here it is: ${text}`;
    }
    announce(this.#part("copied").textContent);
  }

  /** @returns {"true" | "learned"} */
  get #ground() {
    return this.querySelector('input[name="ground"][value="learned"]:checked') ? "learned" : "true";
  }

  /** @param {string} name */
  #isOn(name) {
    return /** @type {HTMLInputElement} */ (this.querySelector(`.transport-options input[name="${name}"]`)).checked;
  }

  /** A named part of the markup; which element it is stands in the template. @param {string} name @returns {any} */
  #part(name) {
    return this.querySelector(`[data-part="${name}"], [data-action="${name}"]`);
  }
}

/** Words in place of a ramp. @param {HTMLElement} ramp @param {string} words */
function wordsFor(ramp, words) {
  ramp.classList.add("ramp--words");
  ramp.textContent = words;
}

/** @param {string} text */
function paragraph(text) {
  const made = document.createElement("p");
  made.textContent = text;
  return made;
}

customElements.define("compare-page", ComparePage);
