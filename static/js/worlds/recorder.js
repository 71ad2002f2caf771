/**
 * What is measured about the playing of one attempt, beside the attempt itself: reaction times, devices, undone steps,
 * where the attention went. The columns and their units: docs/codebook.md.
 *
 * Times are those of the monotonic clock (`event.timeStamp`, `performance.now()`), counted from the attempt's begin and
 * without the time in which the page was closed. The wall clock serves only to notice when the two move apart: a
 * computer that slept, a clock that was set.
 */

const DEVICES = /** @type {const} */ (["key", "hold", "pad", "swipe", "tap", "gamepad", "copied"]);
const EVENTS = /** @type {const} */ ([
  "undo",
  "blur",
  "focus",
  "hidden",
  "visible",
  "resumed",
  "clock",
  "numbers",
  "look",
]);

/** @typedef {typeof DEVICES[number]} Device */
/** @typedef {typeof EVENTS[number]} EventType */
/** @typedef {{type: EventType, at_ms: number, step: number, value: number | null}} Happening */
/** @typedef {{n_steps: number, elapsed_ms: number}} Abandoned */

/**
 * @typedef {object} Notes   everything a recorder knows, as it is kept in an unfinished attempt
 * @property {(number | null)[]} rt
 * @property {Device[]} device
 * @property {Happening[]} events
 * @property {number} elapsed_ms
 * @property {number | null} first_step_ms   when the first step of one's own was made
 * @property {Abandoned[]} abandoned
 */

const MOST_EVENTS = 5000;
const MOST_ABANDONED = 200;
const MOST_ELAPSED_MS = 7 * 86_400_000;
/** Wall and monotonic clock drift by less than this unless something happened. */
const CLOCK_JUMP_MS = 2000;

export class Recorder {
  /** @type {Notes} */
  #notes;
  #begunAt;
  #lead;
  /** @type {() => number} */
  #now;
  /** @type {() => number} */
  #wall;

  /**
   * @param {object} parts
   * @param {number} parts.at                  monotonic ms at which the attempt begins, or goes on
   * @param {Partial<Notes>} [parts.notes]     of an attempt that goes on
   * @param {() => number} [parts.wall]        ms since 1970
   * @param {() => number} [parts.now]         monotonic ms
   */
  constructor({ at, notes = {}, wall = Date.now, now = () => performance.now() }) {
    this.#notes = soundNotes(notes);
    this.#begunAt = at - this.#notes.elapsed_ms;
    [this.#wall, this.#now] = [wall, now];
    this.#lead = wall() - now();
  }

  /** Steps without measures (copied from another attempt, or their measures are lost) get empty ones. @param {number} nSteps */
  fit(nSteps) {
    const { rt, device } = this.#notes;
    if (rt.length === nSteps && device.length === nSteps) return;
    this.#notes.rt = Array(nSteps).fill(null);
    this.#notes.device = Array(nSteps).fill("copied");
  }

  /** @param {object} step @param {number} step.when @param {Device} step.device @param {number} step.paintedAt NaN while unpainted */
  step({ when, device, paintedAt }) {
    const rt = when - paintedAt;
    this.#notes.first_step_ms ??= this.#at(when);
    this.#notes.rt.push(rt >= 0 ? tenths(rt) : null);
    this.#notes.device.push(device);
  }

  /** @param {number} when @param {number} action the one taken back */
  undo(when, action) {
    this.event("undo", when, action);
    this.#notes.rt.pop();
    this.#notes.device.pop();
  }

  /** @param {EventType} type @param {number} when @param {number | null} [value] */
  event(type, when, value = null) {
    if (this.#notes.events.length >= MOST_EVENTS) return;
    this.#notes.events.push({ type, at_ms: this.#at(when), step: this.#notes.rt.length, value });
  }

  /** Notice a clock that jumped, and by how much (ms); 0 if none did. @param {number} when */
  checkClock(when) {
    const lead = this.#wall() - this.#now();
    const by = Math.round(lead - this.#lead);
    if (Math.abs(by) < CLOCK_JUMP_MS) return 0;
    this.#lead = lead;
    this.event("clock", when, by);
    return by;
  }

  /** Ms since the first step of one's own; 0 before it. @param {number} when */
  sinceFirstStep(when) {
    const first = this.#notes.first_step_ms;
    return first === null ? 0 : Math.max(0, this.#at(when) - first);
  }

  /** What this attempt adds to the list when it is thrown away. @param {number} when @returns {Abandoned[]} */
  abandonedWithThis(when) {
    const { rt, abandoned } = this.#notes;
    return [...abandoned, { n_steps: rt.length, elapsed_ms: this.#at(when) }].slice(-MOST_ABANDONED);
  }

  /** For the unfinished attempt, as they are now: they may be written only after the next step. @param {number} when @returns {Notes} */
  notes(when) {
    const { rt, device, events } = this.#notes;
    const lists = { rt: rt.slice(), device: device.slice(), events: events.slice() };
    return { ...this.#notes, ...lists, elapsed_ms: this.#at(when) };
  }

  /** For the server. @param {number} when @param {Record<string, unknown>} client */
  record(when, client) {
    const { rt, device, events, abandoned } = this.#notes;
    return { version: 1, rt, device, events, elapsed_ms: this.#at(when), abandoned, client };
  }

  /** @param {number} when */
  #at(when) {
    return tenths(Math.min(MOST_ELAPSED_MS, Math.max(0, when - this.#begunAt)));
  }
}

/** Notes from storage, whatever became of them there: what is not sound is left out, lest the attempt be refused for it. @param {Partial<Notes> | null} notes @returns {Notes} */
function soundNotes(notes) {
  const { rt, device, events, elapsed_ms, first_step_ms, abandoned } = notes ?? {};
  return {
    rt: soundList(rt, (one) => one === null || isMs(one)),
    device: soundList(device, (one) => DEVICES.includes(one)),
    events: soundList(events, isHappening),
    elapsed_ms: isMs(elapsed_ms) ? elapsed_ms : 0,
    first_step_ms: isMs(first_step_ms) ? first_step_ms : null,
    abandoned: soundList(abandoned, (one) => isCount(one?.n_steps) && isMs(one.elapsed_ms)),
  };
}

/** @template T @param {T[] | undefined} list @param {(one: any) => boolean} isSound @returns {T[]} */
function soundList(list, isSound) {
  return Array.isArray(list) ? list.filter(isSound) : [];
}

/** @param {any} event */
function isHappening(event) {
  const isTimed = isMs(event?.at_ms) && isCount(event.step);
  return isTimed && EVENTS.includes(event.type) && (event.value === null || Number.isFinite(event.value));
}

/** @param {unknown} ms @returns {ms is number} */
function isMs(ms) {
  return typeof ms === "number" && ms >= 0 && ms <= MOST_ELAPSED_MS;
}

/** @param {unknown} n */
function isCount(n) {
  return Number.isInteger(n) && Number(n) >= 0;
}

/** @param {number} ms */
function tenths(ms) {
  return Math.round(ms * 10) / 10;
}
