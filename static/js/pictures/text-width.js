/**
 * How wide words are, and where their lines break, without a page: by the widths of Helvetica's letters (thousandths of the
 * type size), which Arial and Liberation Sans share.
 */

/** @type {Record<string, number>} */
const WIDTHS = {};
for (const [letters, width] of /** @type {const} */ ([
  ["ijl‘’'", 222],
  ["|", 260],
  [" !,./:;I[\\]ftı·", 278],
  ["()-r`“”", 333],
  ["{}", 334],
  ['"', 355],
  ["*", 389],
  ["^", 469],
  ["cksvxyzJ", 500],
  ["#$0123456789?Labdeghnopqu_–", 556],
  ["+<=>~±×−÷≤≥≈", 584],
  ["FTZ", 611],
  ["&ABEKPSVXY", 667],
  ["CDHNRUw", 722],
  ["GOQ", 778],
  ["Mm", 833],
  ["%", 889],
  ["W", 944],
  ["@—…", 1000],
])) {
  for (const letter of letters) WIDTHS[letter] = width;
}
const UNKNOWN = 600;
const BOLD = 1.07;
/** A name is set no smaller than this share of its size; what is still too long is cut off. */
const SMALLEST_SHARE = 0.85;

/** @param {string} words @param {number} size @param {number} [weight] */
export function textWidth(words, size, weight = 400) {
  let thousandths = 0;
  for (const letter of words) thousandths += WIDTHS[letter] ?? UNKNOWN;
  return (thousandths / 1000) * size * (weight >= 600 ? BOLD : 1);
}

/** Words in lines no wider than `width`; a word that is wider stands alone. @param {string} words @param {number} width @param {number} size @param {number} [weight] */
export function brokenInto(words, width, size, weight = 400) {
  /** @type {string[]} */
  const lines = [];
  for (const word of words.split(" ").filter(Boolean)) {
    const longer = lines.length > 0 ? `${lines.at(-1)} ${word}` : word;
    if (lines.length > 0 && textWidth(longer, size, weight) <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

/** A name cut off where it would be wider than its place. @param {string} words @param {number} width @param {number} size @param {number} [weight] */
export function fittedInto(words, width, size, weight = 400) {
  if (textWidth(words, size, weight) <= width) return words;
  let cut = words;
  while (cut.length > 1 && textWidth(`${cut}…`, size, weight) > width) cut = cut.slice(0, -1).trimEnd();
  return `${cut}…`;
}

/** The largest size of type, of what is asked for and some smaller ones, at which words fit. @param {string} words @param {number} width @param {number} size @param {number} [weight] */
export function sizeFor(words, width, size, weight = 400) {
  const exact = (0.999 * size * width) / textWidth(words, size, weight);
  return Math.max(SMALLEST_SHARE * size, Math.min(size, exact));
}
