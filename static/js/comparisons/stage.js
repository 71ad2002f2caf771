/**
 * The stage of the Compare page: everybody walks the same world in step, by one transport.
 * @import {Entry, Rollouts} from "#js/comparisons/types.js"
 * @import {Parts} from "#js/elements/compare-page.js"
 */
import { AgentPanel } from "#js/comparisons/agent-panel.js";
import { episodeOf, lengthOf } from "#js/comparisons/rollouts.js";
import { isLearner, onStage } from "#js/comparisons/sentences.js";
import { Transport } from "#js/comparisons/transport.js";
import { columnsFor } from "#js/learning/line-up.js";

/** Agents in one row on a wide screen: so many boards are still seen whole beside the transport. */
const MOST_IN_A_ROW = 7;

export class Stage {
  #root;
  #data;
  #transport = new Transport();
  /** @type {AgentPanel[]} */
  #panels;
  #episode = 0;
  #painting = 0;
  #paintedAt = 0;

  /** @param {Parts} parts */
  constructor({ root, data, entries, unknownTo }) {
    this.#root = root;
    this.#data = data;
    const template = /** @type {HTMLTemplateElement} */ (root.querySelector("#agent-panel"));
    this.#panels = onStage(entries, Object.keys(data.run.learners)).map(
      (entry) =>
        new AgentPanel(template, {
          entry,
          world: data.world,
          result: data.run.learners[entry.who],
          unknown: isLearner(entry) ? unknownTo(entry.who) : null,
        }),
    );
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    this.#part("stage").replaceChildren(...this.#panels.map((panel) => panel.element));
    this.#part("stage").style.setProperty("--columns", String(columnsFor(this.#panels.length, MOST_IN_A_ROW)));
    const count = Math.max(1, ...Object.values(this.#rollouts).map((episodes) => episodes.length));
    const options = Array.from({ length: count }, (_, i) => new Option(`${i + 1} of ${count}`, String(i)));
    this.#part("episode").replaceChildren(...options);
    this.#root.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.#root.addEventListener("change", (event) => this.#onChange(event), { signal });
    this.#part("range").addEventListener("input", () => this.seek(Number(this.#part("range").value)), { signal });
    signal.addEventListener("abort", () => {
      cancelAnimationFrame(this.#painting);
      this.#painting = 0;
    });
    this.show(0);
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

  /** @returns {Rollouts} the person's are their attempts as they were recorded */
  get #rollouts() {
    return this.#data.rollouts;
  }

  #schedule() {
    if (this.#painting || !this.#root.isConnected) return;
    this.#painting = requestAnimationFrame((now) => {
      this.#painting = 0;
      const hasMoved = this.#transport.advance(Math.min(250, now - this.#paintedAt));
      this.#paintedAt = now;
      if (hasMoved || !this.#transport.isPlaying || this.#root.dataset.playing !== "true") this.#paint();
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
    this.#root.dataset.step = String(step);
    this.#root.dataset.episode = String(this.#episode + 1);
    this.#root.dataset.playing = String(isPlaying);
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
  }

  /** @param {Event} event */
  #onChange(event) {
    const control = /** @type {HTMLInputElement} */ (event.target);
    if (control.name === "episode") this.show(Number(control.value));
    if (control.name === "speed") this.#transport.speed = Number(control.value);
    if (control.name === "loop") this.#transport.loop = control.checked;
    if (["ground", "arrows", "numbers"].includes(control.name)) this.#paint();
  }

  /** @returns {"true" | "learned"} */
  get #ground() {
    return this.#root.querySelector('input[name="ground"][value="learned"]:checked') ? "learned" : "true";
  }

  /** @param {string} name */
  #isOn(name) {
    return /** @type {HTMLInputElement} */ (this.#root.querySelector(`.transport-options input[name="${name}"]`))
      .checked;
  }

  /** A named part of the markup; which element it is stands in the template. @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"], [data-action="${name}"]`);
  }
}
