/** A chart of the page (an <svg> styled by the stylesheet) as a picture that stands alone: what it inherits is written into it. */

import { themeIn } from "#js/board/theme.js";
import { framed } from "#js/pictures/picture.js";
import { escaped } from "#js/pictures/svg.js";

/** What decides how a line, a shape and a word look. */
const LOOK = [
  "fill",
  "fill-opacity",
  "stroke",
  "stroke-width",
  "stroke-opacity",
  "stroke-dasharray",
  "stroke-linecap",
  "stroke-linejoin",
  "opacity",
  "font-size",
  "font-weight",
  "text-anchor",
  "dominant-baseline",
];

/** @param {Element | null} chart @param {{title: string, note: string}} about */
export function chartPicture(chart, { title, note }) {
  if (!(chart instanceof SVGSVGElement)) throw new Error("There is no chart here yet.");
  const theme = themeIn("light");
  const box = chart.getBoundingClientRect();
  const part = { markup: inLight(chart, () => markupOf(chart)), width: box.width, height: box.height };
  return framed([part], { title, note, theme, width: Math.max(320, box.width) });
}

/** Read something while an element has the light theme's colours; nothing is painted meanwhile. @template T @param {SVGElement} element @param {() => T} read */
function inLight(element, read) {
  const before = element.style.colorScheme;
  element.style.colorScheme = "light";
  try {
    return read();
  } finally {
    element.style.colorScheme = before;
  }
}

/** @param {Element} element @returns {string} */
function markupOf(element) {
  const style = getComputedStyle(element);
  if (style.display === "none" || style.visibility === "hidden") return "";
  const look = LOOK.map((name) => [name, style.getPropertyValue(name)]);
  const own = [...element.attributes]
    .filter(({ name }) => !["class", "style", "role", "id", ...LOOK].includes(name) && !/^(data|aria)-/.test(name))
    .map(({ name, value }) => [name, value]);
  const written = [...own, ...look]
    .filter(([, value]) => value !== "")
    .map(([name, value]) => ` ${name}="${escaped(value ?? "")}"`);
  const content = [...element.childNodes].map((child) =>
    child instanceof Element
      ? markupOf(child)
      : escaped(child.nodeType === Node.TEXT_NODE ? (child.textContent ?? "") : ""),
  );
  return `<${element.localName}${written.join("")}>${content.join("")}</${element.localName}>`;
}
