/**
 * The red–blue scale, inks that hold contrast on it, and the hue and marker shape of everybody who walks a board.
 *
 * A world's own rewards: the colour of a square says its kind, the depth its size. Blue squares cost up to 1 and use the
 * blue arm by |r|; red squares cost 1 to 7 and use the red arm by |r| / 7. Neither arm starts at the neutral middle, so
 * that the palest red and the palest blue are told apart. Learned rewards use both arms from the middle, about zero.
 */

/** @typedef {[number, number, number]} Rgb   0…255 */
/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").View} View */

const STEPS = 256;
const PALEST_BLUE = 0.16;
const PALEST_RED = 0.3;
export const WORST_RED = 7;

/** Everybody who walks a board: title, token of the hue, marker shape. */
export const WALKERS = /** @type {const} */ ({
  human: { title: "You", token: "--who-human", shape: "circle" },
  meirl: { title: "MEIRL", token: "--who-meirl", shape: "square" },
  irlr: { title: "IRLR", token: "--who-irlr", shape: "triangle" },
  irlf: { title: "IRLF", token: "--who-irlf", shape: "triangle-down" },
  irlfr: { title: "IRLFR", token: "--who-irlfr", shape: "hexagon" },
  birlfr: { title: "Bayesian IRLFR", token: "--who-birlfr", shape: "star" },
  model_free: { title: "Model-free IRLFR", token: "--who-model-free", shape: "bow-tie" },
  trex: { title: "T-REX (linear)", token: "--who-baseline", shape: "triangle-right" },
  bc: { title: "Behavioural cloning", token: "--who-baseline", shape: "plus" },
  score_irl: { title: "Score-based IRL", token: "--who-baseline", shape: "hourglass" },
  random: { title: "Random", token: "--who-baseline", shape: "saltire" },
  optimal: { title: "Optimum", token: "--who-optimal", shape: "diamond" },
});

/** One the browser does not know, from a newer server or a plug-in. */
const STRANGER = { title: "", token: "--who-baseline", shape: "bar" };

/** @param {string} who */
export function walker(who) {
  return Object.hasOwn(WALKERS, who) ? WALKERS[/** @type {keyof typeof WALKERS} */ (who)] : STRANGER;
}

/** @type {[number, number][]} */
const BOW_TIE = [
  [-1.15, -0.9],
  [0, -0.3],
  [1.15, -0.9],
  [1.15, 0.9],
  [0, 0.3],
  [-1.15, 0.9],
];
/** @type {[number, number][]} */
const PLUS = [
  [-0.38, -1.1],
  [0.38, -1.1],
  [0.38, -0.38],
  [1.1, -0.38],
  [1.1, 0.38],
  [0.38, 0.38],
  [0.38, 1.1],
  [-0.38, 1.1],
  [-0.38, 0.38],
  [-1.1, 0.38],
  [-1.1, -0.38],
  [-0.38, -0.38],
];

/** Corners of each marker shape about the unit circle; a circle has none. @type {Record<string, [number, number][]>} */
const CORNERS = {
  circle: [],
  square: polygon(4, 45, 1.1),
  triangle: polygon(3, -90, 1.15),
  "triangle-down": polygon(3, 90, 1.15),
  hexagon: polygon(6, 0, 1.05),
  diamond: polygon(4, 0, 1.15),
  star: star(),
  "bow-tie": BOW_TIE,
  hourglass: BOW_TIE.map(([x, y]) => [y, x]),
  "triangle-right": polygon(3, 0, 1.15),
  plus: PLUS,
  saltire: PLUS.map(([x, y]) => [Math.SQRT1_2 * (x - y), Math.SQRT1_2 * (x + y)]),
  bar: [
    [-1.1, -0.4],
    [1.1, -0.4],
    [1.1, 0.4],
    [-1.1, 0.4],
  ],
};

/** SVG path data of a marker of radius `r` about (`x`, `y`). @param {string} shape @param {number} [x] @param {number} [y] @param {number} [r] */
export function markerPath(shape, x = 0, y = 0, r = 1) {
  const corners = CORNERS[shape] ?? [];
  if (corners.length === 0) return `M${x - r},${y}a${r},${r} 0 1,0 ${2 * r},0a${r},${r} 0 1,0 ${-2 * r},0z`;
  return `M${corners.map(([cx, cy]) => `${round(x + r * cx)},${round(y + r * cy)}`).join("L")}z`;
}

/** Add a marker to the current path of a canvas. @param {CanvasRenderingContext2D} context @param {string} shape @param {number} x @param {number} y @param {number} r */
export function traceMarker(context, shape, x, y, r) {
  const corners = CORNERS[shape] ?? [];
  if (corners.length === 0) {
    context.moveTo(x + r, y);
    context.arc(x, y, r, 0, 2 * Math.PI);
    return;
  }
  corners.forEach(([cx, cy], i) => {
    if (i === 0) context.moveTo(x + r * cx, y + r * cy);
    else context.lineTo(x + r * cx, y + r * cy);
  });
  context.closePath();
}

