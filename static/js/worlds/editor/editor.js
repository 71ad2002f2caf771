/** The editor of worlds: what is painted shows at once, the address keeps it, the server says what it is like. An entry script. */

import "#js/elements/irl-board.js";
import { announce } from "#js/lib/announce.js";
import { api } from "#js/lib/api.js";
import { byId } from "#js/lib/dom.js";
import { isTaken, letterOf } from "#js/lib/keys.js";
import { pageData } from "#js/lib/page-data.js";
import { Address } from "#js/worlds/editor/address.js";
import { Easel } from "#js/worlds/editor/easel.js";
import { Fields } from "#js/worlds/editor/fields.js";
import { Ground } from "#js/worlds/editor/ground.js";
import { Hand } from "#js/worlds/editor/hand.js";
import { History } from "#js/worlds/editor/history.js";
import { cleared, placeAt, planOf, specOf } from "#js/worlds/editor/plan.js";
import { PooledField } from "#js/worlds/editor/pooled-field.js";
import { Presets } from "#js/worlds/editor/presets.js";
import { Preview } from "#js/worlds/editor/preview.js";
import { Report } from "#js/worlds/editor/report.js";
import { GONE, refusalOf, shortestWay, squareSentence, TOO_LARGE, verdictOf } from "#js/worlds/editor/sentences.js";
import { Sharing } from "#js/worlds/editor/sharing.js";
import { ToolBox } from "#js/worlds/editor/toolbox.js";
import { WayField } from "#js/worlds/editor/way-field.js";
import { toQuery } from "#js/worlds/query.js";

/** @typedef {import("#js/worlds/editor/plan.js").Plan} Plan */
/** @typedef {import("#js/worlds/editor/preview.js").PreviewWorld} PreviewWorld */
/** @typedef {{message: string, fields: Record<string, string>}} Problem */
/**
 * @typedef {object} PageData
 * @property {import("#js/worlds/query.js").Spec} spec
 * @property {PreviewWorld | null} world
 * @property {Problem | null} problem
 * @property {import("#js/worlds/editor/presets.js").Preset[]} presets
 * @property {{query_length: [number, number]}} limits
 */

/** The fields of the panel, and what they are called in a plan. */
const NUMBERS = /** @type {const} */ ({
  rows: "rows",
  cols: "cols",
  seed: "seed",
  red_probability: "redProbability",
  slip: "slip",
  step_limit: "stepLimit",
  time_limit_s: "timeLimitS",
});
/** What the server says of these stands beside the tools. */
const MARKS = ["walls", "start", "goals", "painted"];
const NUMBER_KEY = /^(?:Digit|Numpad)([1-6])$/;

