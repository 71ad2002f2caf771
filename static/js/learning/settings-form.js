/**
 * The folded form of settings, by what they are for: one field a setting with its symbol, default, range and a sentence,
 * and the seed. Empty means default.
 * @import {SettingInfo} from "#js/learning/types.js"
 */
import { readSetting } from "#js/learning/settings.js";

export class SettingsForm {
  #form;
  #settings;

  /**
   * @param {HTMLFormElement} form
   * @param {SettingInfo[]} settings
   * @param {Record<string, number | string>} values those of the run on the page, if there is one
   */
  constructor(form, settings, values) {
    this.#form = form;
    this.#settings = settings;
    const groups = [...new Set(settings.map(({ group = "" }) => group))].map((name) => {
      const members = settings.filter(({ group = "" }) => group === name);
      return fieldset(
        titleOf(name),
        members.map((setting) => field(setting, values[setting.name])),
      );
    });
    form.replaceChildren(...groups, fieldset("Chance", [seedField()]));
  }

  /**
   * What differs from the defaults; marks what is wrong and says null then.
   * @returns {{ settings: Record<string, number | string>, seed: number | null } | null}
   */
  read() {
    /** @type {Record<string, number | string>} what differs from the defaults */
    const settings = {};
    let isSound = true;
    for (const setting of this.#settings) {
      const { value, problem } = readSetting(setting, this.#control(setting.name).value);
      this.complain(setting.name, problem);
      if (problem) isSound = false;
      else if (value !== setting.default) settings[setting.name] = value;
    }
    const seed = readSetting(SEED, this.#control("seed").value);
    this.complain("seed", seed.problem);
    if (seed.problem) isSound = false;
    return isSound ? { settings, seed: seed.value === "" ? null : Number(seed.value) } : null;
  }

  /** What differs from the defaults as it stands, without a word about what is wrong; null where something is. */
  peek() {
    const read = this.#settings.map((setting) => [setting, readSetting(setting, this.#control(setting.name).value)]);
    const differing = /** @type {[SettingInfo, ReturnType<typeof readSetting>][]} */ (read).filter(
      ([setting, { value }]) => value !== setting.default,
    );
    if (/** @type {any[]} */ (read).some(([, { problem }]) => problem)) return null;
    return Object.fromEntries(differing.map(([{ name }, { value }]) => [name, value]));
  }

  /**
   * Put these in; what is not among them gets its default. The seed stays.
   * @param {Record<string, number | string>} values
   */
  fill(values) {
    for (const setting of this.#settings) {
      this.#control(setting.name).value = String(values[setting.name] ?? setting.default);
      this.complain(setting.name, "");
    }
  }

  /**
   * Put a sentence under a field; an empty one takes it away.
   * @param {string} name
   * @param {string} sentence
   * @returns {boolean} whether there is such a field
   */
  complain(name, sentence) {
    const control = this.#form.elements.namedItem(name);
    const place = this.#form.querySelector(`#problem-${name}`);
    if (!(control instanceof HTMLElement) || !place) return false;
    control.setAttribute("aria-invalid", String(sentence !== ""));
    place.textContent = sentence;
    return true;
  }

  /** @returns {string} what the setting says now about failures that never reached the goal */
  get unfinishedFailures() {
    return this.#control("unfinished_failures").value;
  }

  set unfinishedFailures(value) {
    this.#control("unfinished_failures").value = value;
  }

  focusFirstProblem() {
    const wrong = this.#form.querySelector('[aria-invalid="true"]');
    if (wrong instanceof HTMLElement) wrong.focus();
  }

  /** @param {boolean} isDisabled */
  set disabled(isDisabled) {
    for (const control of this.#form.elements) /** @type {HTMLInputElement} */ (control).disabled = isDisabled;
  }

  /** @param {string} name */
  #control(name) {
    return /** @type {HTMLInputElement | HTMLSelectElement} */ (this.#form.elements.namedItem(name));
  }
}

/** What the groups of irl_core are called; one that is not here goes by its own name. @type {Record<string, string>} */
const GROUPS = {
  paper: "The paper’s descent",
  model: "The model underneath",
  birlfr: "Bayesian IRLFR",
  model_free: "Model-free IRLFR",
  baseline: "The baselines",
};

/** @param {string} group */
function titleOf(group) {
  const words = group.replaceAll("_", " ") || "More";
  return GROUPS[group] ?? words.charAt(0).toUpperCase() + words.slice(1);
}

/** @type {SettingInfo} */
const SEED = {
  name: "seed",
  symbol: "",
  default: "",
  minimum: 0,
  maximum: Number.MAX_SAFE_INTEGER,
  whole: true,
  help: "The same seed, play and order give the same run. Left empty, one is drawn and kept with the run.",
};

function seedField() {
  return field(SEED, undefined);
}

/**
 * @param {string} title
 * @param {HTMLElement[]} fields
 */
function fieldset(title, fields) {
  const set = element("fieldset", { class: "settings-group" });
  set.append(element("legend", {}, title), ...fields);
  return set;
}

/**
 * @param {SettingInfo} setting
 * @param {number | string | undefined} current
 */
function field(setting, current) {
  const id = `setting-${setting.name}`;
  const label = element("label", { for: id, class: "setting-label" }, setting.name.replaceAll("_", " "));
  if (setting.symbol) label.append(" ", element("i", { class: "setting-symbol" }, setting.symbol));
  const value = current ?? setting.default;
  const control = setting.choices?.length ? choice(setting, String(value)) : input(setting, String(value));
  control.setAttribute("id", id);
  control.setAttribute("aria-describedby", `help-${setting.name} problem-${setting.name}`);
  const row = element("div", { class: "setting" });
  row.append(
    label,
    control,
    element("p", { id: `help-${setting.name}`, class: "setting-help" }, helpOf(setting)),
    element("p", { id: `problem-${setting.name}`, class: "setting-problem" }),
  );
  return row;
}

/**
 * @param {SettingInfo} setting
 * @param {string} value
 */
function input(setting, value) {
  const control = element("input", {
    name: setting.name,
    type: "text",
    inputmode: "decimal",
    autocomplete: "off",
    class: "input",
  });
  control.setAttribute("value", value);
  return control;
}

/**
 * @param {SettingInfo} setting
 * @param {string} value
 */
function choice(setting, value) {
  const control = element("select", { name: setting.name, class: "input" });
  for (const name of setting.choices ?? []) {
    const option = element("option", { value: name }, name.replaceAll("_", " "));
    if (name === value) option.setAttribute("selected", "");
    control.append(option);
  }
  return control;
}

/** @param {SettingInfo} setting */
function helpOf(setting) {
  const standard = setting.default === "" ? "" : ` Default ${String(setting.default).replaceAll("_", " ")}.`;
  return setting.help + standard;
}

/**
 * @param {string} tag
 * @param {Record<string, string>} attributes
 * @param {string} [text]
 */
function element(tag, attributes, text = "") {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = text;
  return made;
}
