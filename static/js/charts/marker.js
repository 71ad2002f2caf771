/** The marker of everybody who walks a board (hue and shape) as a small inline SVG. */

import { markerPath, walker } from "#js/board/colours.js";

const SVG = "http://www.w3.org/2000/svg";

/**
 * Decoration beside a name: the name speaks, the marker only repeats it.
 * @param {string} who
 */
export function marker(who) {
  const svg = svgElement("svg", { class: "marker", viewBox: "-1.3 -1.3 2.6 2.6", "aria-hidden": "true" });
  svg.setAttribute("data-who", who);
  svg.append(svgElement("path", { d: markerPath(walker(who).shape) }));
  return svg;
}

/**
 * @param {string} name
 * @param {Record<string, string | number>} [attributes]
 * @param {string} [text]
 */
export function svgElement(name, attributes = {}, text = "") {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  if (text) element.textContent = text;
  return element;
}
