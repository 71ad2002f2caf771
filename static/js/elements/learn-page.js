/**
 * `<learn-page>`: choose learners and settings, press Learn, watch the rewards grow. The boards, the charts and the time
 * line all show one iteration; whatever arrives is painted once an animation frame. Each part shows itself; this puts
 * them together.
 * @import {LearnPageData, Run} from "#js/learning/types.js"
 * @import {WatchedRun} from "#js/learning/watched-run.js"
 */
import "#js/elements/irl-board.js";
import { Beat } from "#js/learning/beat.js";
import { Boards } from "#js/learning/boards.js";
import { Charts } from "#js/learning/charts.js";
import { Commands } from "#js/learning/commands.js";
import { Head } from "#js/learning/head.js";
import { Playback } from "#js/learning/playback.js";
import { Runs } from "#js/learning/runs.js";
import { RunsList } from "#js/learning/runs-list.js";
import { SetUp } from "#js/learning/set-up.js";
import { Sharing } from "#js/learning/sharing.js";
import { announce } from "#js/lib/announce.js";
import { pageData } from "#js/lib/page-data.js";

/** Learners end one upon another: who listens is told of one in so long (ms); the end of the run is always told. */
const NEWS_EVERY_MS = 4_000;

export class LearnPage extends HTMLElement {
  #life = new AbortController();
  /** @type {LearnPageData} */
  #data = pageData();
  #boards = new Boards(this, this.#data);
  #setUp = new SetUp(this, this.#data, this.#boards.lineUp);
  #head = new Head(this, this.#data, this.#boards.lineUp, this.#setUp);
  #charts = new Charts(this, this.#data);
  #playback = new Playback(this);
  #sharing = new Sharing(this, this.#data.world, (sentence) => this.#head.complain(sentence));
  #beat = new Beat((now) => this.#paint(now));
  #runs = this.#newRuns();
  #list = new RunsList(this, this.#data, this.#runs);
  #commands = new Commands({
    root: this,
    data: this.#data,
    runs: this.#runs,
    head: this.#head,
    setUp: this.#setUp,
    lineUp: this.#boards.lineUp,
    show: (run) => this.#show(run),
    changed: () => this.#beat.ask(),
  });
  #toldAt = Number.NEGATIVE_INFINITY;

  connectedCallback() {
    const { signal } = this.#life;
    const changed = () => this.#beat.ask();
    this.#boards.start(signal, changed);
    this.#setUp.start(signal, changed);
    this.#charts.start(signal, (iteration) => this.#playback.moveTo(iteration, changed));
    this.#playback.start(signal, changed);
    if (this.#isOwn) this.#sharing.start(signal);
    this.#list.start(signal, (act, run) => this.#act(act, run));
    this.addEventListener("click", (event) => this.#onClick(event), { signal });
    window.addEventListener("popstate", () => location.reload(), { signal });
    this.#begin();
  }

  disconnectedCallback() {
    this.#life.abort();
    this.#beat.stop();
  }

  #newRuns() {
    const heed = {
      changed: () => this.#beat.ask(),
      learned: (/** @type {WatchedRun} */ run, /** @type {string} */ learner) => this.#tellLearned(run, learner),
      ended: (/** @type {WatchedRun} */ run) => this.#tellEnded(run),
    };
    return new Runs(this.#data, heed, this.#life.signal);
  }

  #begin() {
    const { run } = this.#data;
    if (run) this.#runs.show(run);
    if (run) this.#boards.lineUp.begin(Object.keys(run.learners));
    if (this.#isOwn) void this.#runs.load();
    this.#beat.ask();
  }

  /** False where it was opened by a shared link: all can be seen, nothing changed. */
  get #isOwn() {
    return this.#data.is_own ?? true;
  }

  /** Put a run on the boards, or none, to think of another. @param {Run | null} run */
  #show(run) {
    this.#data.run = run;
    const { lineUp } = this.#boards;
    if (run) this.#runs.show(run);
    else this.#runs.showNone();
    lineUp.begin(run ? Object.keys(run.learners) : lineUp.chosen);
    const address = run ? `/runs/${run.id}` : `/worlds/${this.#data.world.id}/learn`;
    history.replaceState(history.state, "", address);
    this.#beat.ask();
  }

  /** One animation frame. @param {number} now */
  #paint(now) {
    const watched = this.#runs.shown;
    const isPlaying = this.#playback.advance(watched, now);
    const isGoing = watched !== null && !watched.progress.isOver;
    const { isAsking } = this.#commands;
    this.#boards.paint(watched);
    this.#charts.paint(watched);
    this.#playback.paint();
    if (this.#isOwn) this.#list.paint();
    if (this.#isOwn) this.#sharing.paint(watched?.run ?? null);
    this.#setUp.paint(isGoing || isAsking || !this.#isOwn);
    this.#head.paint(watched, { isConnected: this.#runs.isConnected, isAsking });
    this.dataset.status = watched?.progress.status ?? "none";
    this.dataset.frames = String(watched?.store.size ?? 0);
    this.dataset.iteration = String(watched?.timeline.position ?? 0);
    this.dataset.run = watched?.id ?? "";
    return isPlaying;
  }

  /** @param {WatchedRun} run @param {string} learner */
  #tellLearned(run, learner) {
    if (run !== this.#runs.shown || performance.now() - this.#toldAt < NEWS_EVERY_MS) return;
    this.#toldAt = performance.now();
    const title = this.#data.learners.find(({ name }) => name === learner)?.title ?? learner;
    announce(`${title} has learned.`);
  }

  /** @param {WatchedRun} run */
  #tellEnded(run) {
    const { status, sentence } = run.progress;
    announce(run === this.#runs.shown ? sentence : `Another run is ${status}.`);
  }

  /** @param {MouseEvent} event */
  #onClick({ target }) {
    const action = target instanceof Element ? target.closest("[data-action]")?.getAttribute("data-action") : null;
    if (action === "learn") void this.#commands.learn();
    if (action === "cancel") void this.#commands.cancelShown();
    if (action === "again") this.#commands.again();
    if (action === "include") this.#commands.includeUnfinished();
  }

  /** Something was asked of a run in the list. @param {import("#js/learning/runs-list.js").Act} act @param {WatchedRun} run */
  #act(act, run) {
    if (act === "cancel") void this.#commands.cancel(run);
    if (act === "again") this.#commands.again(run);
    if (act === "delete") void this.#commands.remove(run);
  }
}

customElements.define("learn-page", LearnPage);
