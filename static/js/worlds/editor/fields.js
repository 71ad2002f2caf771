/** The fields of the panel: numbers go from them into the plan and back, and a problem stands beside its field. */

import { byId } from "#js/lib/dom.js";
import { RULES, readNumber, writeNumber } from "#js/worlds/editor/rules.js";

/** @typedef {import("#js/worlds/editor/rules.js").RuleName} Name */
/** @typedef {{input: HTMLInputElement, slider: HTMLInputElement | null, words: HTMLElement, shown: number | null, own: string, told: string}} Field */

export class Fields {
  /** @type {Map<Name, Field>} */
  #fields = new Map();
  #listener;

  /**
   * @param {readonly Name[]} names
   * @param {{set: (name: Name, value: number | null) => void, end: () => void, refuse: (sentence: string) => void}} listener
   */
  constructor(names, listener) {
    this.#listener = listener;
    for (const name of names) this.#fields.set(name, fieldOf(name));
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    for (const [name, { input, slider }] of this.#fields) {
      input.addEventListener("input", () => this.#read(name, false), { signal });
      input.addEventListener("change", () => this.#read(name, true), { signal });
      input.addEventListener("wheel", () => input.blur(), { signal, passive: true });
      slider?.addEventListener("input", () => this.#slide(name), { signal });
      slider?.addEventListener("change", () => this.#listener.end(), { signal });
    }
  }

  /** A text that is wrong stays until its number changes. @param {Partial<Record<Name, number | null>>} values */
  show(values) {
    for (const [name, field] of this.#fields) {
      const value = values[name] ?? null;
      if (value === field.shown && field.own !== "") continue;
      const read = readNumber(RULES[name], field.input.value, field.input.validity.badInput);
      const isThere = "value" in read && read.value === value;
      if (!isThere) field.input.value = writeNumber(RULES[name], value);
      if (field.slider) field.slider.value = writeNumber(RULES[name], value);
      field.shown = value;
      field.own = "";
      showProblem(field);
    }
  }

  /** What the server says of fields; an empty record takes it all back. @param {Record<string, string>} problems */
  tell(problems) {
    for (const [name, field] of this.#fields) {
      const told = problems[name] ?? "";
      // "rows must be …" speaks of the address; here the field's own words (and percent) are the clearer ones.
      field.told = told.startsWith(`${name} `) ? RULES[name].sentence : told;
      showProblem(field);
    }
  }

  /** While somebody types, half a number is no mistake yet. @param {Name} name @param {boolean} isFinal */
  #read(name, isFinal) {
    const field = /** @type {Field} */ (this.#fields.get(name));
    const read = readNumber(RULES[name], field.input.value, field.input.validity.badInput);
    if ("value" in read) {
      field.own = "";
      field.shown = read.value;
      this.#listener.set(name, read.value);
      if (field.slider) field.slider.value = field.input.value;
    } else if (isFinal) {
      field.own = read.problem;
      this.#listener.refuse(read.problem);
    }
    showProblem(field);
    if (isFinal) this.#listener.end();
  }

  /** @param {Name} name */
  #slide(name) {
    const { input, slider } = /** @type {Field} */ (this.#fields.get(name));
    input.value = slider?.value ?? "";
    this.#read(name, false);
  }
}

/** @param {Name} name @returns {Field} */
function fieldOf(name) {
  return {
    input: /** @type {HTMLInputElement} */ (byId(name)),
    slider: document.querySelector(`[data-twin="${name}"]`),
    words: byId(`${name}-problem`),
    shown: null,
    own: "",
    told: "",
  };
}

/** @param {Field} field */
function showProblem({ input, words, own, told }) {
  const sentence = own || told;
  words.textContent = sentence;
  words.hidden = sentence === "";
  if (sentence) input.setAttribute("aria-invalid", "true");
  else input.removeAttribute("aria-invalid");
}
