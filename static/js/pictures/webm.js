/** A WebM film, where the browser can encode one (WebCodecs): faster than it plays, with its length and sizes in its head. */

import { muxWebm } from "#js/pictures/webm-file.js";

/** @typedef {import("#js/pictures/film.js").Reel} Reel */
/** @typedef {import("#js/pictures/gif.js").Watch} Watch */
/** @typedef {import("#js/pictures/webm-file.js").Chunk} Chunk */

const CODEC = "vp09.00.31.08";
const BITS_PER_SECOND = 1_500_000;
/** A key frame this often, so that players can seek. */
const KEY_EVERY = 40;
/** Frames that may wait for the encoder. */
const MOST_WAITING = 4;

/** Whether this browser can. */
export async function canWebm() {
  if (typeof VideoEncoder !== "function") return false;
  try {
    const asked = { codec: CODEC, width: 640, height: 360, bitrate: BITS_PER_SECOND };
    return (await VideoEncoder.isConfigSupported(asked)).supported === true;
  } catch {
    return false;
  }
}

/** @param {Reel} reel @param {Watch} watch @returns {Promise<Blob>} */
export async function encodeWebm({ width, height, times, frame }, { signal, onProgress }) {
  /** @type {Chunk[]} */
  const chunks = [];
  /** @type {unknown} */
  let failure = null;
  const encoder = new VideoEncoder({
    output: (chunk) => chunks.push(chunkOf(chunk)),
    error: (error) => (failure = error),
  });
  try {
    encoder.configure({ codec: CODEC, width, height, bitrate: BITS_PER_SECOND });
    let time = 0;
    for (const [index, stay] of times.entries()) {
      signal.throwIfAborted();
      const picture = await createImageBitmap(await frame(index));
      const shown = new VideoFrame(picture, { timestamp: 1000 * time, duration: 1000 * stay });
      encoder.encode(shown, { keyFrame: index % KEY_EVERY === 0 });
      shown.close();
      picture.close();
      time += stay;
      while (encoder.encodeQueueSize > MOST_WAITING && !failure) await dequeued(encoder);
      if (failure) throw failure;
      onProgress((index + 1) / times.length);
    }
    await encoder.flush();
    if (failure) throw failure;
    const milliseconds = times.reduce((sum, stay) => sum + stay, 0);
    return new Blob([muxWebm(chunks, { width, height, milliseconds })], { type: "video/webm" });
  } finally {
    if (encoder.state !== "closed") encoder.close();
  }
}

/** @param {EncodedVideoChunk} chunk @returns {Chunk} */
function chunkOf(chunk) {
  const bytes = new Uint8Array(chunk.byteLength);
  chunk.copyTo(bytes);
  return { bytes, milliseconds: Math.round(chunk.timestamp / 1000), isKey: chunk.type === "key" };
}

/** @param {VideoEncoder} encoder */
function dequeued(encoder) {
  return new Promise((resolve) => encoder.addEventListener("dequeue", resolve, { once: true }));
}
