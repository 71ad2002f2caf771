/**
 * Returns on a line, for the eye: who earns what, from where to where it moved, how sure one is. The key below has the
 * figures, so to assistive technology the line itself is nothing.
 */

import { make } from "#js/board/dom.js";
import { figure } from "#js/charts/figures.js";
import { marker } from "#js/charts/marker.js";
import { linearScale, roundDomain, ticks } from "#js/charts/scales.js";

/** @typedef {{ who: string, at: number, words: string, isGhost?: boolean }} Mark   a ghost: as it was */
/** @typedef {{ marks: Mark[], interval?: [number, number], moves?: [number, number] }} Returns */

/** @param {HTMLElement} box @param {Returns} returns */
export function showReturns(box, { marks, interval, moves }) {
  const ends = roundDomain([...marks.map(({ at }) => at), ...(interval ?? [])]);
  const place = linearScale(ends, [0, 100]);
  const line = make("div", "why-scale");
  line.setAttribute("aria-hidden", "true");
  line.append(
    ...ticks(...ends, 5).map((value) => tick(value, place(value))),
    ...(interval ? [stretch("why-scale-interval", interval.map(place))] : []),
    ...(moves ? [stretch("why-scale-move", moves.map(place))] : []),
    ...marks.map((mark) => markAt(mark, place(mark.at))),
  );
  const key = make("ul", "why-scale-key");
  key.append(...marks.map(keyItem));
  box.replaceChildren(line, key);
}

/** Where the person and the optimum stand on the scale of returns. @param {import("#js/comparisons/why/about.js").About["others"]} others @param {string} your */
export function othersMarks({ human, optimal }, your) {
  return [
    ...(human ? [{ who: "human", at: human.mean_return, words: `${your} mean` }] : []),
    ...(optimal ? [{ who: "optimal", at: optimal.expected_return ?? optimal.mean_return, words: "optimum" }] : []),
  ];
}

/** @param {number} value @param {number} at percent */
function tick(value, at) {
  const made = make("span", "why-scale-tick");
  made.textContent = figure(value, Number.isInteger(value) ? 0 : 1);
  made.style.insetInlineStart = `${at}%`;
  return made;
}

/** @param {string} className @param {number[]} ends percent */
function stretch(className, [from = 0, to = 0]) {
  const made = make("span", className);
  made.style.insetInlineStart = `${Math.min(from, to)}%`;
  made.style.inlineSize = `${Math.abs(to - from)}%`;
  made.dataset.way = from <= to ? "up" : "down";
  return made;
}

/** @param {Mark} mark @param {number} at percent */
function markAt({ who, isGhost = false }, at) {
  const made = make("span", "why-scale-mark");
  made.append(marker(who));
  made.style.insetInlineStart = `${at}%`;
  made.dataset.ghost = String(isGhost);
  return made;
}

/** @param {Mark} mark */
function keyItem({ who, at, words, isGhost = false }) {
  const item = make("li", "why-scale-mark");
  item.dataset.ghost = String(isGhost);
  item.append(marker(who), `${words} ${figure(at)}`);
  return item;
}
