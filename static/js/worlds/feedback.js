/**
 * What playing sounds and feels like. Sounds are soft, shorter than an eighth of a second a note, and off until somebody
 * turns them on; there is no sad one. Phones vibrate lightly. Both choices are kept in this browser.
 */

import { announce } from "#js/lib/announce.js";

/**
 * @typedef {object} Note
 * @property {OscillatorType} wave
 * @property {number} hz        at its beginning
 * @property {number} [toHz]    at its end
 * @property {number} at        s after the event
 * @property {number} length    s
 * @property {number} gain      0…1
 */

const SOUND_KEY = "irlfr:sound";
const VIBRATION_KEY = "irlfr:vibration";
const DEAREST = 7;
const ATTACK_S = 0.004;
const SILENCE = 0.0001;
/** A sound that comes later than this belongs to nothing one sees. */
const LATEST_MS = 100;

export class Feedback extends EventTarget {
  #sound = recall(SOUND_KEY) === "on";
  #vibration = canVibrate() && (recall(VIBRATION_KEY) ?? (prefersStill() ? "off" : "on")) === "on";
  /** @type {AudioContext | null} */
  #audio = null;

  get sound() {
    return this.#sound;
  }

  set sound(isOn) {
    this.#sound = isOn;
    keep(SOUND_KEY, isOn);
    if (isOn) this.#play(notesOfFinish("success"), Number.POSITIVE_INFINITY);
    else void this.#audio?.suspend();
    this.dispatchEvent(new Event("change"));
  }

  get vibration() {
    return this.#vibration;
  }

  set vibration(isOn) {
    this.#vibration = isOn && canVibrate();
    keep(VIBRATION_KEY, isOn);
    this.#vibrate([30]);
    this.dispatchEvent(new Event("change"));
  }

  toggleSound() {
    this.sound = !this.#sound;
    announce(this.#sound ? "Sound on." : "Sound off.");
  }

  /** A tick, the lower the more the square cost. @param {{reward: number, isSlip: boolean}} step */
  step({ reward, isSlip }) {
    this.#play(notesOfStep(reward, isSlip));
    this.#vibrate(pulsesOfStep(reward, isSlip));
  }

  bump() {
    this.#play(NOTES_OF_BUMP);
    this.#vibrate([14]);
  }

  /** @param {"success" | "failure"} outcome */
  finish(outcome) {
    this.#play(notesOfFinish(outcome));
    this.#vibrate(outcome === "success" ? [20, 50, 30] : [30]);
  }

  /** @param {Note[]} notes @param {number} [patience] ms */
  async #play(notes, patience = LATEST_MS) {
    if (!this.#sound || notes.length === 0) return;
    const asked = performance.now();
    const audio = await this.#running();
    if (!audio || performance.now() - asked > patience) return;
    for (const note of notes) sing(audio, note);
  }

  /** @returns {Promise<AudioContext | null>} */
  async #running() {
    if (!hasTouchedThePage()) return null;
    this.#audio ??= new AudioContext({ latencyHint: "interactive" });
    if (this.#audio.state === "running") return this.#audio;
    return this.#audio.resume().then(
      () => this.#audio,
      () => null,
    );
  }

  /** @param {number[]} pulses ms */
  #vibrate(pulses) {
    if (this.#vibration && hasTouchedThePage() && pulses.length > 0) navigator.vibrate(pulses);
  }
}

/** Can this device vibrate, as far as a page can know? Computers with a mouse have the function and no motor. */
export function canVibrate() {
  return typeof navigator.vibrate === "function" && matchMedia("(pointer: coarse)").matches;
}

/** The goal speaks for itself (`finish`); every other square ticks. @param {number} reward @param {boolean} isSlip @returns {Note[]} */
export function notesOfStep(reward, isSlip) {
  if (reward > 0) return [];
  const hz = 620 * 2 ** (-1.5 * depthOf(reward));
  return [{ wave: "triangle", hz, toHz: isSlip ? hz * 0.6 : hz, at: 0, length: isSlip ? 0.11 : 0.06, gain: 0.05 }];
}

/** Two notes up for a success; one warm note for a failure, which is as welcome. @param {"success" | "failure"} outcome @returns {Note[]} */
export function notesOfFinish(outcome) {
  if (outcome === "failure") return [{ wave: "sine", hz: 262, at: 0, length: 0.12, gain: 0.09 }];
  return [
    { wave: "triangle", hz: 523, at: 0, length: 0.11, gain: 0.06 },
    { wave: "triangle", hz: 784, at: 0.09, length: 0.12, gain: 0.06 },
  ];
}

/** Blue squares stay below what a hand feels; the dearest red one is a short knock. @param {number} reward @param {boolean} isSlip */
export function pulsesOfStep(reward, isSlip) {
  if (reward > 0) return [];
  const knock = Math.round(4 + 16 * depthOf(reward));
  return isSlip ? [8, 30, knock] : [knock];
}

/** @type {Note[]} */
const NOTES_OF_BUMP = [{ wave: "sine", hz: 110, toHz: 70, at: 0, length: 0.08, gain: 0.12 }];

/** 0 for a square that costs nothing, 1 for the dearest. @param {number} reward */
function depthOf(reward) {
  return Math.min(1, Math.max(0, -reward / DEAREST));
}

/** @param {AudioContext} audio @param {Note} note */
function sing(audio, { wave, hz, toHz = hz, at, length, gain }) {
  const [start, end] = [audio.currentTime + at, audio.currentTime + at + length];
  const tone = new OscillatorNode(audio, { type: wave, frequency: hz });
  tone.frequency.setValueAtTime(hz, start);
  tone.frequency.exponentialRampToValueAtTime(toHz, end);
  const volume = new GainNode(audio, { gain: 0 });
  volume.gain.setValueAtTime(SILENCE, start);
  volume.gain.linearRampToValueAtTime(gain, start + ATTACK_S);
  volume.gain.exponentialRampToValueAtTime(SILENCE, end);
  tone.connect(volume).connect(audio.destination);
  tone.start(start);
  tone.stop(end);
}

/** Before that, browsers refuse sound and vibration, and complain on the console. */
function hasTouchedThePage() {
  return navigator.userActivation?.hasBeenActive ?? true;
}

function prefersStill() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** @param {string} key */
function recall(key) {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

/** @param {string} key @param {boolean} isOn */
function keep(key, isOn) {
  try {
    localStorage.setItem(key, isOn ? "on" : "off");
  } catch {
    // A browser that keeps nothing still does as it is told until the page is left.
  }
}
