/**
 * The canvases of a board, one above the other, each painted only when what it shows has changed: the squares, the
 * trail (one path that grows while it is walked), the ink (visits, paths, arrows, figures).
 */

import { make } from "#js/board/dom.js";
import { drawInk } from "#js/board/ink.js";
import { redrawPath } from "#js/board/paths.js";
import { drawSquares, lookOf } from "#js/board/render.js";
import { theme } from "#js/board/theme.js";
import { changedSquares } from "#js/board/trail.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").View} View */
/** @typedef {import("#js/board/state.js").Path} Path */
/** @typedef {import("#js/board/render.js").Geometry} Geometry */
/** @typedef {import("#js/board/render.js").Look} Look */

/** A single path of more steps than this is painted step by step. */
const LONG_PATH = 64;

export class Painter {
  #squares = makeCanvas("board-squares");
  #ink = makeCanvas("board-ink");
  /** @type {HTMLCanvasElement | null} made when a path first needs it */
  #trail = null;
  /** @type {Look | null} */
  #look = null;
  /** @type {Path | null} */
  #walked = null;
  #isOld = { squares: true, ink: true };

  get canvases() {
    return [this.#squares, this.#ink];
  }

  redrawAll() {
    this.#isOld = { squares: true, ink: true };
    this.#forgetTrail();
  }

  redrawInk() {
    this.#isOld.ink = true;
  }

  /** Setting a canvas' size wipes it: paint before the browser shows the empty one. @param {World} world @param {Geometry} geometry */
  resize(world, { cell }) {
    for (const canvas of this.canvases) setSize(canvas, world, cell);
    this.redrawAll();
  }

  /** Note what a new view makes old. @param {View} before @param {View} after */
  compare(before, after) {
    const isRepainted =
      before.values !== after.values || before.scale !== after.scale || before.unknown !== after.unknown;
    if (isRepainted) this.#isOld.squares = true;
    const isPathNew = before.paths !== after.paths && !(trailOf(before) && trailOf(after));
    const isInkNew =
      before.numbers !== after.numbers || before.arrows !== after.arrows || before.visits !== after.visits;
    if (isRepainted || isInkNew || isPathNew) this.#isOld.ink = true;
  }

  /** @param {World} world @param {View} view @param {Geometry} geometry */
  paint(world, view, geometry) {
    const palette = theme();
    if (this.#isOld.squares || !this.#look) this.#look = lookOf(world, view, palette);
    const scene = { world, view, geometry, theme: palette, look: this.#look, newPath };
    if (this.#isOld.squares) drawSquares({ ...scene, context: contextOf(this.#squares) });
    const trail = trailOf(view);
    this.#paintTrail(scene, trail);
    const inked = trail ? { ...view, paths: [] } : view;
    if (this.#isOld.ink) drawInk({ ...scene, view: inked, context: contextOf(this.#ink) });
    this.#isOld = { squares: false, ink: false };
  }

  /** @param {Omit<import("#js/board/render.js").Scene, "context">} scene @param {Path | null} path */
  #paintTrail(scene, path) {
    const box = changedSquares(scene.world, this.#walked, path);
    this.#walked = path;
    if (!box) return;
    this.#trail ??= this.#addTrail(scene.world, scene.geometry);
    redrawPath({ ...scene, context: contextOf(this.#trail) }, path, box);
  }

  /** @param {World} world @param {Geometry} geometry */
  #addTrail(world, { cell }) {
    const canvas = makeCanvas("board-trail");
    setSize(canvas, world, cell);
    this.#squares.after(canvas);
    return canvas;
  }

  #forgetTrail() {
    this.#trail?.remove();
    this.#trail = null;
    this.#walked = null;
  }
}

/** The one path that is painted step by step, if the view has such a one. @param {View} view @returns {Path | null} */
function trailOf({ paths, visits }) {
  const [path] = paths;
  const isAlone = paths.length === 1 && visits === null;
  return path && isAlone && (path.fade || path.states.length > LONG_PATH) ? path : null;
}

function newPath() {
  return new Path2D();
}

/** @param {string} className */
function makeCanvas(className) {
  return /** @type {HTMLCanvasElement} */ (make("canvas", className));
}

/** @param {HTMLCanvasElement} canvas @param {World} world @param {number} cell device pixels */
function setSize(canvas, world, cell) {
  canvas.width = Math.round(cell * world.cols);
  canvas.height = Math.round(cell * world.rows);
}

/** @param {HTMLCanvasElement} canvas */
function contextOf(canvas) {
  return /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
}
