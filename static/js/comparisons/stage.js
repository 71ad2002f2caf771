/**
 * The stage of the Compare page: everybody walks the same world in step, by one transport. It opens on the last step, where
 * all have arrived: the picture is whole before anything moves.
 * @import {Parts} from "#js/elements/compare-page.js"
 * @import {Ground} from "#js/comparisons/agent-panel.js"
 */
import { AgentPanel } from "#js/comparisons/agent-panel.js";
import { castOf } from "#js/comparisons/cast.js";
import { Looking } from "#js/comparisons/looking.js";
import { lossEnds } from "#js/comparisons/losses.js";
import { lengthOf } from "#js/comparisons/rollouts.js";
import { isLearner } from "#js/comparisons/sentences.js";
import { squareWords } from "#js/comparisons/square-words.js";
import { listenForKeys } from "#js/comparisons/stage-keys.js";
import { Transport } from "#js/comparisons/transport.js";
import { TransportBar } from "#js/comparisons/transport-bar.js";
import { columnsFor } from "#js/learning/line-up.js";
import { saveMenu } from "#js/pictures/save-menu.js";

/** Boards that stand in one row; more stand in two, up to so many in each. */
const ONE_ROW = 4;
const MOST_IN_A_ROW = 6;

export class Stage {
  #root;
  #data;
  #cast;
  #panels;
  #bar;
  #looking;
  #transport = new Transport();
  #episode = 0;
  #painting = 0;
  #paintedAt = 0;

  /** @param {Parts} parts */
  constructor({ root, data, entries, unknownTo }) {
    this.#root = root;
    this.#data = data;
    this.#bar = new TransportBar(root);
    const { world, run, comparison } = data;
    const template = /** @type {HTMLTemplateElement} */ (root.querySelector("#agent-panel"));
    this.#cast = castOf(data, entries);
    this.#panels = this.#cast.map((role) => {
      const { who } = role.entry;
      const unknown = isLearner(role.entry) ? unknownTo(who) : null;
      const panel = new AgentPanel(template, { role, world, comparison, result: run.learners[who], unknown });
      const values = () => (this.#ground === "lost" ? "reward lost from there on, against the optimum" : "");
      panel.save.append(saveMenu(panel.board, { title: role.title, values }));
      return panel;
    });
    this.#looking = new Looking(world, {
      boards: this.#panels.map((panel) => panel.board),
      words: this.#part("square-words"),
      wordsOf: (state) => squareWords(data, this.#cast, state, this.#ground),
    });
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    this.#setUp();
    this.#root.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.#root.addEventListener("change", (event) => this.#onChange(event), { signal });
    this.#part("range").addEventListener("input", () => this.seek(Number(this.#part("range").value)), { signal });
    this.#looking.start(signal);
    listenForKeys(this, signal);
    signal.addEventListener("abort", () => {
      cancelAnimationFrame(this.#painting);
      this.#painting = 0;
    });
    this.show(0);
    this.seek(Number.POSITIVE_INFINITY);
  }

  /** Put an episode on stage, everybody at the start. @param {number} episode 0, 1, … */
  show(episode) {
    this.#episode = episode;
    this.#transport.load(lengthOf(this.#cast, episode));
    this.#schedule();
  }

  /** The next episode, or the one before, shown as far as this one was: from its start, or whole. @param {number} by */
  turn(by) {
    const wasWhole = this.#transport.isAtEnd;
    this.show((this.#episode + by + this.#count) % this.#count);
    this.#part("episode").value = String(this.#episode);
    if (wasWhole) this.seek(Number.POSITIVE_INFINITY);
  }

  togglePlay() {
    if (this.#transport.isPlaying) this.#transport.pause();
    else this.#transport.play();
    this.#paintedAt = performance.now();
    this.#schedule();
  }

  /** @param {number} step past the last: the last */
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

  /** @param {number} down @param {number} right */
  look(down, right) {
    this.#looking.step(down, right);
  }

  get isLooking() {
    return this.#looking.isLooking;
  }

  lookAway() {
    this.#looking.away();
  }

  fillScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else this.#part("show").requestFullscreen();
  }

  #setUp() {
    const count = this.#panels.length;
    const columns = count <= ONE_ROW ? count : Math.max(Math.ceil(count / 2), 1);
    const { rows, cols } = this.#data.world;
    const stage = this.#part("stage");
    stage.replaceChildren(...this.#panels.map((panel) => panel.element));
    stage.style.setProperty("--columns", String(Math.min(columns, columnsFor(count, MOST_IN_A_ROW))));
    stage.style.setProperty("--rows", String(count <= ONE_ROW ? 1 : 2));
    stage.style.setProperty("--ratio", `${cols} / ${rows}`);
    const episodes = Array.from({ length: this.#count }, (_, i) => new Option(`${i + 1} of ${this.#count}`, String(i)));
    this.#part("episode").replaceChildren(...episodes);
    this.#part("lost-choice").hidden = !this.#data.comparison.value_lost;
    const ends = lossEnds(this.#data.comparison);
    this.#part("loss-none").textContent = ends.none;
    this.#part("loss-all").textContent = ends.all;
    this.#part("fill").hidden = !document.fullscreenEnabled;
  }

  /** Episodes of who has most of them. */
  get #count() {
    return Math.max(1, ...this.#cast.map(({ episodes }) => episodes.length));
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
    const { step, isPlaying } = this.#transport;
    const shown = { ground: this.#ground, arrows: this.#isOn("arrows"), numbers: this.#isOn("numbers") };
    for (const panel of this.#panels) panel.show(this.#episode, step, shown);
    this.#bar.show(this.#transport);
    Object.assign(this.#root.dataset, {
      step: String(step),
      episode: String(this.#episode + 1),
      playing: String(isPlaying),
      ground: shown.ground,
    });
  }

  /** @param {Event} event */
  #onClick(event) {
    const action =
      event.target instanceof Element ? event.target.closest("[data-action]")?.getAttribute("data-action") : null;
    if (action === "play") this.togglePlay();
    if (action === "start") this.seek(0);
    if (action === "back") this.nudge(-1);
    if (action === "forward") this.nudge(1);
    if (action === "fill") this.fillScreen();
  }

  /** @param {Event} event */
  #onChange(event) {
    const control = /** @type {HTMLInputElement} */ (event.target);
    if (control.name === "episode") this.show(Number(control.value));
    if (control.name === "speed") this.#transport.speed = Number(control.value);
    if (control.name === "loop") this.#transport.loop = control.checked;
    if (["ground", "arrows", "numbers"].includes(control.name)) this.#paint();
    if (control.name === "ground") this.#looking.again();
  }

  /** @returns {Ground} */
  get #ground() {
    const chosen = this.#root.querySelector('input[name="ground"]:checked');
    return /** @type {Ground} */ (chosen?.getAttribute("value") ?? "true");
  }

  /** @param {string} name */
  #isOn(name) {
    return /** @type {HTMLInputElement} */ (this.#root.querySelector(`.transport-options input[name="${name}"]`))
      .checked;
  }

  /** A named part of the markup; which element it is stands in the template. @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"]`);
  }
}
