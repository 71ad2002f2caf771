/**
 * A pen that takes the strokes meant for a canvas and writes SVG: the few members of CanvasRenderingContext2D and Path2D
 * that drawing a board uses (`board/render.js`, `ink.js`, `paths.js`), so that a picture for paper is drawn by the very lines
 * that draw the page.
 */

import { parseColour } from "#js/board/colours.js";
import { short, tag } from "#js/pictures/svg.js";
import { textWidth } from "#js/pictures/text-width.js";

/** A Path2D whose way can be read. */
class Trace {
  way = "";

  /** @param {number} x @param {number} y */
  moveTo(x, y) {
    this.way += `M${short(x)} ${short(y)}`;
  }

  /** @param {number} x @param {number} y */
  lineTo(x, y) {
    this.way += `L${short(x)} ${short(y)}`;
  }

  /** Whole circles are all a board has. @param {number} x @param {number} y @param {number} radius */
  arc(x, y, radius) {
    const r = short(radius);
    this.way += `M${short(x + radius)} ${short(y)}A${r} ${r} 0 1 1 ${short(x - radius)} ${short(y)}A${r} ${r} 0 1 1 ${short(x + radius)} ${short(y)}`;
  }

  closePath() {
    this.way += "Z";
  }
}

export class Pen {
  /** @type {string[]} */
  #drawn = [];
  #own = new Trace();
  fillStyle = "#000000";
  strokeStyle = "#000000";
  lineWidth = 1;
  globalAlpha = 1;
  font = "";
  /** @type {CanvasLineCap} */
  lineCap = "butt";
  /** @type {CanvasLineJoin} */
  lineJoin = "miter";
  /** @type {CanvasTextAlign} */
  textAlign = "start";
  /** @type {CanvasTextBaseline} */
  textBaseline = "alphabetic";

  /** @param {number} width @param {number} height of the canvas it stands for */
  constructor(width, height) {
    this.canvas = { width, height };
  }

  /** All strokes so far. */
  get markup() {
    return this.#drawn.join("");
  }

  /** @returns {Path2D} that only a pen can draw */
  static newPath() {
    return /** @type {Path2D} */ (/** @type {unknown} */ (new Trace()));
  }

  /** As the functions that draw boards know it. @returns {CanvasRenderingContext2D} */
  get context() {
    return /** @type {CanvasRenderingContext2D} */ (/** @type {unknown} */ (this));
  }

  /** Paper is clear. */
  clearRect() {}

  beginPath() {
    this.#own = new Trace();
  }

  /** @param {number} x @param {number} y */
  moveTo(x, y) {
    this.#own.moveTo(x, y);
  }

  /** @param {number} x @param {number} y */
  lineTo(x, y) {
    this.#own.lineTo(x, y);
  }

  /** @param {number} x @param {number} y @param {number} radius */
  arc(x, y, radius) {
    this.#own.arc(x, y, radius);
  }

  closePath() {
    this.#own.closePath();
  }

  /** @param {Path2D} [path] */
  stroke(path) {
    const { way } = path ? traceOf(path) : this.#own;
    if (way !== "") this.#drawn.push(tag("path", { d: way, fill: "none", ...this.#line }));
  }

  /** @param {Path2D} [path] */
  fill(path) {
    const { way } = path ? traceOf(path) : this.#own;
    if (way !== "") this.#drawn.push(tag("path", { d: way, ...this.#paint }));
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height */
  fillRect(x, y, width, height) {
    this.#drawn.push(tag("rect", { x, y, width, height, ...this.#paint }));
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height */
  strokeRect(x, y, width, height) {
    this.#drawn.push(tag("rect", { x, y, width, height, fill: "none", ...this.#line }));
  }

  /** @param {string} words */
  measureText(words) {
    const { size, weight } = this.#type;
    return { width: textWidth(words, size, weight) };
  }

  /** @param {string} words @param {number} x @param {number} y */
  fillText(words, x, y) {
    const { size, weight } = this.#type;
    // Few readers of SVG know a base line other than the letters': the middle of figures lies 0.36 of their size above it.
    const base = this.textBaseline === "middle" ? y + 0.36 * size : y;
    const anchor = this.textAlign === "center" ? "middle" : "start";
    const attributes = { x, y: base, "font-size": size, "font-weight": weight, "text-anchor": anchor, ...this.#paint };
    this.#drawn.push(tag("text", attributes, words));
  }

  get #line() {
    const [stroke, opacity] = ink(this.strokeStyle, this.globalAlpha);
    return {
      stroke,
      "stroke-opacity": opacity,
      "stroke-width": this.lineWidth,
      "stroke-linecap": this.lineCap === "butt" ? undefined : this.lineCap,
      "stroke-linejoin": this.lineJoin === "miter" ? undefined : this.lineJoin,
    };
  }

  get #paint() {
    const [fill, opacity] = ink(this.fillStyle, this.globalAlpha);
    return { fill, "fill-opacity": opacity };
  }

  /** "600 12.5px families" */
  get #type() {
    const [, weight = "400", size = "12"] = /^(\d+) ([\d.]+)px/.exec(this.font) ?? [];
    return { weight: Number(weight), size: Number(size) };
  }
}

/**
 * "#rrggbb" and the opacity apart: older readers of SVG know no "rgb(1 2 3 / 0.5)".
 * @param {string} style @param {number} [alpha] @returns {[string, number | undefined]}
 */
export function ink(style, alpha = 1) {
  const [, , , own = "1"] = style.startsWith("#") ? [] : (style.match(/[\d.]+/g) ?? []);
  const opacity = alpha * Number(own);
  return [hex(parseColour(style)), opacity < 1 ? opacity : undefined];
}

/** @param {ArrayLike<number>} rgb 0…255 */
export function hex(rgb) {
  return `#${[0, 1, 2]
    .map((i) =>
      Math.round(rgb[i] ?? 0)
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
}

/** @param {Path2D} path @returns {Trace} */
function traceOf(path) {
  if (path instanceof Trace) return path;
  throw new TypeError("A pen draws only paths of its own: make them with the scene's newPath().");
}
