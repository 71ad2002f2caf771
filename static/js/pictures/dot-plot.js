/** The dot plot of a comparison as a vector picture, laid out as on the page (`charts/dot-plot-layout.js`). */

import { markerPath, walker } from "#js/board/colours.js";
import { layOutDotPlot, NAME } from "#js/charts/dot-plot-layout.js";
import { figure } from "#js/charts/figures.js";
import { axisBelow } from "#js/pictures/axes.js";
import { paletteOf } from "#js/pictures/board.js";
import { ink } from "#js/pictures/pen.js";
import { framed } from "#js/pictures/picture.js";
import { tag, text } from "#js/pictures/svg.js";
import { fittedInto } from "#js/pictures/text-width.js";

/** @typedef {import("#js/comparisons/types.js").Entry} Entry */
/** @typedef {import("#js/charts/dot-plot-layout.js").DotRow} DotRow */
/** @typedef {import("#js/charts/dot-plot-layout.js").DotPlotLayout} Layout */
/** @typedef {import("#js/board/theme.js").Theme} Theme */
/** @typedef {import("#js/pictures/svg.js").Figure} Figure */

const SIZE = 12;

/** @param {Entry[]} entries @param {{title: string, note?: string, width?: number, theme?: "light" | "dark" | Theme}} about */
export function dotPlotSvg(entries, { title, note = "", width = 560, theme = "light" }) {
  const palette = paletteOf(theme);
  return framed([dotPlot(entries, width, palette)], { title, note, theme: palette, width });
}

/** @param {Entry[]} entries by place @param {number} width @param {Theme} theme @returns {Figure} */
export function dotPlot(entries, width, theme) {
  const layout = layOutDotPlot(entries, width);
  const look = { ink: ink(theme.ink)[0], soft: ink(theme.inkSoft)[0], line: ink(theme.line)[0], size: SIZE - 1 };
  const ticks = layout.ticks.map(({ x, value }) => ({ at: x, words: figure(value, Number.isInteger(value) ? 0 : 1) }));
  const markup = [
    axisBelow(layout, ticks, look),
    upright(layout.zero, layout, look.soft),
    optimum(layout, look.ink),
    ...layout.rows.map((row) => rowMarkup(row, layout, theme)),
  ];
  return { markup: markup.join(""), width: layout.width, height: layout.height };
}

/** @param {DotRow} row @param {Layout} layout @param {Theme} theme */
function rowMarkup({ entry, y, mean, isOffScale, interval, expected, greedy }, layout, theme) {
  const [hue] = ink(theme.who[entry.who] ?? theme.who.random ?? theme.ink);
  const [words] = ink(theme.ink);
  const [ground] = ink(theme.canvas);
  const { shape } = walker(entry.who);
  const title = entry.who === "human" ? "Player" : entry.title;
  const parts = [
    tag("path", { d: markerPath(shape, 8, y, 5.5), fill: hue }),
    text(fittedInto(title, layout.left - NAME - 6, SIZE), NAME, y + SIZE * 0.36, { size: SIZE, fill: words }),
  ];
  if (greedy !== null)
    parts.push(tag("path", { d: markerPath(shape, greedy, y, 4.6), fill: ground, stroke: hue, "stroke-width": 1.3 }));
  if (isOffScale) {
    const off = text(`◂ ${figure(entry.mean_return)}`, layout.left + 4, y + SIZE * 0.36, { size: SIZE, fill: words });
    return [...parts, off].join("");
  }
  if (interval) {
    const way = `M${interval[0]} ${y - 4.5}v9M${interval[1]} ${y - 4.5}v9M${interval[0]} ${y}H${interval[1]}`;
    parts.push(tag("path", { d: way, stroke: hue, "stroke-width": 1.7, fill: "none" }));
  }
  parts.push(tag("path", { d: markerPath(shape, mean, y, 5.8), fill: hue, stroke: ground, "stroke-width": 0.8 }));
  if (expected !== null)
    parts.push(tag("path", { d: `M${expected} ${y - 10}v20`, stroke: words, "stroke-width": 1.4 }));
  return parts.join("");
}

/** @param {Layout} layout @param {string} colour */
function optimum({ optimum: x, top, bottom, right }, colour) {
  if (x === null) return "";
  const line = { d: `M${x} ${top - 4}V${bottom}`, stroke: colour, "stroke-width": 0.9, "stroke-dasharray": "4 3" };
  const anchor = x > right - 30 ? "end" : "middle";
  return tag("path", line) + text("optimum", x, top - 9, { size: SIZE - 1, fill: colour, anchor });
}

/** @param {number | null} x @param {Layout} layout @param {string} colour */
function upright(x, { top, bottom }, colour) {
  return x === null ? "" : tag("path", { d: `M${x} ${top}V${bottom}`, stroke: colour, "stroke-width": 0.9 });
}
