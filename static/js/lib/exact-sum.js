/**
 * The sum of numbers, rounded once, at the end: the same, bit for bit, as Python's `math.fsum`, in any order of the numbers.
 *
 * The partial sums are numbers of which no two overlap, smallest first; together they are the exact sum so far. Adding a
 * number to each in turn splits every addition into the rounded sum and what rounding lost (Knuth's two-sum, ordered by
 * size as Dekker has it). Source: Shewchuk (1997), "Adaptive precision floating-point arithmetic and fast robust geometric
 * predicates", section 2.
 */

/** @param {readonly number[]} numbers finite, and so is their sum */
export function exactSum(numbers) {
  /** @type {number[]} */
  const partials = [];
  for (const number of numbers) add(partials, number);
  return rounded(partials);
}

/** Written with indices: it runs for every step of an attempt at every press. @param {number[]} partials @param {number} number */
function add(partials, number) {
  let sum = number;
  let n = 0;
  for (let i = 0; i < partials.length; i++) {
    const partial = partials[i] ?? 0;
    const before = sum;
    sum = before + partial;
    const lost = Math.abs(before) < Math.abs(partial) ? before - (sum - partial) : partial - (sum - before);
    if (lost !== 0) partials[n++] = lost;
  }
  partials.length = n;
  if (sum !== 0) partials.push(sum);
}

/** The number nearest to the sum of all partials; of two equally near, the even one. @param {number[]} partials */
function rounded(partials) {
  let i = partials.length - 1;
  let sum = partials[i] ?? 0;
  let lost = 0;
  while (lost === 0 && --i >= 0) {
    const before = sum;
    const partial = partials[i] ?? 0;
    sum = before + partial;
    lost = partial - (sum - before);
  }
  // Exactly half a unit was lost, and what lies below says that it was more: the half was rounded the wrong way.
  const below = partials[i - 1] ?? 0;
  const corrected = sum + 2 * lost;
  return Math.sign(below) * Math.sign(lost) > 0 && 2 * lost === corrected - sum ? corrected : sum;
}
