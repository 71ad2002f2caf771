/** The arithmetic of axes: where a number lies and where the ticks stand. */

/**
 * A straight line from `domain` to `range`.
 * @param {readonly [number, number]} domain
 * @param {readonly [number, number]} range
 * @returns {(value: number) => number}
 */
export function linearScale([low, high], [from, to]) {
  const width = high - low || 1;
  return (value) => from + ((value - low) / width) * (to - from);
}

/**
 * Round numbers (1, 2 or 5 times a power of ten) inside [low, high], about `count` of them.
 * @param {number} low
 * @param {number} high
 * @param {number} [count]
 */
export function ticks(low, high, count = 5) {
  const step = roundStep((high - low) / Math.max(1, count));
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => tidy((first + i) * step, step));
}

/**
 * The smallest round interval that holds all values, with room at both ends so that no mark touches the edge.
 * @param {number[]} values
 * @returns {[number, number]}
 */
export function roundDomain(values) {
  const finite = values.filter(Number.isFinite);
  if (finite.length === 0) return [0, 1];
  const low = Math.min(...finite);
  const high = Math.max(...finite);
  const margin = (high - low || Math.abs(high) || 1) * 0.06;
  const step = roundStep((high - low + 2 * margin) / 6);
  return [tidy(Math.floor((low - margin) / step) * step, step), tidy(Math.ceil((high + margin) / step) * step, step)];
}

/**
 * Whole powers of ten around the positive values: the ends of a logarithmic axis.
 * @param {Iterable<number | null | undefined>} values
 * @returns {[number, number]}
 */
export function decades(values) {
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  for (const value of values) {
    if (value === null || value === undefined || !(value > 0) || !Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (low > high) return [0.01, 10];
  const bottom = Math.floor(Math.log10(low) + 1e-9);
  const top = Math.max(bottom + 1, Math.ceil(Math.log10(high) - 1e-9));
  return [10 ** bottom, 10 ** top];
}

/** @param {number} raw */
function roundStep(raw) {
  if (!(raw > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  const factor = [1, 2, 5, 10].find((candidate) => raw <= candidate * power * (1 + 1e-9)) ?? 10;
  return factor * power;
}

/**
 * Takes off the dust of binary fractions: 0.30000000000000004 with steps of 0.1 is 0.3.
 * @param {number} value
 * @param {number} step
 */
function tidy(value, step) {
  const decimals = Math.max(0, -Math.floor(Math.log10(step)));
  return Number(value.toFixed(Math.min(20, decimals))) + 0;
}
