/** What the colours and signs of a board mean, as a part of a picture: only what is on that board. */

import { markerPath, shade, symmetricRange, valueDepth, WORST_RED, walker, worldDepth } from "#js/board/colours.js";
import { EMPTY_VIEW, rewardOf } from "#js/board/state.js";
import { number, signed } from "#js/lib/format.js";
import { paletteOf } from "#js/pictures/board.js";
import { hex, ink } from "#js/pictures/pen.js";
import { place, svgDocument, tag, text } from "#js/pictures/svg.js";
import { textWidth } from "#js/pictures/text-width.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").View} View */
/** @typedef {import("#js/board/theme.js").Theme} Theme */
/** @typedef {import("#js/board/colours.js").Rgb} Rgb */
/** @typedef {import("#js/pictures/svg.js").Figure} Figure */
/** @typedef {{width: number, theme: Theme, size: number, values?: string}} Room   how wide a legend may be, its type, what the values are */
/** @typedef {{sign: Figure, words: string, before?: string}} Item   a word before the sign, words after it */

const STEPS = 24;

/** @param {World} world @param {Partial<View>} view @param {{width?: number, theme?: "light" | "dark" | Theme, size?: number}} [options] */
export function legendSvg(world, view, { width = 560, theme = "light", size = 12 } = {}) {
  return svgDocument(legendFigure(world, view, { width, theme: paletteOf(theme), size }), { title: "Legend" });
}

/** @param {World} world @param {Partial<View>} view @param {Room} room @returns {Figure} */
export function legendFigure(world, view, room) {
  const whole = { ...EMPTY_VIEW, ...view };
  const ground = whole.values ? [valuesItem(whole, room)] : trueItems(world, room);
  return flow([...ground, ...inkItems(world, whole, room)], room);
}

/** What the world pays. @param {World} world @param {Room} room @returns {Item[]} */
export function trueItems(world, room) {
  const { theme, size } = room;
  const colours = world.colours.flat();
  const pays = [...new Set(world.goals.map((goal) => rewardOf(world, goal)))].sort((a, b) => a - b);
  const goals = pays.map((pay) => signed(pay, Number.isInteger(pay) ? 0 : 1)).join(" or ");
  const items = [];
  if (colours.includes("blue")) items.push({ sign: ramp(0, -1, "blue", room), words: "0 to −1 a step" });
  if (colours.includes("red")) items.push({ sign: ramp(-1, -WORST_RED, "red", room), words: "−1 to −7, hatched" });
  items.push({ sign: swatch(hex(theme.goal), size), words: `goal ${goals}` });
  if (world.walls.length > 0) items.push({ sign: swatch(hex(theme.wall), size), words: "wall" });
  return items;
}

/** What a learner believes, or what else the values are; one that is never above nothing has one arm. @param {View} view @param {Room} room @returns {Item} */
function valuesItem(view, room) {
  const values = view.values ?? [];
  const [low, high] = view.scale ?? symmetricRange(values);
  const isLoss = Boolean(room.values) && !Array.from(values).some((value) => value > 0);
  const end = isLoss ? 0 : high;
  const words = room.values || "learned reward, on a scale of its own";
  return {
    before: figureOf(low),
    sign: diverging([low, end], room),
    words: `${end > 0 ? "+" : ""}${figureOf(end)} ${words}`,
  };
}

/** What several learners believe, whose scales differ. @param {Room} room @returns {Item} */
export function learnedScales(room) {
  return { before: "−", sign: diverging([-1, 1], room), words: "+ learned reward, each board on a scale of its own" };
}

/** Signs above the squares. @param {World} world @param {View} view @param {Room} room @returns {Item[]} */
export function inkItems(world, view, room) {
  const { theme, size } = room;
  const items = [];
  if (world.start >= 0) items.push({ sign: ring(room), words: "start" });
  if (view.arrows) items.push({ sign: arrow(room), words: "arrow: the longer, the likelier the step" });
  if (view.visits) items.push({ sign: disc(room), words: "disc: how often it is there, by area" });
  if (view.unknown) items.push({ sign: hatched(room), words: "no attempt came here" });
  const walkers = [...new Set([...view.paths, ...view.agents].map(({ who }) => who))];
  if (walkers.length > 1) {
    for (const who of walkers)
      items.push({ sign: markerSign(who, theme, size), words: who === "human" ? "player" : walker(who).title || who });
  }
  return items;
}

/**
 * One after the other, in as many lines as they need.
 * @param {Item[]} items @param {Room} room @returns {Figure}
 */
