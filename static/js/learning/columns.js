/** How boards stand in rows. */

/** Rows of at most `most` and of equal length, or nearly. @param {number} count @param {number} [most] */
export function columnsFor(count, most = 6) {
  return Math.ceil(count / Math.max(1, Math.ceil(count / most)));
}