class EditorPage {
  #life = new AbortController();
  /** @type {PageData} */
  #data = pageData();
  #kept = Address.kept();
  /** @type {History<Plan>} */
  #history = new History(planOf({ seed: randomSeed(), ...(this.#kept ?? this.#data.spec) }));
  /** What was wrong with the address: said until something is changed. */
  #problem = this.#kept ? null : this.#data.problem;
  #ground = new Ground();
  #query = "";
  /** The last answer of the server. @type {{query: string, world: PreviewWorld} | null} */
  #answer = null;
  #refusal = "";
  #marksProblem = "";
  #board = /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (byId("board"));
  #address = new Address();
  #report = new Report();
  #sharing = new Sharing(this.#address, this.#report);
  #tools = new ToolBox(announce);
  #easel = new Easel(this.#board, new Hand(this));
  #presets = new Presets({ list: byId("presets"), words: byId("preset-text"), presets: this.#data.presets });
  #fields = new Fields(/** @type {(keyof typeof NUMBERS)[]} */ (Object.keys(NUMBERS)), {
    set: (name, value) => this.#set(NUMBERS[/** @type {keyof typeof NUMBERS} */ (name)], value),
    end: () => this.settle(),
    refuse: announce,
  });
  #way = new WayField((rankBy) => this.change({ ...this.plan, rankBy }));
  #pooled = new PooledField((pooled) => this.change({ ...this.plan, pooled }));
  #preview = new Preview(api.get, {
    answer: (world) => this.#learn(world),
    refuse: (problem) => this.#tell(problem),
    miss: () => this.#judge({ state: "gone", text: GONE }),
  });

  start() {
    const { signal } = this.#life;
    if (this.#data.world && !this.#kept) {
      this.#query = toQuery(specOf(this.plan));
      this.#address.show(specOf(this.plan), this.#query);
      this.#learn(this.#data.world);
    }
    for (const part of [this.#tools, this.#fields, this.#way, this.#pooled, this.#easel, this.#sharing])
      part.listen(signal);
    this.#presets.listen((preset) => this.change(planOf(preset.spec)), signal);
    this.#listenToButtons(signal);
    document.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    window.addEventListener("online", () => this.#preview.askAgain(), { signal });
    this.#show();
    byId("notice").hidden = !this.#problem;
    if (this.#problem) this.#tellFields(this.#problem.fields);
    void this.#presets.draw();
  }

  get plan() {
    return this.#history.present;
  }

  get brush() {
    return this.#tools.brush;
  }

  set brush(brush) {
    this.#tools.brush = brush;
  }

  /** @param {number} square */
  rewardAt(square) {
    return this.#board.world?.rewards.flat()[square] ?? 0;
  }

  /** @param {Plan} plan @param {unknown} [gesture] */
  change(plan, gesture = null) {
    this.#history.change(plan, gesture);
    this.#forgetProblem();
    this.#show();
    if (gesture === null) this.settle();
  }

  /** A stroke or a pull on a slider is over. */
  settle() {
    this.#history.endGesture();
    if (!this.#problem) this.#address.write();
  }

  undo() {
    if (!this.#history.canUndo) return;
    this.#history.undo();
    this.#show();
    announce("Taken back.");
  }

  redo() {
    if (!this.#history.canRedo) return;
    this.#history.redo();
    this.#show();
    announce("Brought back.");
  }

  /** @param {string} sentence what the last stroke could not do */
  refuse(sentence) {
    this.#refusal = sentence;
    this.#showMarksProblem();
  }

  /** @param {number} square */
  look(square) {
    const world = this.#board.world;
    if (world) announce(squareSentence(world, square, this.plan.painted.has(placeAt(world, square))));
  }

  /** @param {string} sentence */
  say(sentence) {
    announce(sentence);
  }

  /** @param {keyof Plan} key @param {number | null} value */
  #set(key, value) {
    if (this.plan[key] !== value) this.change({ ...this.plan, [key]: value }, key);
  }

  #show() {
    const plan = this.plan;
    const spec = specOf(plan);
    const query = toQuery(spec);
    const isNew = query !== this.#query;
    this.#query = query;
    if (!this.#problem) this.#address.show(spec, query);
    const world = this.#answer?.query === query ? this.#answer.world : this.#ground.draw(plan);
    this.#easel.show(world);
    this.#board.label = `The world you are making: ${plan.rows} by ${plan.cols} squares.`;
    byId("editor").style.setProperty("--world-ratio", String(plan.cols / plan.rows));
    this.#tools.fit(plan);
    this.#fields.show(Object.fromEntries(Object.entries(NUMBERS).map(([name, key]) => [name, plan[key]])));
    this.#way.show(plan.rankBy);
    this.#pooled.show(plan.pooled);
    this.#presets.show(query);
    const nSteps = shortestWay(world);
    this.#report.showFacts(plan, nSteps);
    this.#sharing.forget();
    /** @type {HTMLButtonElement} */ (byId("undo")).disabled = !this.#history.canUndo;
    /** @type {HTMLButtonElement} */ (byId("redo")).disabled = !this.#history.canRedo;
    if (isNew || !this.#answer) this.#ask(query, nSteps);
  }

  /** @param {string} query @param {number | null} nSteps the shortest way */
  #ask(query, nSteps) {
    this.#preview.stop();
    const refusal = refusalOf(this.plan, nSteps);
    if (refusal) return this.#tell(refusal);
    if (!this.#problem) this.#tellFields({});
    if (query.length > this.#data.limits.query_length[1]) return this.#judge({ state: "checking", text: TOO_LARGE });
    this.#report.look();
    this.#preview.ask(query);
  }

  /** @param {PreviewWorld} world what the newest question asked for */
  #learn(world) {
    this.#answer = { query: this.#query, world };
    this.#ground.learn(world);
    this.#easel.show(world);
    this.#report.learn(this.plan, world);
    if (!this.#problem) this.#tellFields({});
    this.#judge(verdictOf(world, this.plan.stepLimit !== null));
  }

  /** @param {Problem} problem */
  #tell({ message, fields }) {
    this.#tellFields(fields);
    this.#judge({ state: "refused", text: message });
  }

  /** @param {Record<string, string>} fields */
  #tellFields(fields) {
    this.#fields.tell(fields);
    this.#way.tell(fields.rank_by ?? "");
    this.#pooled.tell(fields.pooled ?? "");
    this.#marksProblem = MARKS.map((name) => fields[name] ?? "").find(Boolean) ?? "";
    this.#showMarksProblem();
  }

  #showMarksProblem() {
    const line = byId("marks-problem");
    line.textContent = this.#refusal || this.#marksProblem;
    line.hidden = line.textContent === "";
  }

  /** @param {import("#js/worlds/editor/sentences.js").Verdict} verdict */
  #judge(verdict) {
    this.#report.show(verdict);
    this.#sharing.show();
  }

  /** The first change makes the address of the page this world's. */
  #forgetProblem() {
    if (!this.#problem) return;
    this.#problem = null;
    byId("notice").hidden = true;
    this.#tellFields({});
  }

  /** @param {AbortSignal} signal */
  #listenToButtons(signal) {
    const acts = {
      undo: () => this.undo(),
      redo: () => this.redo(),
      clear: () => this.#clear(),
      dice: () => this.change({ ...this.plan, seed: randomSeed() }),
      numbers: () => this.#toggleNumbers(),
    };
    for (const [id, act] of Object.entries(acts)) byId(id).addEventListener("click", act, { signal });
    byId("numbers-form").addEventListener("submit", (event) => event.preventDefault(), { signal });
  }

  #clear() {
    this.change(cleared(this.plan));
    announce("Cleared. Undo brings everything back.");
  }

  #toggleNumbers() {
    const isShown = !this.#board.view.numbers;
    byId("numbers").setAttribute("aria-pressed", String(isShown));
    this.#board.view = { ...this.#board.view, numbers: isShown };
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (letterOf(event) === "z" && (isUndoShortcut(event) || !isTaken(event))) {
      event.preventDefault();
      if (event.shiftKey) this.redo();
      else this.undo();
    } else if (!isTaken(event)) this.#chooseTool(event);
  }

  /** By where the key is: on some keyboards the digits need Shift. @param {KeyboardEvent} event */
  #chooseTool(event) {
    const digit = NUMBER_KEY.exec(event.code)?.[1];
    if (digit) announce(`Tool: ${this.#tools.chooseNth(Number(digit))}.`);
  }
}

/** Ctrl+Z, too, where no text is being typed. @param {KeyboardEvent} event */
function isUndoShortcut(event) {
  const isText = event.target instanceof HTMLInputElement && !["range", "radio"].includes(event.target.type);
  return (event.ctrlKey || event.metaKey) && !event.altKey && !isText;
}

function randomSeed() {
  return crypto.getRandomValues(new Uint32Array(1))[0] ?? 0;
}

new EditorPage().start();
