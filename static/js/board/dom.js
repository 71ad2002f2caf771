/** Small helpers for what the board builds of elements. */

const SVG = "http://www.w3.org/2000/svg";

const stillness = matchMedia("(prefers-reduced-motion: reduce)");

/** Whether the person asked for less motion. */
export function prefersStill() {
  return stillness.matches;
}

/** @param {string} tag @param {string} className @returns {HTMLElement} */
export function make(tag, className) {
  const element = document.createElement(tag);
  element.className = className;
  return element;
}

/** @param {string} tag @param {Record<string, string | number>} attributes @param {SVGElement[]} children */
export function makeSvg(tag, attributes, ...children) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}