/**
 * @typedef {object} Scale
 * @property {Rgb[]} red      from the middle to the full red, STEPS entries
 * @property {Rgb[]} blue
 */

/** @param {{red: Rgb, middle: Rgb, blue: Rgb}} ends @returns {Scale} */
export function makeScale({ red, middle, blue }) {
  return { red: ramp(middle, red), blue: ramp(middle, blue) };
}

/** @param {Scale} scale @param {"red" | "blue"} arm @param {number} depth 0…1 @returns {Rgb} */
export function shade(scale, arm, depth) {
  const index = Math.round(Math.min(1, Math.max(0, depth)) * (STEPS - 1));
  return /** @type {Rgb} */ (scale[arm][index]);
}

/** Arm and depth of a square of the world itself. @param {string} colour @param {number} reward @returns {{arm: "red" | "blue", depth: number}} */
export function worldDepth(colour, reward) {
  if (colour === "red")
    return { arm: "red", depth: PALEST_RED + (1 - PALEST_RED) * Math.min(1, Math.abs(reward) / WORST_RED) };
  return { arm: "blue", depth: PALEST_BLUE + (1 - PALEST_BLUE) * Math.min(1, Math.abs(reward)) };
}

/** Arm and depth of a value on a scale about zero. @param {number} value @param {[number, number]} range @returns {{arm: "red" | "blue", depth: number}} */
export function valueDepth(value, [minimum, maximum]) {
  const end = value < 0 ? -minimum : maximum;
  return { arm: value < 0 ? "red" : "blue", depth: end > 0 ? Math.min(1, Math.abs(value) / end) : 0 };
}

/** The scale of values when none is given: symmetric about zero by the largest size. @param {ArrayLike<number>} values @returns {[number, number]} */
export function symmetricRange(values) {
  let largest = 0;
  for (let i = 0; i < values.length; i++) {
    const size = Math.abs(values[i] ?? 0);
    if (Number.isFinite(size) && size > largest) largest = size;
  }
  return [-(largest || 1), largest || 1];
}

/** Shades are shared arrays, so that what is known of one holds for every square that has it. @type {WeakMap<Rgb, boolean>} */
const darkInk = new WeakMap();

/** True where dark ink reads better than light ink (equal contrast lies at a luminance of 0.179). @param {Rgb} colour */
export function wantsDarkInk(colour) {
  let known = darkInk.get(colour);
  if (known === undefined) {
    known = luminance(colour) > 0.2;
    darkInk.set(colour, known);
  }
  return known;
}

/** Relative luminance (WCAG 2). @param {Rgb} colour */
export function luminance([r, g, b]) {
  return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
}

/** "rgb(1 2 3)", "rgb(1, 2, 3)" or "#aabbcc". @param {string} text @returns {Rgb} */
export function parseColour(text) {
  const hex = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(text.trim());
  if (hex) return [parseInt(hex[1] ?? "0", 16), parseInt(hex[2] ?? "0", 16), parseInt(hex[3] ?? "0", 16)];
  const [r = 0, g = 0, b = 0] = (text.match(/[\d.]+/g) ?? []).map(Number);
  return [r, g, b];
}

/** @param {Rgb} from @param {Rgb} to @returns {Rgb[]} */
function ramp(from, to) {
  const [a, b] = [toOklab(from), toOklab(to)];
  return Array.from({ length: STEPS }, (_, i) => {
    const t = i / (STEPS - 1);
    return fromOklab([a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t]);
  });
}

/* OKLab: B. Ottosson, "A perceptual color space for image processing" (2020). */

/** @param {Rgb} colour @returns {[number, number, number]} */
export function toOklab([red, green, blue]) {
  const [r, g, b] = [linear(red), linear(green), linear(blue)];
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

/** @param {[number, number, number]} lab @returns {Rgb} */
export function fromOklab([lightness, a, b]) {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    gamma(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    gamma(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    gamma(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

/** @param {number} channel 0…255 */
function linear(channel) {
  const c = channel / 255;
  return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
}

/** @param {number} c linear light, 0…1 */
function gamma(c) {
  const encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
  return Math.round(Math.min(1, Math.max(0, encoded)) * 255);
}

/** @param {number} n @param {number} firstDegrees @param {number} size @returns {[number, number][]} */
function polygon(n, firstDegrees, size) {
  return Array.from({ length: n }, (_, i) => {
    const angle = ((firstDegrees + (360 * i) / n) * Math.PI) / 180;
    return [size * Math.cos(angle), size * Math.sin(angle)];
  });
}

/** @returns {[number, number][]} */
function star() {
  return Array.from({ length: 10 }, (_, i) => {
    const angle = ((-90 + 36 * i) * Math.PI) / 180;
    const size = i % 2 === 0 ? 1.25 : 0.55;
    return [size * Math.cos(angle), size * Math.sin(angle)];
  });
}

/** @param {number} value */
function round(value) {
  return Math.round(value * 100) / 100;
}
