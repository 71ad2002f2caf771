/**
 * The convergence chart as a vector picture: the gap (logarithmic) or the log-likelihood of each learner by iteration, in its
 * hue, with its marker. `columns` is what `FrameStore.columns(learners, measure)` gives.
 *
 *   lineChartSvg(store.columns(learners, "gap"), { learners, measure: "gap", last: 500, title: "Convergence", note: "Run …" })
 */

import { markerPath, walker } from "#js/board/colours.js";
import { significant } from "#js/charts/figures.js";
import { decades, linearScale, roundDomain, ticks } from "#js/charts/scales.js";
import { axisBelow, axisLeft } from "#js/pictures/axes.js";
import { paletteOf } from "#js/pictures/board.js";
import { flow, markerSign } from "#js/pictures/legend.js";
import { ink } from "#js/pictures/pen.js";
import { framed } from "#js/pictures/picture.js";
import { tag, text } from "#js/pictures/svg.js";

/** @typedef {import("#js/board/theme.js").Theme} Theme */
/** @typedef {import("#js/pictures/svg.js").Figure} Figure */
/** @typedef {{iterations: number[], columns: (number | null)[][]}} Columns */
/** @typedef {"gap" | "log_likelihood"} Measure */
/** @typedef {{learners: string[], measure: Measure, last?: number, width?: number, height?: number}} What */

const WORDS = {
  gap: "gap to the play, in visits (logarithmic)",
  log_likelihood: "log-likelihood of the play",
};
const MARKERS_PER_LINE = 7;
const SIZE = 11;

/** @param {Columns} data @param {What & {title: string, note?: string, theme?: "light" | "dark" | Theme}} what */
export function lineChartSvg(data, { title, note = "", theme = "light", ...what }) {
  const palette = paletteOf(theme);
  const chart = lineChart(data, what, palette);
  const names = what.learners.map((who) => ({ sign: markerSign(who, palette, 12), words: walker(who).title || who }));
  const legend = flow(names, { width: chart.width, theme: palette, size: 12 });
  return framed([chart, legend], { title, note, theme: palette, width: chart.width });
}

/** @param {Columns} data @param {What} what @param {Theme} theme @returns {Figure} */
function lineChart({ iterations, columns }, { learners, measure, last, width = 640, height = 340 }, theme) {
  const isLog = measure === "gap";
  const box = { left: 56, right: width - 10, top: 24, bottom: height - 34 };
  const values = columns.flat().filter((value) => value !== null);
  const domain = isLog ? decades(values) : roundDomain(values);
  const level = isLog ? Math.log10 : (/** @type {number} */ value) => value;
  const x = linearScale([0, Math.max(1, last ?? iterations.at(-1) ?? 1)], [box.left, box.right]);
  const y = linearScale([level(domain[0]), level(domain[1])], [box.bottom, box.top]);
  const look = { ink: ink(theme.ink)[0], soft: ink(theme.inkSoft)[0], line: ink(theme.line)[0], size: SIZE };
  const upright = isLog ? powers(domain) : ticks(domain[0], domain[1]);
  const along = ticks(0, Math.max(1, last ?? iterations.at(-1) ?? 1), 6);
  const lines = learners.map((who, i) => {
    const points = iterations.flatMap((iteration, row) => {
      const value = columns[i]?.[row] ?? null;
      return value === null || (isLog && value <= 0) ? [] : [{ x: x(iteration), y: y(level(value)) }];
    });
    return curve(points, { who, theme, offset: i / learners.length, box });
  });
  const markup = [
    axisBelow(
      box,
      along.map((value) => ({ at: x(value), words: String(value) })),
      look,
    ),
    axisLeft(
      box,
      upright.map((value) => ({ at: y(level(value)), words: significant(value) })),
      look,
    ),
    ...lines,
    text("iteration", box.right, height - 4, { size: SIZE, fill: look.soft, anchor: "end" }),
    text(WORDS[measure], 0, 11, { size: SIZE, fill: look.soft }),
  ];
  return { markup: markup.join(""), width, height };
}

/** @param {{x: number, y: number}[]} points @param {{who: string, theme: Theme, offset: number, box: {left: number, right: number}}} look */
function curve(points, { who, theme, offset, box }) {
  if (points.length === 0) return "";
  const [stroke] = ink(theme.who[who] ?? theme.who.random ?? theme.ink);
  const [ground] = ink(theme.canvas);
  const way = points.map((point, i) => `${i === 0 ? "M" : "L"}${point.x.toFixed(1)} ${point.y.toFixed(1)}`).join("");
  const stride = (box.right - box.left) / MARKERS_PER_LINE;
  let due = box.left + stride * offset;
  const marked = points.filter((point, i) => {
    const isDue = point.x >= due || i === points.length - 1;
    if (isDue) due = point.x + stride;
    return isDue;
  });
  const line = tag("path", { d: way, fill: "none", stroke, "stroke-width": 1.6, "stroke-linejoin": "round" });
  const { shape } = walker(who);
  const markers = marked.map((point) =>
    tag("path", { d: markerPath(shape, point.x, point.y, 4.2), fill: stroke, stroke: ground, "stroke-width": 1 }),
  );
  return line + markers.join("");
}

/** @param {[number, number]} domain whole powers of ten */
function powers([low, high]) {
  const first = Math.round(Math.log10(low));
  return Array.from({ length: Math.round(Math.log10(high)) - first + 1 }, (_, i) => 10 ** (first + i));
}
