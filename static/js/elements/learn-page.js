/**
 * `<learn-page>`: choose learners and settings, press Learn, watch the rewards grow. The boards, the chart and the time
 * line all show one iteration; whatever arrives is painted once an animation frame.
 * @import {Frame, LearnPageData, Run} from "#js/learning/types.js"
 */
import "#js/elements/irl-board.js";
import { ConvergenceChart } from "#js/charts/convergence-chart.js";
import { marker } from "#js/charts/marker.js";
import { chartInWords, figuresTable, measureHelp, measureTitle } from "#js/learning/chart-words.js";
import { FrameStore } from "#js/learning/frame-store.js";
import { LearnerPanel } from "#js/learning/learner-panel.js";
import {
  describeMaterial,
  isOutdated,
  lacksFinished,
  missingWith,
  untouched,
  wayThere,
  weighted,
} from "#js/learning/material.js";
import { RunProgress } from "#js/learning/progress.js";
import { followRun } from "#js/learning/run-stream.js";
import { SettingsForm } from "#js/learning/settings-form.js";
import { Timeline } from "#js/learning/timeline.js";
import { announce } from "#js/lib/announce.js";
import { ApiError, api } from "#js/lib/api.js";
import { pageData } from "#js/lib/page-data.js";
import { setStep } from "#js/lib/path.js";

const DOUBLE_PRESS_MS = 600;

export class LearnPage extends HTMLElement {
  #life = new AbortController();
  #stream = new AbortController();
  /** @type {LearnPageData} */
  #data = pageData();
  /** What each learner misses at the default settings. */
  #missing = new Map(this.#data.learners.map(({ name, missing }) => [name, missing]));
  #store = new FrameStore();
  #timeline = new Timeline();
  /** @type {RunProgress | null} */
  #progress = null;
  /** @type {LearnerPanel[]} */
  #panels = [];
  /** @type {ConvergenceChart | null} */
  #chart = null;
  /** @type {SettingsForm | null} */
  #settings = null;
  /** @type {"gap" | "log_likelihood"} */
  #measure = "gap";
  #isAsking = false;
  #askedAt = Number.NEGATIVE_INFINITY;
  #isConnected = true;
  #painting = 0;
  #paintedAt = 0;
  #chartIsOld = true;

