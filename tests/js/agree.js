/**
 * The browser's side of tests/app/test_agreement.py: reads a session a line (JSON: a world, the keys pressed in it, what
 * chance there is) and answers with a line that tells the finished attempts as the page would show and send them.
 *
 * A key goes the page's way: an event to `listenToKeys`, to a player, to `PlaySession` and the moves. Only what is
 * between a player and the document is missing, and chance and time are what the line says.
 */

import { createInterface } from "node:readline";

const nothing = () => [];
globalThis.Element = class {};
globalThis.document = Object.assign(new EventTarget(), { querySelectorAll: nothing });
globalThis.window = new EventTarget();

const { listenToKeys } = await import("#js/board/input.js");
const { canBranch, outcomeOf, totalOf } = await import("#js/board/moves.js");
const { bodyOf, entryOfAttempt, entryOfParcel } = await import("#js/worlds/entries.js");
const { PlaySession } = await import("#js/worlds/session.js");

const PRESS_MS = 173.4;
const PAUSE_MS = 4000;

/** What stands for which press; capitals and signs are presses that must not move anything. */
const KEYS = {
  "^": { key: "ArrowUp", code: "ArrowUp" },
  ">": { key: "ArrowRight", code: "ArrowRight" },
  v: { key: "ArrowDown", code: "ArrowDown" },
  "<": { key: "ArrowLeft", code: "ArrowLeft" },
  w: { key: "w", code: "KeyW" },
  d: { key: "d", code: "KeyD" },
  s: { key: "s", code: "KeyS" },
  a: { key: "a", code: "KeyA" },
  k: { key: "k", code: "KeyK" },
  l: { key: "л", code: "KeyL" },
  j: { key: "J", code: "KeyJ" },
  h: { key: "h", code: "KeyX" },
  z: { key: "z", code: "KeyZ" },
  b: { key: "Backspace", code: "Backspace" },
  r: { key: "r", code: "KeyR" },
  g: { key: "g", code: "KeyG" },
  e: { key: "Enter", code: "Enter" },
  t: { key: "t", code: "KeyT" },
  R: { key: "ArrowRight", code: "ArrowRight", repeat: true },
  C: { key: "ArrowDown", code: "ArrowDown", ctrlKey: true },
  S: { key: "ArrowDown", code: "ArrowDown", shiftKey: true },
  "?": { key: "?", code: "Slash" },
};

class Player {
  /** @type {import("#js/worlds/entries.js").Entry[]} */
  #entries = [];
  #attempts = [];
  #world;
  #session;
  #salt;
  #picks;
  #nIds = 0;
  #now = 1000;

  /** @param {{world: any, salt: number, picks: number}} line */
  constructor({ world, salt, picks }) {
    this.#world = world;
    this.#salt = salt;
    this.#picks = picks;
    this.#session = this.#fresh();
  }

  /** @param {string} keys */
  play(keys) {
    const life = new AbortController();
    listenToKeys(this, { signal: life.signal });
    for (const key of keys) this.#press(key);
    life.abort();
    this.command("giveUp");
    return this.#attempts;
  }

  move(action, { when, device }) {
    const wasOver = this.#session.isOver;
    const isTimed = this.#picks % 3 > 0;
    this.#session.move(action, { when, device, paintedAt: isTimed ? when - 120 : Number.NaN });
    if (this.#session.isOver && !wasOver) this.#finish();
    return !this.#session.isOver;
  }

  look(direction) {
    this.#session.note("look", this.#now, direction);
  }

  command(command) {
    const session = this.#session;
    if (command === "undo") session.undo(this.#now);
    else if (command === "giveUp") this.#end(() => session.giveUp());
    else if (command === "restart" || (command === "again" && session.isOver)) session.begin(this.#now);
    else if (command === "branch") this.#branch();
  }

  /** @param {string} key */
  #press(key) {
    this.#now += PRESS_MS;
    if (key === ".") this.#pause();
    else if (key === "o") this.#reload();
    else for (const type of ["keydown", "keyup"]) document.dispatchEvent(this.#event(type, KEYS[key]));
  }

  #event(type, press) {
    const event = Object.assign(new Event(type, { cancelable: true }), press);
    return Object.defineProperty(event, "timeStamp", { value: this.#now });
  }

  #pause() {
    this.#now += PAUSE_MS;
    this.#end(() => this.#session.tick(this.#now));
  }

  /** The page is closed and opened: what was kept of the attempt is walked again. */
  #reload() {
    if (this.#session.isOver || !this.#session.hasOwnSteps) return;
    const draft = JSON.parse(JSON.stringify(this.#session.draft(this.#now)));
    this.#session = this.#fresh();
    if (!this.#session.resume(draft, this.#now, 1000)) throw new Error("An unfinished attempt could not go on.");
  }

  /** Try again from some step, often the last, of some attempt that is finished. */
  #branch() {
    const parent = this.#entries[this.#pick(this.#entries.length)];
    if (!parent) return;
    const k = this.#pick(3) === 0 ? parent.actions.length : 1 + this.#pick(parent.actions.length);
    if (canBranch(this.#world, parent, k)) this.#session.beginFrom(parent, k, this.#now);
  }

  #end(act) {
    if (act()) this.#finish();
  }

  #finish() {
    const { attempt } = this.#session;
    const body = bodyOf(attempt, this.#session.record(this.#now, CLIENT));
    const [total, outcome] = [totalOf(attempt), outcomeOf(attempt)];
    if (Object.is(total, -0)) throw new Error("A total of nothing has a sign.");
    this.#attempts.push({ ...attempt, total, outcome, body });
    const parcel = JSON.parse(JSON.stringify({ id: attempt.id, body, slipSeeds: attempt.slipSeeds, refusal: null }));
    this.#entries.push(this.#pick(2) ? entryOfAttempt(attempt) : entryOfParcel(this.#world, parcel));
  }

  #fresh() {
    return new PlaySession({ world: this.#world, newId: () => this.#newId(), at: this.#now });
  }

  #newId() {
    this.#nIds += 1;
    return `${hex(this.#salt, 8)}-0000-4000-8000-${hex(this.#nIds, 12)}`;
  }

  /** The next of a row of numbers below n that look like chance. @param {number} n */
  #pick(n) {
    this.#picks = (Math.imul(this.#picks, 1664525) + 1013904223) >>> 0;
    return Math.floor((this.#picks / 2 ** 32) * n);
  }
}

const CLIENT = {
  agent: "desktop Chromium",
  viewport: [1280, 800],
  pixel_ratio: 1,
  refresh_hz: null,
  pointer: "fine",
  reduced_motion: false,
  forced_colours: false,
  dark: false,
  totals_shown: true,
  hold_to_move: false,
};

/** @param {number} number @param {number} nDigits */
function hex(number, nDigits) {
  return number.toString(16).padStart(nDigits, "0");
}

for await (const line of createInterface({ input: process.stdin })) {
  const told = JSON.parse(line);
  process.stdout.write(`${JSON.stringify(new Player(told).play(told.keys))}\n`);
}