export function flow(items, { width, theme, size }) {
  const [fill] = ink(theme.inkSoft);
  const [gap, line] = [size * 1.4, size * 1.7];
  let [x, y, widest] = [0, 0, 0];
  const drawn = items.map(({ sign, words, before = "" }) => {
    const lead = before === "" ? 0 : textWidth(before, size) + size * 0.4;
    const whole = lead + sign.width + size * 0.45 + textWidth(words, size);
    if (x > 0 && x + whole > width) [x, y] = [0, y + line];
    const base = y + size * 1.15;
    const parts = [
      before === "" ? "" : text(before, x, base, { size, fill }),
      place(sign, x + lead, base - size * 0.36 - sign.height / 2),
      text(words, x + lead + sign.width + size * 0.45, base, { size, fill }),
    ];
    widest = Math.max(widest, x + whole);
    x += whole + gap;
    return parts.join("");
  });
  return { markup: drawn.join(""), width: widest, height: items.length > 0 ? y + line : 0 };
}

/** @param {string} who @param {Theme} theme @param {number} size @returns {Figure} */
export function markerSign(who, theme, size) {
  const [fill] = ink(theme.who[who] ?? theme.who.random ?? theme.inkDark);
  const r = size * 0.38;
  const markup = tag("path", { d: markerPath(walker(who).shape, r * 1.2, r * 1.2, r), fill });
  return { markup, width: r * 2.4, height: r * 2.4 };
}

/** Costs from the palest of a colour to its deepest. @param {number} from @param {number} to @param {"red" | "blue"} colour @param {Room} room @returns {Figure} */
function ramp(from, to, colour, { theme, size }) {
  const figure = bar(size, (share) => {
    const { arm, depth } = worldDepth(colour, from + (to - from) * share);
    return shade(theme.scale, arm, depth);
  });
  if (colour === "blue") return figure;
  return { ...figure, markup: figure.markup + hatch(figure, 5, theme.inkLight) };
}

/** A scale about zero. @param {[number, number]} range @param {Pick<Room, "theme" | "size">} room */
export function diverging(range, { theme, size }) {
  return bar(size * 1.4, (share) => {
    const { arm, depth } = valueDepth(range[0] + (range[1] - range[0]) * share, range);
    return shade(theme.scale, arm, depth);
  });
}

/** Steps rather than a gradient: a gradient needs a name, and names clash where pictures meet. @param {number} size @param {(share: number) => Rgb} colourAt @returns {Figure} */
function bar(size, colourAt) {
  const [width, height] = [size * 3, size * 0.95];
  const step = width / STEPS;
  const markup = Array.from({ length: STEPS }, (_, i) =>
    tag("rect", { x: i * step, width: step, height, fill: hex(colourAt((i + 0.5) / STEPS)) }),
  );
  return { markup: tag("g", { "shape-rendering": "crispEdges" }, ...markup), width, height };
}

/** Diagonals inside a box. @param {{width: number, height: number}} box @param {number} gap @param {string} colour @param {boolean} [mirrored] */
function hatch({ width, height }, gap, colour, mirrored = false) {
  let way = "";
  for (let x = gap / 2; x + height <= width + 0.01; x += gap) {
    way += mirrored ? `M${x} 0L${x + height} ${height}` : `M${x} ${height}L${x + height} 0`;
  }
  const [stroke] = ink(colour);
  return tag("path", { d: way, stroke, "stroke-opacity": 0.6, "stroke-width": 0.9, fill: "none" });
}

/** @param {string} fill @param {number} size @returns {Figure} */
function swatch(fill, size) {
  const side = size * 0.95;
  return { markup: tag("rect", { width: side, height: side, rx: 1, fill }), width: side, height: side };
}

/** @param {Room} room @returns {Figure} */
function hatched({ theme, size }) {
  const box = { width: size * 1.9, height: size * 0.95 };
  const [stroke] = ink(theme.unknown);
  const edge = tag("rect", { ...box, fill: "none", stroke, "stroke-width": 0.6 });
  return { ...box, markup: edge + hatch(box, size * 0.32, theme.unknown, true) };
}

/** @param {Room} room @returns {Figure} */
function ring({ theme, size }) {
  const r = size * 0.42;
  const [stroke] = ink(theme.inkSoft);
  const markup = tag("circle", { cx: r + 0.5, cy: r + 0.5, r, fill: "none", stroke, "stroke-width": size * 0.1 });
  return { markup, width: 2 * r + 1, height: 2 * r + 1 };
}

/** @param {Room} room @returns {Figure} */
function disc({ theme, size }) {
  const r = size * 0.42;
  const [fill] = ink(theme.accent);
  return { markup: tag("circle", { cx: r, cy: r, r, fill, "fill-opacity": 0.5 }), width: 2 * r, height: 2 * r };
}

/** @param {Room} room @returns {Figure} */
function arrow({ theme, size }) {
  const [width, height] = [size * 1.3, size * 0.6];
  const [fill] = ink(theme.inkSoft);
  const line = tag("path", { d: `M0 ${height / 2}H${width - size * 0.3}`, stroke: fill, "stroke-width": size * 0.11 });
  const head = `M${width} ${height / 2}L${width - size * 0.45} 0V${height}z`;
  return { markup: line + tag("path", { d: head, fill }), width, height };
}

/** @param {number} value */
function figureOf(value) {
  return number(value, value === 0 || Math.abs(value) >= 10 ? 0 : Math.abs(value) >= 1 ? 1 : 2);
}