  connectedCallback() {
    this.#life = new AbortController();
    const { signal } = this.#life;
    this.#settings = new SettingsForm(this.#part("form"), this.#data.settings, this.#data.run?.settings ?? {});
    this.#weighSettings();
    this.#buildPanels();
    this.#chart = new ConvergenceChart(this.#part("chart"), this.#store, {
      learners: this.#data.learners.map(({ name }) => name),
      onPick: (iteration) => this.#hold(iteration),
      signal,
    });
    this.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.addEventListener("change", (event) => this.#onChange(event), { signal });
    this.#part("range").addEventListener("input", () => this.#hold(Number(this.#range.value)), { signal });
    this.#part("figures-box").addEventListener("toggle", () => this.#paintFigures(), { signal });
    this.#part("form").addEventListener("submit", (/** @type {Event} */ event) => event.preventDefault(), { signal });
    this.#drawOwnPlay("all");
    if (this.#data.run) this.#watch(this.#data.run);
    this.#schedule();
  }

  disconnectedCallback() {
    this.#life.abort();
    this.#stream.abort();
    cancelAnimationFrame(this.#painting);
    this.#painting = 0;
  }

  /** Ask for a run of the chosen learners and watch it. */
  async learn() {
    if (this.#isAsking) return;
    const learners = this.#panels.filter((panel) => panel.checkbox.checked).map((panel) => panel.learner.name);
    const asked = this.#settings?.read();
    if (learners.length === 0) return this.#complain("Choose at least one learner: tick the box above its board.");
    if (!asked) return this.#openSettings();
    const body = { learners, settings: asked.settings, ...(asked.seed === null ? {} : { seed: asked.seed }) };
    this.#complain("");
    this.#setAsking(true);
    try {
      const run = /** @type {Run} */ (await api.post(`/worlds/${this.#data.world.id}/runs`, body));
      const outcomes = Object.fromEntries(learners.map((learner) => [learner, { outcome: null }]));
      history.replaceState(history.state, "", `/runs/${run.id}`);
      this.#askedAt = performance.now();
      this.#watch({ ...run, learners: run.learners ?? outcomes });
      announce("Learning has been asked for.");
    } catch (error) {
      this.#refused(error);
    } finally {
      this.#setAsking(false);
    }
  }

  async cancel() {
    const run = this.#data.run;
    // The button stands where Learn was: the second press of a double press means nothing.
    if (!run || performance.now() - this.#askedAt < DOUBLE_PRESS_MS) return;
    try {
      await api.post(`/runs/${run.id}/cancellation`, {});
    } catch (error) {
      this.#refused(error);
    }
  }

  /** Learn from failures that never reached the goal, too. */
  includeUnfinished() {
    if (this.#settings) this.#settings.unfinishedFailures = "include";
    this.#weighSettings();
    announce("Failures that never reached the goal are included now.");
    this.#part(this.#part("learn").hidden ? "cancel" : "learn").focus();
    this.#schedule();
  }

  /** What a learner misses depends on whether unfinished failures count. */
  #weighSettings() {
    const { learners, demonstrations, rankings } = this.#data;
    const unfinished = this.#settings?.unfinishedFailures ?? "leave_out";
    for (const learner of learners) {
      const before = learner.missing;
      const atDefault = { ...learner, missing: this.#missing.get(learner.name) ?? null };
      learner.missing = missingWith(atDefault, demonstrations, rankings, unfinished);
      const panel = this.#panels.find((one) => one.learner === learner);
      if (panel && learner.missing !== before) panel.weigh();
    }
  }

  /** @param {Run} run */
  #watch(run) {
    this.#stream.abort();
    this.#stream = new AbortController();
    this.#data.run = run;
    this.#store = new FrameStore();
    this.#timeline = new Timeline();
    this.#progress = new RunProgress(
      run,
      Object.fromEntries(this.#data.learners.map(({ name, title }) => [name, title])),
    );
    this.#chart?.read(this.#store);
    for (const panel of this.#panels) {
      panel.clear();
      panel.checkbox.checked = panel.learner.name in run.learners;
    }
    this.#showFinalStates(run);
    followRun(run.id, this.#listener(), this.#stream.signal);
    this.#touch();
  }

  /** A finished run is on the boards before its recorded frames have come. @param {Run} run */
  #showFinalStates(run) {
    for (const [learner, result] of Object.entries(run.learners)) {
      if (!result.policy || !result.reward || !result.visitation) continue;
      this.#see({
        learner,
        iteration: result.iterations ?? 0,
        iterations: Number(run.settings.iterations ?? result.iterations ?? 0),
        gap: result.gap ?? Number.NaN,
        log_likelihood: result.log_likelihood ?? null,
        reward: result.reward.flat(),
        policy: result.policy,
        visitation: result.visitation.flat(),
      });
    }
  }

  /** @returns {import("#js/learning/run-stream.js").Listener} */
  #listener() {
    const progress = /** @type {RunProgress} */ (this.#progress);
    return {
      frame: (frame) => this.#see(frame),
      learner: ({ learner, ...result }) => {
        const isNews = !progress.isOver && progress.stageOf(learner) !== "learned";
        progress.settle(learner, result);
        if (isNews) announce(`${this.#titleOf(learner)} has learned.`);
        this.#touch();
      },
      end: (status, message) => {
        const isNews = !progress.isOver;
        progress.end(status, message);
        if (isNews) announce(progress.sentence);
        this.#touch();
      },
      connection: (isConnected) => {
        this.#isConnected = isConnected;
        this.#schedule();
      },
      lost: () =>
        this.#complain(
          "The connection to this run was lost. Reload the page to see how it stands; the run itself goes on.",
        ),
    };
  }

  /** @param {Frame} frame */
  #see(frame) {
    this.#store.add(frame);
    this.#progress?.see(frame);
    this.#timeline.extendTo(frame.iteration);
    this.#touch();
  }

  /** @param {number} iteration */
  #hold(iteration) {
    this.#timeline.moveTo(iteration);
    this.#schedule();
  }

  #touch() {
    this.#chartIsOld = true;
    this.#schedule();
  }

  #schedule() {
    if (this.#painting || !this.isConnected) return;
    this.#painting = requestAnimationFrame((now) => {
      this.#painting = 0;
      this.#timeline.advance(Math.min(100, now - this.#paintedAt));
      this.#paintedAt = now;
      this.#paint();
      if (this.#timeline.isPlaying) this.#schedule();
    });
  }

  #paint() {
    this.#paintBoards();
    this.#paintChart();
    this.#paintWords();
    this.#paintTimeline();
  }

  #paintBoards() {
    const shown = { arrows: this.#isOn("arrows"), visits: this.#isOn("visits"), numbers: this.#isOn("numbers") };
    const progress = this.#progress;
    for (const panel of this.#panels) {
      const { name } = panel.learner;
      if (!progress || !(name in (this.#data.run?.learners ?? {}))) continue;
      const frame = this.#timeline.isFollowing
        ? this.#store.latest(name)
        : this.#store.at(name, this.#timeline.position);
      if (frame) panel.show(frame, this.#store.largestReward(name), shown);
      panel.progress({
        stage: progress.stageOf(name),
        share: progress.shareOf(name),
        line: progress.sentenceOf(name, frame),
        outcome: progress.outcomeOf(name),
      });
    }
  }

  #paintChart() {
    if (!this.#chartIsOld) return this.#chart?.moveTo(this.#timeline.position);
    this.#chartIsOld = false;
    this.#chart?.update(this.#timeline.position, this.#lastIteration);
    const learners = this.#data.learners.filter(({ name }) => this.#store.latest(name));
    this.#part("chart").setAttribute("aria-label", chartInWords(this.#store, learners, this.#measure));
    if (this.#part("figures-box").open) this.#paintFigures();
  }

  #paintFigures() {
    const learners = this.#data.learners.filter(({ name }) => this.#store.latest(name));
    this.#part("figures").replaceChildren(figuresTable(this.#store, learners, this.#measure));
  }

  #paintWords() {
    const focused = document.activeElement;
    const { run, demonstrations, rankings, learners } = this.#data;
    const progress = this.#progress;
    const isRunning = progress !== null && !progress.isOver;
    const canLearn = learners.some((learner) => !learner.missing);
    const isOld = run !== null && !isRunning && isOutdated(run, demonstrations, rankings);
    const sentence =
      isRunning && !this.#isConnected
        ? `${progress.sentence} The connection was lost; trying again …`
        : progress?.sentence;
    this.#setText("sentence", sentence ?? `To learn from: ${describeMaterial(demonstrations, rankings)}`);
    this.#setText("notice", isOld ? "You played or ranked again after this run. Learn again to use it." : "");
    this.#part("notice").hidden = !isOld;
    this.#part("cancel").hidden = !isRunning;
    const isDone = progress?.status === "done";
    this.#part("compare").hidden = !isDone;
    this.#part("compare").href = run ? `/runs/${run.id}/comparison` : "#";
    this.#part("learn").hidden = isRunning || !canLearn;
    this.#part("learn").textContent = run ? "Learn again" : "Learn";
    this.#part("learn").classList.toggle("button--primary", !isDone || isOld);
    this.#part("compare").classList.toggle("button--primary", !isOld);
    this.#part("include").hidden = isRunning || !this.#isStuckOnUnfinished;
    this.#paintWayThere(canLearn);
    this.#paintPath(progress?.status ?? "");
    this.#lock(isRunning || this.#isAsking);
    this.#keepFocus(focused);
    this.dataset.status = progress?.status ?? "none";
    this.dataset.frames = String(this.#store.size);
    this.dataset.run = run?.id ?? "";
  }

  get #isStuckOnUnfinished() {
    const { learners, demonstrations } = this.#data;
    const isLeftOut = this.#settings?.unfinishedFailures !== "include";
    return isLeftOut && learners.some((learner) => learner.missing && lacksFinished(demonstrations, learner));
  }

  /** Learn becomes Cancel and Cancel becomes Compare under the finger: the focus goes along. @param {Element | null} focused */
  #keepFocus(focused) {
    const hasVanished = focused instanceof HTMLElement && focused.hidden && this.contains(focused);
    if (!hasVanished) return;
    for (const name of ["cancel", "compare", "learn"]) {
      if (!this.#part(name).hidden) return this.#part(name).focus();
    }
  }

  /** The way to what the first learner that cannot start misses. @param {boolean} canLearn */
  #paintWayThere(canLearn) {
    const { world, demonstrations, learners } = this.#data;
    const stuck = learners.find((learner) => learner.missing);
    const link = this.#part("way-there");
    link.hidden = !stuck || (this.#progress !== null && !this.#progress.isOver);
    if (!stuck) return;
    const way = wayThere(world, demonstrations, stuck, this.#settings?.unfinishedFailures);
    link.href = way.href;
    link.textContent = way.text;
    link.classList.toggle("button--primary", !canLearn);
  }

  /** The path at the top of the page moves on with the run. @param {string} status */
  #paintPath(status) {
    if (!status) return;
    setStep("learn", { state: status, isDone: status === "done" });
    if (status === "done") setStep("compare", { href: this.#part("compare").href });
  }

  #paintTimeline() {
    const { position, isPlaying } = this.#timeline;
    const isEmpty = this.#store.size === 0;
    this.#range.max = String(this.#lastIteration);
    this.#range.value = String(position);
    this.#range.disabled = isEmpty;
    this.#range.setAttribute("aria-valuetext", `iteration ${position}`);
    this.#setText("position", `iteration ${position}`);
    const play = this.#part("play-back");
    play.disabled = isEmpty;
    play.setAttribute("aria-pressed", String(isPlaying));
    this.#part("play-icon").hidden = isPlaying;
    this.#part("pause-icon").hidden = !isPlaying;
    this.#setText("play-word", isPlaying ? "Pause" : "Play back");
    this.dataset.iteration = String(position);
  }

  /** The right end of the time line: the limit while learning, so that nothing moves; then what was reached. */
  get #lastIteration() {
    const limit = Number(this.#data.run?.settings?.iterations ?? 500);
    return this.#progress && !this.#progress.isOver
      ? Math.max(limit, this.#timeline.last)
      : Math.max(1, this.#timeline.last || limit);
  }

  #buildPanels() {
    const template = /** @type {HTMLTemplateElement} */ (this.querySelector("#learner-panel"));
    const { learners, world, demonstrations } = this.#data;
    this.#panels = learners.map(
      (learner) => new LearnerPanel(template, learner, world, untouched(world, demonstrations, learner)),
    );
    const own = /** @type {HTMLElement} */ (this.querySelector(".agent-panel--own"));
    own.parentElement?.replaceChildren(own, ...this.#panels.map((panel) => panel.element));
    for (const panel of this.#panels) panel.checkbox.checked = !panel.learner.missing;
    const key = learners.map(({ name, title }) => {
      const item = document.createElement("li");
      item.append(marker(name), title);
      return item;
    });
    this.#part("chart-key").replaceChildren(...key);
    this.#part("own-board").world = world;
  }

  /** @param {string} which */
  #drawOwnPlay(which) {
    const { demonstrations, rankings } = this.#data;
    const outcomes = /** @type {const} */ (["failure", "success"]).filter(
      (outcome) => which === "all" || which === outcome,
    );
    const drawn = outcomes.flatMap((outcome) => weighted(demonstrations, rankings, outcome).reverse());
    const heaviest = Math.max(...drawn.map(({ weight }) => weight));
    const board = this.#part("own-board");
    board.view = {
      paths: drawn.map(({ demonstration, weight }) => ({
        states: demonstration.states,
        who: "human",
        width: weight / heaviest,
        opacity: demonstration.outcome === "success" || which !== "all" ? 0.9 : 0.45,
      })),
    };
    board.label = `The world with ${drawn.length} of your attempts drawn as lines; the heavier its weight, the wider.`;
  }

  /** @param {Event} event */
  #onClick(event) {
    const action =
      event.target instanceof Element ? event.target.closest("[data-action]")?.getAttribute("data-action") : null;
    if (action === "learn") this.learn();
    if (action === "cancel") this.cancel();
    if (action === "include") this.includeUnfinished();
    if (action === "play-back") {
      if (this.#timeline.isPlaying) this.#timeline.pause();
      else this.#timeline.play();
      this.#paintedAt = performance.now();
      this.#schedule();
    }
  }

  /** @param {Event} event */
  #onChange(event) {
    const control = /** @type {HTMLInputElement} */ (event.target);
    if (control.name === "unfinished_failures") this.#weighSettings();
    if (control.name === "drawn") this.#drawOwnPlay(control.value);
    if (control.name === "measure") {
      this.#measure = control.value === "gap" ? "gap" : "log_likelihood";
      this.#setText("chart-title", measureTitle(this.#measure));
      this.#setText("measure-help", measureHelp(this.#measure));
      this.#chart?.show(this.#measure);
      this.#chartIsOld = true;
    }
    this.#schedule();
  }

  /** @param {unknown} error */
  #refused(error) {
    if (!(error instanceof ApiError)) throw error;
    const fields = Object.entries(error.fields);
    const known = fields.filter(([name, sentence]) =>
      this.#settings?.complain(name.split(".").at(-1) ?? "", String(sentence)),
    );
    if (known.length > 0) this.#openSettings();
    this.#complain(error.message);
  }

  #openSettings() {
    this.#part("settings").open = true;
    this.#settings?.focusFirstProblem();
  }

  /** @param {string} sentence */
  #complain(sentence) {
    this.#setText("problem", sentence);
    this.#part("problem").hidden = sentence === "";
  }

  /** @param {boolean} isAsking */
  #setAsking(isAsking) {
    this.#isAsking = isAsking;
    // Not `disabled`, which would let go of the focus.
    this.#part("learn").setAttribute("aria-disabled", String(isAsking));
    this.#schedule();
  }

  /** @param {boolean} isLocked */
  #lock(isLocked) {
    for (const panel of this.#panels) panel.checkbox.disabled = isLocked || panel.learner.missing !== null;
    if (this.#settings) this.#settings.disabled = isLocked;
  }

  /** @param {string} name */
  #isOn(name) {
    return /** @type {HTMLInputElement} */ (this.querySelector(`.learn-toggles input[name="${name}"]`)).checked;
  }

  /** @param {string} learner */
  #titleOf(learner) {
    return this.#data.learners.find(({ name }) => name === learner)?.title ?? learner;
  }

  get #range() {
    return /** @type {HTMLInputElement} */ (this.#part("range"));
  }

  /** @param {string} name @param {string} text */
  #setText(name, text) {
    const part = this.#part(name);
    if (part.textContent !== text) part.textContent = text;
  }

  /** A named part of the markup; which element it is stands in the template. @param {string} name @returns {any} */
  #part(name) {
    return this.querySelector(`[data-part="${name}"], [data-action="${name}"]`);
  }
}

customElements.define("learn-page", LearnPage);
