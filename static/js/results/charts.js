/**
 * The two charts of the page of results as SVG. The tables beside them hold the same figures, so that to assistive technology
 * each is one picture with a sentence.
 * @import {Standing} from "#js/results/types.js"
 */
import { markerPath, walker } from "#js/board/colours.js";
import { figure, percent } from "#js/charts/figures.js";
import { svgElement } from "#js/charts/marker.js";
import { BAR, layOutPlaces, layOutShares, lines, ROW, TOP } from "#js/results/layout.js";

/** Places beyond have the last one's colour; their figures and their order tell them apart. */
const DEEPEST = 6;
/** The width of a key of the legend. */
const KEY = 50;

/** @param {Standing[]} standings @param {number} width */
export function drawPlaces(standings, width) {
  const layout = layOutPlaces(standings, width);
  const svg = picture(layout, placesInWords(standings));
  svg.append(...legend(layout));
  for (const { standing, y, segments } of layout.rows) {
    const row = rowGroup(standing, y + ROW / 2, layout.left);
    for (const { place, count, x, width: wide, hasRoom } of segments) {
      const shown = Math.min(place, DEEPEST);
      const bar = svgElement("g", { class: "place", "data-place": shown });
      bar.append(
        svgElement("title", {}, `${standing.title}: ${nth(place)} in ${count} of ${standing.n_comparisons}`),
        svgElement("rect", { x, y: y + (ROW - BAR) / 2, width: wide, height: BAR }),
      );
      if (hasRoom) bar.append(text("place-count", x + wide / 2, y + ROW / 2 + 5, String(count), "middle"));
      row.append(bar);
    }
    svg.append(row);
  }
  return svg;
}

/** @param {Standing[]} standings @param {number} width */
export function drawShares(standings, width) {
  const layout = layOutShares(standings, width);
  const { bottom, zero, optimum } = layout;
  const svg = picture(layout, sharesInWords(standings));
  for (const { x, value } of layout.ticks) {
    svg.append(
      line("dot-plot-grid", x, x, TOP, bottom),
      text("dot-plot-tick", x, bottom + 18, percentTick(value), "middle"),
    );
  }
  svg.append(
    line("dot-plot-zero", zero, zero, TOP, bottom),
    line("dot-plot-optimum", optimum, optimum, TOP - 6, bottom),
  );
  svg.append(text("dot-plot-tick", optimum, TOP - 12, "optimum", "middle"));
  for (const { standing, y, x, isOffScale, interval } of layout.rows) {
    const row = rowGroup(standing, y, layout.left);
    const { value } = standing.share_of_optimum;
    if (interval) {
      const [from = 0, to = 0] = interval;
      row.append(
        svgElement("path", {
          class: "dot-plot-interval",
          d: `M${from},${y - 6}v12M${to},${y - 6}v12M${from},${y}H${to}`,
        }),
      );
    }
    if (x !== null && !isOffScale) {
      row.append(svgElement("path", { class: "dot-plot-mean", d: markerPath(walker(standing.who).shape, x, y, 8) }));
    }
    if (isOffScale) row.append(text("dot-plot-name", layout.left, y + 5, "◂"));
    row.append(text("dot-plot-name share-figure", layout.width - 2, y + 5, percentTick(value), "end"));
    svg.append(row);
  }
  return svg;
}

/** @param {Standing[]} standings */
export function placesInWords(standings) {
  const each = standings.map(({ title, places, n_comparisons }) => {
    const came = places.flatMap(({ count }, i) => (count ? [`${nth(i + 1)} ${count}`] : []));
    return `${title}, ${n_comparisons} times: ${came.join(", ")}`;
  });
  return `How often who came at which place. ${each.join("; ")}. The table says the same in figures.`;
}

/** @param {Standing[]} standings */
export function sharesInWords(standings) {
  const each = standings.map(({ title, share_of_optimum: { value, low, high } }) => {
    const interval = low === null || high === null ? "" : `, interval ${percentTick(low)} to ${percentTick(high)}`;
    return `${title} ${percentTick(value)}${interval}`;
  });
  return `Share of the optimum. ${each.join("; ")}. The table says the same in figures.`;
}

/** @param {number} place */
export function nth(place) {
  return `${place}${{ 1: "st", 2: "nd", 3: "rd" }[place] ?? "th"}`;
}

/** @param {{width: number, height: number}} layout @param {string} label */
function picture({ width, height }, label) {
  const size = { width, height, viewBox: `0 0 ${width} ${height}` };
  return svgElement("svg", { class: "dot-plot results-plot", role: "img", "aria-label": label, ...size });
}

/** Above the bars; on a phone it may begin above the names. @param {{width: number, left: number, n_places: number}} layout */
function legend({ width, left, n_places }) {
  const length = Math.min(n_places, DEEPEST);
  const from = Math.max(0, Math.min(left, width - length * KEY));
  return Array.from({ length }, (_, i) => {
    const isRest = i + 1 === DEEPEST && n_places > DEEPEST;
    const group = svgElement("g", { class: "place", "data-place": i + 1 });
    group.append(
      svgElement("rect", { x: from + i * KEY, y: 6, width: 12, height: 12 }),
      text("dot-plot-tick", from + i * KEY + 17, 16.5, `${nth(i + 1)}${isRest ? " …" : ""}`),
    );
    return group;
  });
}

/** @param {Standing} standing @param {number} y the middle @param {number} left where the plotting area begins */
function rowGroup({ who, title }, y, left) {
  const group = svgElement("g", { class: "dot-plot-row", "data-who": who });
  group.append(svgElement("path", { class: "dot-plot-key", d: markerPath(walker(who).shape, 9, y, 6.5) }));
  const words = lines(title, left);
  words.forEach((word, i) => {
    group.append(text("dot-plot-name", 24, y + 5 + 16 * (i - (words.length - 1) / 2), word));
  });
  return group;
}

/** @param {string} name @param {number} x @param {number} y @param {string} words @param {"start" | "middle" | "end"} [anchor] */
function text(name, x, y, words, anchor = "start") {
  return svgElement("text", { class: name, x, y, "text-anchor": anchor }, words);
}

/** @param {string} name @param {number} x1 @param {number} x2 @param {number} y1 @param {number} y2 */
function line(name, x1, x2, y1, y2) {
  return svgElement("line", { class: name, x1, x2, y1, y2 });
}

/** On an axis a share below nothing is a figure like any other. @param {number | null} share */
function percentTick(share) {
  return share !== null && share < 0 ? `${figure(100 * share, 0)} %` : percent(share);
}
