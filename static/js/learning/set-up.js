/**
 * What shall learn, and how: presets in a row, and the settings behind them.
 * @import {LearnPageData, Preset} from "#js/learning/types.js"
 * @import {LineUp} from "#js/learning/line-up.js"
 */
import { missingWith } from "#js/learning/material.js";
import { changedSettings } from "#js/learning/run-words.js";
import { SettingsForm } from "#js/learning/settings-form.js";
import { announce } from "#js/lib/announce.js";
import { plural } from "#js/lib/format.js";

export class SetUp {
  #root;
  #data;
  #lineUp;
  #form;
  /** What each learner misses at the default settings. */
  #missing;

  /**
   * @param {HTMLElement} root
   * @param {LearnPageData} data
   * @param {LineUp} lineUp
   */
  constructor(root, data, lineUp) {
    this.#root = root;
    this.#data = data;
    this.#lineUp = lineUp;
    this.#form = new SettingsForm(this.#part("form"), data.settings, data.run?.settings ?? {});
    this.#missing = new Map(data.learners.map(({ name, missing }) => [name, missing]));
    this.#part("presets").replaceChildren(...this.#presets.map(presetButton));
    this.weigh();
  }

  /** @param {AbortSignal} signal @param {() => void} changed */
  start(signal, changed) {
    this.#part("form").addEventListener("submit", (/** @type {Event} */ event) => event.preventDefault(), { signal });
    this.#part("form").addEventListener(
      "change",
      () => {
        this.weigh();
        changed();
      },
      { signal },
    );
    this.#part("presets").addEventListener(
      "click",
      (/** @type {Event} */ { target }) => {
        const name = target instanceof Element ? target.closest("button")?.dataset.preset : undefined;
        const preset = this.#presets.find((one) => one.name === name);
        if (preset && !this.#isLocked) this.#take(preset);
        changed();
      },
      { signal },
    );
  }

  /** What was chosen; null where something typed is wrong, which is marked then. */
  read() {
    return this.#form.read();
  }

  /** Begin with what another run had. @param {Record<string, number | string>} settings @param {string[]} learners */
  fill(settings, learners) {
    this.#form.fill(settings);
    this.weigh();
    this.#lineUp.choose(learners);
  }

  /** Learn from failures that never reached the goal, too. */
  includeUnfinished() {
    this.#form.unfinishedFailures = "include";
    this.weigh();
  }

  /** Whether failures that never reached the goal are learned from: "leave_out" or "include". */
  get unfinished() {
    return this.#form.unfinishedFailures;
  }

  /** What a learner misses depends on whether unfinished failures count. */
  weigh() {
    const { learners, demonstrations, rankings } = this.#data;
    for (const learner of learners) {
      const before = learner.missing;
      const atDefault = { ...learner, missing: this.#missing.get(learner.name) ?? null };
      learner.missing = missingWith(atDefault, demonstrations, rankings, this.unfinished);
      if (learner.missing !== before) this.#lineUp.weigh(learner);
    }
  }

  /** @param {boolean} isLocked a run goes on: what is shown is what it was asked with */
  paint(isLocked) {
    this.#form.disabled = isLocked;
    this.#lineUp.isLocked = isLocked;
    const settings = this.#form.peek();
    for (const button of this.#part("presets").querySelectorAll("button")) {
      const preset = /** @type {Preset} */ (this.#presets.find(({ name }) => name === button.dataset.preset));
      button.setAttribute("aria-pressed", String(settings !== null && this.#isTaken(preset, settings)));
      button.setAttribute("aria-disabled", String(isLocked));
    }
    const taken = this.#presets.find((preset) => settings !== null && this.#isTaken(preset, settings));
    this.#say("preset-sentence", taken?.sentence ?? "");
    const count = settings === null ? 0 : Object.keys(settings).length;
    this.#say(
      "settings-count",
      count === 0 ? "all at their defaults" : `${plural(count, "differs", "differ")} from the defaults`,
    );
  }

  /** Show a sentence under the setting it speaks of. @param {string} name @param {string} sentence */
  complain(name, sentence) {
    return this.#form.complain(name, sentence);
  }

  open() {
    this.#part("settings").open = true;
    this.#form.focusFirstProblem();
  }

  /** @returns {Preset[]} */
  get #presets() {
    return this.#data.presets ?? [];
  }

  get #isLocked() {
    return this.#part("presets").querySelector('button[aria-disabled="true"]') !== null;
  }

  /** @param {Preset} preset */
  #take(preset) {
    this.fill(preset.settings, preset.learners);
    announce(`${preset.title}: ${preset.sentence}`);
  }

  /** Its settings stand in the form, and its learners are those that shall learn. @param {Preset} preset @param {Record<string, number | string>} settings */
  #isTaken(preset, settings) {
    const wanted = changedSettings(preset.settings, this.#data.settings);
    const names = Object.keys(wanted);
    const hasSettings =
      names.length === Object.keys(settings).length && names.every((name) => settings[name] === wanted[name]);
    const able = preset.learners.filter((name) => !this.#data.learners.find((one) => one.name === name)?.missing);
    const { chosen } = this.#lineUp;
    return hasSettings && able.length === chosen.length && able.every((name) => chosen.includes(name));
  }

  /** @param {string} name @param {string} text */
  #say(name, text) {
    const part = this.#part(name);
    if (part.textContent !== text) part.textContent = text;
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"]`);
  }
}

/** @param {Preset} preset */
function presetButton({ name, title, sentence }) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "button";
  button.dataset.preset = name;
  button.title = sentence;
  button.textContent = title;
  return button;
}
