/**
 * The dot plot of a comparison as SVG: redrawn when its box changes width. The table beside it holds the same figures,
 * so to assistive technology it is one picture with a sentence.
 * @import {Entry} from "#js/comparisons/types.js"
 * @import {DotPlotLayout, DotRow} from "#js/charts/dot-plot-layout.js"
 */
import { markerPath, walker } from "#js/board/colours.js";
import { fitted, layOutDotPlot, NAME } from "#js/charts/dot-plot-layout.js";
import { figure, withError } from "#js/charts/figures.js";
import { svgElement } from "#js/charts/marker.js";

/**
 * @param {HTMLElement} box
 * @param {Entry[]} entries sorted by place
 * @param {AbortSignal} signal
 */
export function mountDotPlot(box, entries, signal) {
  const draw = () => box.replaceChildren(drawDotPlot(layOutDotPlot(entries, Math.max(260, box.clientWidth)), entries));
  let width = box.clientWidth;
  const resizes = new ResizeObserver(() => {
    if (box.clientWidth === width) return;
    width = box.clientWidth;
    draw();
  });
  draw();
  resizes.observe(box);
  signal.addEventListener("abort", () => resizes.disconnect());
}

/**
 * @param {DotPlotLayout} layout
 * @param {Entry[]} entries
 */
function drawDotPlot(layout, entries) {
  const svg = svgElement("svg", {
    class: "dot-plot",
    role: "img",
    width: layout.width,
    height: layout.height,
    viewBox: `0 0 ${layout.width} ${layout.height}`,
    "aria-label": describe(entries),
  });
  svg.append(...axis(layout), ...layout.rows.map((row) => rowGroup(row, layout)), ...optimumLine(layout));
  return svg;
}

/** @param {Entry[]} entries */
function describe(entries) {
  const parts = entries.map((entry) => `${entry.title} ${withError(entry.mean_return, entry.standard_error)}`);
  return `Average return by place, ± standard error: ${parts.join("; ")}. The table says the same in figures.`;
}

/** @param {DotPlotLayout} layout */
function axis(layout) {
  const { top, bottom, left, right, zero } = layout;
  const marks = layout.ticks.flatMap(({ x, value }) => [
    svgElement("line", { class: "dot-plot-grid", x1: x, x2: x, y1: top, y2: bottom }),
    svgElement("text", { class: "dot-plot-tick", x, y: bottom + 16, "text-anchor": "middle" }, tickText(value)),
  ]);
  const lines = [svgElement("line", { class: "dot-plot-axis", x1: left, x2: right, y1: bottom, y2: bottom })];
  if (zero !== null)
    lines.push(svgElement("line", { class: "dot-plot-zero", x1: zero, x2: zero, y1: top, y2: bottom }));
  return [...marks, ...lines];
}

/**
 * @param {DotRow} row
 * @param {DotPlotLayout} layout
 */
function rowGroup({ entry, y, mean, isOffScale, interval, expected, greedy }, layout) {
  const group = svgElement("g", { class: "dot-plot-row", "data-who": entry.who });
  group.append(
    svgElement("path", { class: "dot-plot-key", d: markerPath(walker(entry.who).shape, 8, y, 5.5) }),
    svgElement("text", { class: "dot-plot-name", x: NAME, y: y + 4.5 }, fitted(entry.title, layout.left)),
    svgElement("line", { class: "dot-plot-guide", x1: layout.left, x2: layout.right, y1: y, y2: y }),
  );
  if (greedy !== null) {
    group.append(
      svgElement("path", { class: "dot-plot-greedy", d: markerPath(walker(entry.who).shape, greedy, y, 5) }),
    );
  }
  if (isOffScale) {
    const text = `◂ ${figure(entry.mean_return)}`;
    group.append(svgElement("text", { class: "dot-plot-off", x: layout.left + 4, y: y + 4.5 }, text));
    return group;
  }
  if (interval) {
    const [from, to] = interval;
    const caps = `M${from},${y - 5}v10M${to},${y - 5}v10M${from},${y}H${to}`;
    group.append(svgElement("path", { class: "dot-plot-interval", d: caps }));
  }
  group.append(svgElement("path", { class: "dot-plot-mean", d: markerPath(walker(entry.who).shape, mean, y, 6.5) }));
  if (expected !== null) {
    group.append(svgElement("path", { class: "dot-plot-expected", d: `M${expected},${y - 11}v22` }));
  }
  return group;
}

/** @param {DotPlotLayout} layout */
function optimumLine({ optimum, top, bottom, width }) {
  if (optimum === null) return [];
  const anchor = optimum > width - 48 ? "end" : "middle";
  return [
    svgElement("line", { class: "dot-plot-optimum", x1: optimum, x2: optimum, y1: top - 4, y2: bottom }),
    svgElement(
      "text",
      { class: "dot-plot-tick", x: anchor === "end" ? width - 2 : optimum, y: top - 10, "text-anchor": anchor },
      "optimum",
    ),
  ];
}

/** @param {number} value */
function tickText(value) {
  return Number.isInteger(value) ? figure(value, 0) : figure(value, 1);
}
