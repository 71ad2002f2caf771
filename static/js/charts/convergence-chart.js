/**
 * A convergence chart: the gap (log scale) or the log-likelihood of each learner by iteration, in the learner's hue and
 * with its marker shape; a vertical line marks the iteration on the boards. A click or drag on the plot moves it there.
 * @import {FrameStore} from "#js/learning/frame-store.js"
 */
import uPlot from "uplot";
import { traceMarker, walker } from "#js/board/colours.js";
import { onThemeChange, theme } from "#js/board/theme.js";
import { significant } from "#js/charts/figures.js";
import { decades, roundDomain } from "#js/charts/scales.js";

/** @typedef {"gap" | "log_likelihood"} Measure */

const MARKERS_PER_LINE = 7;
const AXIS_LEFT = 68;

export class ConvergenceChart {
  /** @type {uPlot | null} */
  #plot = null;
  #box;
  #store;
  #learners;
  #onPick;
  /** @type {Measure} */
  #measure;
  #last = 1;
  #position = 0;

  /**
   * @param {HTMLElement} box reserves the size
   * @param {FrameStore} store
   * @param {{ learners: string[], measure: Measure, onPick: (iteration: number) => void, signal: AbortSignal }} options
   */
  constructor(box, store, { learners, measure, onPick, signal }) {
    this.#box = box;
    this.#store = store;
    this.#learners = learners;
    this.#measure = measure;
    this.#onPick = onPick;
    this.#rebuild();
    const resizes = new ResizeObserver(() => this.#plot?.setSize(this.#size()));
    resizes.observe(box);
    onThemeChange(() => this.#rebuild(), signal);
    signal.addEventListener("abort", () => {
      resizes.disconnect();
      this.#plot?.destroy();
    });
  }

  /** Draw another run from now on. @param {FrameStore} store */
  read(store) {
    this.#store = store;
  }

  /**
   * @param {number} position iteration on the boards
   * @param {number} last right end of the axis
   */
  update(position, last) {
    this.#position = position;
    this.#last = Math.max(1, last);
    this.#plot?.setData(this.#data());
  }

  /** @param {number} position iteration on the boards */
  moveTo(position) {
    if (position === this.#position) return;
    this.#position = position;
    this.#plot?.redraw(false, false);
  }

  #rebuild() {
    this.#plot?.destroy();
    this.#plot = new uPlot(this.#options(), this.#data(), this.#box);
    this.#pickOn(this.#plot.over);
  }

  /** @returns {uPlot.AlignedData} */
  #data() {
    const { iterations, columns } = this.#store.columns(this.#learners, this.#measure);
    const isLog = this.#measure === "gap";
    // A logarithmic axis has no zero: a gap that vanished entirely leaves the line there.
    const drawable = columns.map((column) =>
      column.map((value) => (value === null || (isLog && value <= 0) ? null : value)),
    );
    return /** @type {uPlot.AlignedData} */ ([iterations, ...drawable]);
  }

  #size() {
    return { width: Math.max(200, this.#box.clientWidth), height: Math.max(120, this.#box.clientHeight) };
  }

  /** @returns {uPlot.Options} */
  #options() {
    const { who } = theme();
    const style = getComputedStyle(this.#box);
    const ink = style.color;
    const line = style.getPropertyValue("border-top-color") || ink;
    const axis = {
      stroke: ink,
      font: `12px ${style.fontFamily}`,
      grid: { stroke: line, width: 1 },
      ticks: { stroke: line, width: 1, size: 4 },
    };
    const isLog = this.#measure === "gap";
    return {
      ...this.#size(),
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, points: { show: false }, y: false },
      padding: [10, 12, 0, 0],
      scales: {
        x: { time: false, range: () => [0, this.#last] },
        y: { distr: isLog ? 3 : 1, log: 10, range: () => this.#range() },
      },
      axes: [
        { ...axis, label: undefined, size: 26, gap: 4, space: 60 },
        {
          ...axis,
          size: AXIS_LEFT,
          gap: 4,
          space: 26,
          values: (_plot, values) => values.map((value) => tick(value, isLog)),
        },
      ],
      series: [
        {},
        ...this.#learners.map((learner) => ({
          label: walker(learner).title,
          stroke: who[learner] ?? who.random ?? ink,
          width: 2,
          spanGaps: true,
          points: { show: false },
        })),
      ],
      hooks: {
        drawSeries: [(plot, index) => drawMarkers(plot, index, this.#learners[index - 1] ?? "", style.backgroundColor)],
        draw: [(plot) => drawPosition(plot, this.#position, ink)],
      },
    };
  }

  /** @returns {[number, number]} */
  #range() {
    const values = this.#store.columns(this.#learners, this.#measure).columns.flat();
    if (this.#measure === "gap") return decades(values);
    return roundDomain(values.filter((value) => value !== null));
  }

  /** @param {HTMLElement} over */
  #pickOn(over) {
    const pick = (/** @type {PointerEvent} */ event) => {
      if (event.buttons !== 1 || !this.#plot) return;
      const left = event.clientX - over.getBoundingClientRect().left;
      this.#onPick(Math.round(this.#plot.posToVal(left, "x")));
    };
    over.addEventListener("pointerdown", pick);
    over.addEventListener("pointermove", pick);
  }
}

/**
 * A few markers along a line, spread evenly over the axis, and one at its end.
 * @param {uPlot} plot
 * @param {number} index of the series
 * @param {string} learner
 * @param {string} ground colour behind the chart
 */
function drawMarkers(plot, index, learner, ground) {
  const { ctx } = plot;
  const radius = 4.5 * devicePixelRatio;
  ctx.save();
  ctx.fillStyle = /** @type {string} */ (theme().who[learner] ?? theme().who.random);
  ctx.strokeStyle = ground;
  ctx.lineWidth = 1.25 * devicePixelRatio;
  for (const row of markerRows(plot, index)) {
    const x = plot.valToPos(plot.data[0][row] ?? 0, "x", true);
    const y = plot.valToPos(plot.data[index]?.[row] ?? 0, "y", true);
    ctx.beginPath();
    traceMarker(ctx, walker(learner).shape, x, y, radius);
    ctx.fill();
    ctx.stroke();
  }
  ctx.restore();
}

/**
 * @param {uPlot} plot
 * @param {number} index
 */
function markerRows(plot, index) {
  const iterations = plot.data[0];
  const column = plot.data[index] ?? [];
  const stride = (plot.scales.x?.max ?? 1) / MARKERS_PER_LINE;
  // Each line starts its markers a little later, so that lines on top of each other still show all their shapes.
  let due = (stride * (index - 1)) / plot.series.length;
  let lastRow = -1;
  /** @type {number[]} */
  const rows = [];
  for (let row = 0; row < iterations.length; row++) {
    if (column[row] === null || column[row] === undefined) continue;
    lastRow = row;
    if ((iterations[row] ?? 0) < due) continue;
    rows.push(row);
    due = (iterations[row] ?? 0) + stride;
  }
  return lastRow >= 0 && rows.at(-1) !== lastRow ? [...rows, lastRow] : rows;
}

/**
 * @param {uPlot} plot
 * @param {number} position
 * @param {string} ink
 */
function drawPosition(plot, position, ink) {
  const { ctx, bbox } = plot;
  const x = Math.round(plot.valToPos(position, "x", true)) + 0.5;
  if (x < bbox.left || x > bbox.left + bbox.width + 1) return;
  ctx.save();
  ctx.strokeStyle = ink;
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}

/**
 * @param {number | null} value
 * @param {boolean} isLog
 */
function tick(value, isLog) {
  if (value === null) return "";
  if (!isLog) return significant(value).replace(/(\.0)? × /, "×"); // "−2×10⁵" has room beside the axis
  const exponent = Math.log10(value);
  return Math.abs(exponent - Math.round(exponent)) < 1e-6 ? significant(value) : "";
}
