/** Measured figures in words: what may be missing or not finite, intervals, shares, lists of names. */

import { number } from "#js/lib/format.js";

const MINUS = "−";

/**
 * A number with a fixed count of decimals, a dash where there is none: `figure(-3.44)` is "−3.4".
 * @param {number | null | undefined} value
 * @param {number} [decimals]
 */
export function figure(value, decimals = 1) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  return number(value, decimals);
}

/**
 * A number to two significant digits that stays readable when tiny or huge: 0.43, 0.00012, 1.3 × 10⁶.
 * @param {number | null | undefined} value
 */
export function significant(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-5) return scientific(value);
  if (size >= 10) return figure(value, 0);
  if (size >= 1) return figure(value, 1);
  return value.toPrecision(2).replace("-", MINUS);
}

/**
 * "5.1 ± 0.4"; without an interval the number alone.
 * @param {number} mean
 * @param {number | null} standardError
 */
export function withError(mean, standardError) {
  return standardError ? `${figure(mean)} ± ${figure(standardError)}` : figure(mean);
}

/** "61 %"; a share below nothing has no meaning as a part. @param {number | null | undefined} share of 1 */
export function percent(share) {
  if (share === null || share === undefined || !Number.isFinite(share)) return "–";
  return share < 0 ? "below 0" : `${figure(100 * share, 0)} %`;
}

/**
 * "MEIRL", "MEIRL and IRLR", "MEIRL, IRLR and IRLF".
 * @param {string[]} names
 */
export function listed(names) {
  if (names.length < 2) return names.join("");
  return `${names.slice(0, -1).join(", ")} and ${names[names.length - 1]}`;
}

/** @param {number} value */
function scientific(value) {
  const [mantissa = "", exponent = ""] = value.toExponential(1).split("e");
  return `${mantissa.replace("-", MINUS)} × 10${superscript(Number(exponent))}`;
}

/** @param {number} exponent */
function superscript(exponent) {
  const digits = [...String(Math.abs(exponent))].map((digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]);
  return (exponent < 0 ? "⁻" : "") + digits.join("");
}
