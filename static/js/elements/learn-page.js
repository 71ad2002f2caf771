/**
 * `<learn-page>`: choose learners and settings, press Learn, watch the rewards grow. The boards, the chart and the time
 * line all show one iteration; whatever arrives is painted once an animation frame.
 * @import {Frame, LearnPageData, Run} from "#js/learning/types.js"
 */
import "#js/elements/irl-board.js";
import { ConvergenceChart } from "#js/charts/convergence-chart.js";
import { chartInWords, figuresTable, measureHelp, measureTitle } from "#js/learning/chart-words.js";
import { FrameStore } from "#js/learning/frame-store.js";
import { LineUp } from "#js/learning/line-up.js";
import { describeMaterial, isOutdated, lacksFinished, missingWith, wayThere } from "#js/learning/material.js";
import { drawOwnPlay } from "#js/learning/own-play.js";
import { RunProgress } from "#js/learning/progress.js";
import { followRun } from "#js/learning/run-stream.js";
import { Scrubber } from "#js/learning/scrubber.js";
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
  #lineUp = new LineUp(this, this.#data);
  #scrubber = new Scrubber(this);
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
    this.#part("own-board").world = this.#data.world;
    this.#chart = new ConvergenceChart(this.#part("chart"), this.#store, {
      learners: this.#data.learners.map(({ name }) => name),
      onPick: (iteration) => this.#hold(iteration),
      signal,
    });
    this.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.addEventListener("change", (event) => this.#onChange(event), { signal });
    const { range } = this.#scrubber;
    range.addEventListener("input", () => this.#hold(Number(range.value)), { signal });
    this.#part("figures-box").addEventListener("toggle", () => this.#paintFigures(), { signal });
    this.#part("form").addEventListener("submit", (/** @type {Event} */ event) => event.preventDefault(), { signal });
    drawOwnPlay(this.#part("own-board"), this.#data, "all");
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
    const learners = this.#lineUp.chosen;
    const asked = this.#settings?.read();
    if (learners.length === 0) return this.#complain("Choose at least one learner: tick the box above its board.");
    if (!asked) return this.#openSettings();
    const body = { learners, settings: asked.settings, ...(asked.seed === null ? {} : { seed: asked.seed }) };
    this.#complain("");
    this.#setAsking(true);
    this.#askedAt = performance.now();
    try {
      const run = /** @type {Run} */ (await api.post(`/worlds/${this.#data.world.id}/runs`, body));
      const outcomes = Object.fromEntries(learners.map((learner) => [learner, { outcome: null }]));
      history.replaceState(history.state, "", `/runs/${run.id}`);
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
      if (learner.missing !== before) this.#lineUp.weigh(learner);
    }
  }

  /** @param {Run} run */
  #watch(run) {
    this.#stream.abort();
    this.#stream = new AbortController();
    this.#data.run = run;
    this.#store = new FrameStore();
    this.#timeline = new Timeline();
    this.#progress = new RunProgress(run, this.#data.learners);
    this.#chart?.read(this.#store);
    this.#lineUp.begin(Object.keys(run.learners));
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
        iterations: result.iterations ?? 0,
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
    for (const panel of this.#lineUp.panels) {
      const { name } = panel.learner;
      if (!progress || !(name in (this.#data.run?.learners ?? {}))) continue;
      const frame = this.#timeline.isFollowing
        ? this.#store.latest(name)
        : this.#store.at(name, this.#timeline.position);
      if (frame) panel.show(frame, this.#store.largestReward(panel.learner), shown);
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
    this.#setText("measure-help", measureHelp(this.#measure, learners));
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
    const { world, demonstrations } = this.#data;
    const stuck = this.#lineUp.learners.find((learner) => learner.missing);
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
    this.#scrubber.paint(this.#timeline, this.#lastIteration, this.#store.size === 0);
    this.dataset.iteration = String(this.#timeline.position);
  }

  /** The right end of the time line: the limit while learning, so that nothing moves; then what was reached. */
  get #lastIteration() {
    const limit = this.#progress?.limit || Number(this.#data.run?.settings?.iterations ?? 500);
    return this.#progress && !this.#progress.isOver
      ? Math.max(limit, this.#timeline.last)
      : Math.max(1, this.#timeline.last || limit);
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
    if (control.name === "learner" || control.name === "more-learner") this.#lineUp.change(control);
    if (control.name === "drawn") drawOwnPlay(this.#part("own-board"), this.#data, control.value);
    if (control.name === "measure") {
      this.#measure = control.value === "gap" ? "gap" : "log_likelihood";
      this.#setText("chart-title", measureTitle(this.#measure));
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
    this.#lineUp.isLocked = isLocked;
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
