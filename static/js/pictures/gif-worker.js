/**
 * Encodes an animated GIF: one palette for the whole film, and of each frame only the points that changed; the others are
 * left transparent over the frame before. A worker: it imports nothing by name, having no import map.
 */

/** @typedef {{encoder: string, width: number, height: number, samples: ArrayBuffer[]}} Beginning */
/** @typedef {{data: {begin?: Beginning, frame?: ArrayBuffer, time?: number, finish?: boolean}}} Question */

/** One place of the 256 is for "as before". */
const MOST_COLOURS = 255;
const FORMAT = "rgb565";

/** @type {any} the gifenc module */
let gifenc;
/** @type {any} its encoder */
let gif;
/** @type {number[][]} */
let palette = [];
let size = { width: 0, height: 0 };
/** @type {Uint8Array | null} */
let before = null;

self.onmessage = async (/** @type {Question} */ { data }) => {
  if (data.begin) self.postMessage(await begin(data.begin));
  else if (data.frame) self.postMessage(add(new Uint8Array(data.frame), data.time ?? 0));
  else self.postMessage(finish());
};

/** @param {Beginning} beginning */
async function begin({ encoder, width, height, samples }) {
  gifenc = await import(encoder);
  gif = gifenc.GIFEncoder();
  size = { width, height };
  palette = gifenc.quantize(joined(samples), MOST_COLOURS, { format: FORMAT });
  return palette.length;
}

/** @param {Uint8Array} pixels @param {number} time ms */
function add(pixels, time) {
  /** @type {Uint8Array} */
  const indices = gifenc.applyPalette(pixels, palette, FORMAT);
  const asBefore = palette.length;
  const shown = before ? indices.map((index, i) => (before?.[i] === index ? asBefore : index)) : indices;
  const first = before === null ? { palette: [...palette, [0, 0, 0]], repeat: 0 } : {};
  const clear = before === null ? {} : { transparent: true, transparentIndex: asBefore };
  gif.writeFrame(shown, size.width, size.height, { ...first, ...clear, delay: time, dispose: 1 });
  before = indices;
  return true;
}

function finish() {
  gif.finish();
  return gif.bytes();
}

/** @param {ArrayBuffer[]} buffers */
function joined(buffers) {
  const whole = new Uint8Array(buffers.reduce((sum, { byteLength }) => sum + byteLength, 0));
  let at = 0;
  for (const buffer of buffers) {
    whole.set(new Uint8Array(buffer), at);
    at += buffer.byteLength;
  }
  return whole;
}
