/** An animated GIF, encoded in a worker so that the page stays alive; cancelling ends the worker. */

/** @typedef {import("#js/pictures/film.js").Reel} Reel */
/** @typedef {{signal: AbortSignal, onProgress: (share: number) => void}} Watch */

/** Frames whose colours make the palette: the first, one in the middle, the last. */
const SAMPLES = [0, 0.5, 1];

/** @param {Reel} reel @param {Watch} watch @returns {Promise<Blob>} */
export async function encodeGif(reel, { signal, onProgress }) {
  const worker = new Worker(new URL("./gif-worker.js", import.meta.url), { type: "module" });
  const end = () => worker.terminate();
  signal.addEventListener("abort", end);
  try {
    const last = reel.times.length - 1;
    const samples = await Promise.all(SAMPLES.map(async (share) => pixels(await reel.frame(Math.round(share * last)))));
    const { width, height } = reel;
    // A worker has no import map: it is told where the encoder is.
    await ask(worker, { begin: { encoder: import.meta.resolve("gifenc"), width, height, samples } }, signal);
    for (const [index, time] of reel.times.entries()) {
      const frame = pixels(await reel.frame(index));
      await ask(worker, { frame, time }, signal, [frame]);
      onProgress((index + 1) / reel.times.length);
    }
    return new Blob([await ask(worker, { finish: true }, signal)], { type: "image/gif" });
  } finally {
    signal.removeEventListener("abort", end);
    worker.terminate();
  }
}

/** One question, one answer; none when the worker failed or the person gave up. @param {Worker} worker @param {object} question @param {AbortSignal} signal @param {Transferable[]} [transfer] @returns {Promise<any>} */
function ask(worker, question, signal, transfer = []) {
  signal.throwIfAborted();
  return new Promise((resolve, reject) => {
    worker.onmessage = ({ data }) => resolve(data);
    worker.onerror = (event) => reject(new Error(event.message || "The film's worker could not start."));
    signal.addEventListener("abort", () => reject(signal.reason), { once: true });
    worker.postMessage(question, transfer);
  });
}

/** @param {ImageData} image */
function pixels(image) {
  return /** @type {ArrayBuffer} */ (image.data.buffer);
}
