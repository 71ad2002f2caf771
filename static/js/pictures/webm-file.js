/**
 * A WebM file of one video track: a Matroska document of head, length, track and clusters (RFC 9559, "Matroska Media
 * Container Format"; RFC 8794, "Extensible Binary Meta Language"). Times count in milliseconds.
 */

/** @typedef {{bytes: Uint8Array, milliseconds: number, isKey: boolean}} Chunk */

/** Names of elements, as the RFCs number them. */
const EBML = 0x1a45dfa3;
const [EBML_VERSION, READ_VERSION, MAX_ID, MAX_SIZE] = [0x4286, 0x42f7, 0x42f2, 0x42f3];
const [DOC_TYPE, DOC_VERSION, DOC_READ_VERSION] = [0x4282, 0x4287, 0x4285];
const [SEGMENT, INFO, TIMESTAMP_SCALE, DURATION] = [0x18538067, 0x1549a966, 0x2ad7b1, 0x4489];
const [MUXING_APP, WRITING_APP] = [0x4d80, 0x5741];
const [TRACKS, TRACK, TRACK_NUMBER, TRACK_UID] = [0x1654ae6b, 0xae, 0xd7, 0x73c5];
const [TRACK_TYPE, CODEC_ID, VIDEO, PIXEL_WIDTH, PIXEL_HEIGHT] = [0x83, 0x86, 0xe0, 0xb0, 0xba];
const [CLUSTER, TIMESTAMP, SIMPLE_BLOCK] = [0x1f43b675, 0xe7, 0xa3];
const MILLISECOND_NS = 1_000_000;
const IS_KEY = 0x80;
/** A track number of one byte carries this bit. */
const ONE_BYTE = 0x80;

/** @param {Chunk[]} chunks VP9, in order @param {{width: number, height: number, milliseconds: number}} film @returns {Uint8Array<ArrayBuffer>} */
export function muxWebm(chunks, film) {
  return joined([head(), element(SEGMENT, joined([info(film), tracks(film), ...clusters(chunks)]))]);
}

function head() {
  return element(
    EBML,
    joined([
      element(EBML_VERSION, whole(1)),
      element(READ_VERSION, whole(1)),
      element(MAX_ID, whole(4)),
      element(MAX_SIZE, whole(8)),
      element(DOC_TYPE, ascii("webm")),
      element(DOC_VERSION, whole(4)),
      element(DOC_READ_VERSION, whole(2)),
    ]),
  );
}

/** @param {{milliseconds: number}} film */
function info({ milliseconds }) {
  const parts = [
    element(TIMESTAMP_SCALE, whole(MILLISECOND_NS)),
    element(DURATION, float(milliseconds)),
    element(MUXING_APP, ascii("IRLFR")),
    element(WRITING_APP, ascii("IRLFR")),
  ];
  return element(INFO, joined(parts));
}

/** @param {{width: number, height: number}} film */
function tracks({ width, height }) {
  const video = joined([element(PIXEL_WIDTH, whole(width)), element(PIXEL_HEIGHT, whole(height))]);
  const track = [
    element(TRACK_NUMBER, whole(1)),
    element(TRACK_UID, whole(1)),
    element(TRACK_TYPE, whole(1)),
    element(CODEC_ID, ascii("V_VP9")),
    element(VIDEO, video),
  ];
  return element(TRACKS, element(TRACK, joined(track)));
}

/** One for each key frame, which begins it. @param {Chunk[]} chunks */
function clusters(chunks) {
  /** @type {Chunk[][]} */
  const groups = [];
  for (const chunk of chunks) {
    if (chunk.isKey || groups.length === 0) groups.push([]);
    groups.at(-1)?.push(chunk);
  }
  return groups.map((group) => {
    const begin = group[0]?.milliseconds ?? 0;
    return element(CLUSTER, joined([element(TIMESTAMP, whole(begin)), ...group.map((chunk) => block(chunk, begin))]));
  });
}

/** @param {Chunk} chunk @param {number} begin of its cluster */
function block({ bytes, milliseconds, isKey }, begin) {
  const after = milliseconds - begin;
  const lead = new Uint8Array([ONE_BYTE | 1, (after >> 8) & 255, after & 255, isKey ? IS_KEY : 0]);
  return element(SIMPLE_BLOCK, joined([lead, bytes]));
}

/** @param {number} id @param {Uint8Array} content */
function element(id, content) {
  return joined([whole(id), length(content.length), content]);
}

/** A length in eight bytes, the first of which says so. @param {number} value */
function length(value) {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setBigUint64(0, BigInt(value) | (1n << 56n));
  return bytes;
}

/** A whole number in as few bytes as it needs. @param {number} value */
function whole(value) {
  const bytes = [];
  for (let rest = value; bytes.length === 0 || rest > 0; rest = Math.floor(rest / 256)) bytes.unshift(rest % 256);
  return new Uint8Array(bytes);
}

/** @param {number} value */
function float(value) {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setFloat64(0, value);
  return bytes;
}

/** @param {string} words */
function ascii(words) {
  return new TextEncoder().encode(words);
}

/** @param {Uint8Array[]} parts */
function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}
