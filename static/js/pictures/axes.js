/** Axes of charts on paper: a few lines and round figures, nothing else. */

import { tag, text } from "#js/pictures/svg.js";

/** @typedef {{ink: string, soft: string, line: string, size: number}} Look   colours of words, figures, lines; the type's size */
/** @typedef {{left: number, right: number, top: number, bottom: number}} Box */
/** @typedef {{at: number, words: string}} Tick   where on the axis, what it says */

/** The axis below a chart, with a thin line through it at each figure. @param {Box} box @param {Tick[]} ticks @param {Look} look */
export function axisBelow({ left, right, top, bottom }, ticks, { ink, soft, line, size }) {
  const marks = ticks.map(
    ({ at, words }) =>
      tag("path", { d: `M${at} ${top}V${bottom}`, stroke: line, "stroke-width": 0.6 }) +
      text(words, at, bottom + size * 1.35, { size, fill: soft, anchor: "middle" }),
  );
  return marks.join("") + tag("path", { d: `M${left} ${bottom}H${right}`, stroke: ink, "stroke-width": 0.8 });
}

/** The axis at the left of a chart. @param {Box} box @param {Tick[]} ticks @param {Look} look */
export function axisLeft({ left, right, top, bottom }, ticks, { ink, soft, line, size }) {
  const marks = ticks.map(
    ({ at, words }) =>
      tag("path", { d: `M${left} ${at}H${right}`, stroke: line, "stroke-width": 0.6 }) +
      text(words, left - size * 0.5, at + size * 0.36, { size, fill: soft, anchor: "end" }),
  );
  return marks.join("") + tag("path", { d: `M${left} ${top}V${bottom}`, stroke: ink, "stroke-width": 0.8 });
}
