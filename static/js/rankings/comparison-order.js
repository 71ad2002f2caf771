/**
 * The order that answers about pairs come to: the twin of `irl_core/preferences/comparisons.py`, which holds the
 * mathematics and the sources; `tests/core/comparison_vectors.json` holds both to the same results.
 */

/** @typedef {import("#js/rankings/sitting-state.js").Answer} Answer */

/** How far apart, in units of the logistic scale, things are before anything was said. */
const PRIOR_SD = 2;
/** Newton's method needs six or so. */
const MOST_ROUNDS = 50;
/** A longer step would overshoot. */
const LONGEST_STEP = 3;
/** Strengths nearer than this are the same. */
const RESOLUTION = 1e-6;

/**
 * What was said of n things, by their numbers.
 * @typedef {object} Evidence
 * @property {readonly string[]} ids
 * @property {number[][]} wins      how often i was put above j
 * @property {number[][]} alike     how often they were called alike
 * @property {Uint8Array[]} isAbove i stands above j, or beside it, by some chain of answers
 */

/** @param {readonly string[]} ids @param {readonly Answer[]} answers @returns {Evidence} */
export function evidenceOf(ids, answers) {
  const number = new Map(ids.map((id, i) => [id, i]));
  const table = () => ids.map(() => ids.map(() => 0));
  const [wins, alike] = [table(), table()];
  for (const { a, b, said } of answers) {
    const [i, j] = [number.get(a), number.get(b)];
    if (i === undefined || j === undefined) continue;
    if (said === "a") row(wins, i)[j] = at(wins, i, j) + 1;
    else if (said === "b") row(wins, j)[i] = at(wins, j, i) + 1;
    else
      for (const [x, y] of /** @type {const} */ ([
        [i, j],
        [j, i],
      ]))
        row(alike, x)[y] = at(alike, x, y) + 1;
  }
  return { ids, wins, alike, isAbove: closureOf(wins, alike) };
}

/** Whether the answers, taken together, put something above itself. @param {Evidence} evidence */
export function isContradictory({ ids, wins, isAbove }) {
  return ids.some((_, i) => ids.some((_, j) => at(wins, i, j) > 0 && isAbove[j]?.[i] === 1));
}

/** @param {Evidence} evidence @param {{means: number[]}} strengths @returns {number[][]} groups of numbers, the top first */
export function orderOf(evidence, { means }) {
  const { wins } = evidence;
  const strength = means.map((x) => Math.floor(x / RESOLUTION + 0.5));
  return componentsOf(evidence, strength).flatMap((component) => {
    const isAtOdds = component.some((i) => component.some((j) => at(wins, i, j) > 0));
    if (!isAtOdds || component.every((i) => strength[i] === strength[Number(component[0])])) return [component];
    return tied(evidence, strength, leastContradicted(wins, byStrength(component, strength)));
  });
}

/**
 * Bradley and Terry's strengths: the mode of their posterior, by Newton's method.
 * @param {Evidence} evidence @returns {{means: number[], factor: number[][]}} factor: the Cholesky factor of the curvature there
 */
export function strengthsOf({ ids, wins, alike }) {
  /** @type {number[]} */
  let means = ids.map(() => 0);
  for (let round = 1; ; round += 1) {
    const { slope, curvature } = slopeAt(means, wins, alike);
    const factor = factorOf(curvature);
    const step = solve(factor, slope);
    const largest = step.reduce((most, d) => Math.max(most, Math.abs(d)), 0);
    if (largest < 1e-9 || round === MOST_ROUNDS) return { means, factor };
    const scale = largest > LONGEST_STEP ? LONGEST_STEP / largest : 1;
    means = means.map((x, i) => x + scale * Number(step[i]));
  }
}

/** The variance of the difference of any two strengths (Laplace): of i and j, at [i][j] for j < i. @param {number[][]} factor @returns {number[][]} */
export function variancesOf(factor) {
  const covariance = factor.map((_, i) =>
    solve(
      factor,
      factor.map((_, j) => Number(i === j)),
    ),
  );
  return factor.map((_, i) =>
    factor.slice(0, i).map((_, j) => at(covariance, i, i) + at(covariance, j, j) - 2 * at(covariance, i, j)),
  );
}

/** Of the log posterior: its gradient, and minus its second derivatives. @param {number[]} x @param {number[][]} wins @param {number[][]} alike */
function slopeAt(x, wins, alike) {
  const n = x.length;
  const precision = 1 / (PRIOR_SD * PRIOR_SD);
  const slope = x.map((value) => -precision * value);
  const curvature = x.map((_, i) => x.map((_, j) => (i === j ? precision : 0)));
  for (let i = 0; i < n; i += 1) {
    for (let j = 0; j < i; j += 1) {
      const count = at(wins, i, j) + at(wins, j, i) + at(alike, i, j);
      if (count === 0) continue;
      const chance = 1 / (1 + Math.exp(Number(x[j]) - Number(x[i])));
      const surprise = at(wins, i, j) + at(alike, i, j) / 2 - count * chance;
      slope[i] = Number(slope[i]) + surprise;
      slope[j] = Number(slope[j]) - surprise;
      const weight = count * chance * (1 - chance);
      row(curvature, i)[i] = at(curvature, i, i) + weight;
      row(curvature, j)[j] = at(curvature, j, j) + weight;
      row(curvature, i)[j] = -weight;
    }
  }
  return { slope, curvature };
}

/** L with L Lᵀ = the matrix, of which the lower half is read (Cholesky). @param {number[][]} matrix */
function factorOf(matrix) {
  const factor = matrix.map((line) => line.map(() => 0));
  for (let i = 0; i < matrix.length; i += 1) {
    const line = row(factor, i);
    for (let j = 0; j <= i; j += 1) {
      const other = row(factor, j);
      let rest = at(matrix, i, j);
      for (let k = 0; k < j; k += 1) rest -= Number(line[k]) * Number(other[k]);
      line[j] = i === j ? Math.sqrt(rest) : rest / Number(other[j]);
    }
  }
  return factor;
}

/** x with L Lᵀ x = b. @param {number[][]} factor @param {number[]} b */
function solve(factor, b) {
  const x = [...b];
  for (let i = 0; i < x.length; i += 1) {
    for (let k = 0; k < i; k += 1) x[i] = Number(x[i]) - at(factor, i, k) * Number(x[k]);
    x[i] = Number(x[i]) / at(factor, i, i);
  }
  for (let i = x.length - 1; i >= 0; i -= 1) {
    for (let k = i + 1; k < x.length; k += 1) x[i] = Number(x[i]) - at(factor, k, i) * Number(x[k]);
    x[i] = Number(x[i]) / at(factor, i, i);
  }
  return x;
}

/** @param {number[][]} wins @param {number[][]} alike */
function closureOf(wins, alike) {
  const n = wins.length;
  const isAbove = wins.map((line, i) => Uint8Array.from(line, (count, j) => (count + at(alike, i, j) > 0 ? 1 : 0)));
  for (let k = 0; k < n; k += 1) {
    const onward = /** @type {Uint8Array} */ (isAbove[k]);
    for (const line of isAbove) {
      if (line[k]) for (let j = 0; j < n; j += 1) if (onward[j]) line[j] = 1;
    }
  }
  return isAbove;
}

/** Things that stand above each other, together; the rest alone; each below what stands above it, otherwise the stronger first. @param {Evidence} evidence @param {number[]} strength @returns {number[][]} */
function componentsOf({ ids, isAbove }, strength) {
  let left = byStrength([...ids.keys()], strength);
  /** @type {number[][]} */
  const components = [];
  while (left.length > 0) {
    const isFirst = (/** @type {number} */ i) => left.every((j) => !isAbove[j]?.[i] || isAbove[i]?.[j]);
    const first = /** @type {number} */ (left.find(isFirst));
    const component = left.filter((j) => j === first || (isAbove[first]?.[j] && isAbove[j]?.[first]));
    components.push(component.sort((i, j) => i - j));
    left = left.filter((j) => !component.includes(j));
  }
  return components;
}

/** @param {number[]} numbers @param {number[]} strength */
function byStrength(numbers, strength) {
  return numbers.toSorted((i, j) => Number(strength[j]) - Number(strength[i]) || i - j);
}

/** One thing after another is put where it contradicts the fewest answers, until no move is left that helps. @param {number[][]} wins @param {number[]} order */
function leastContradicted(wins, order) {
  const line = [...order];
  for (let hasMoved = true; hasMoved; ) {
    hasMoved = false;
    for (let place = 0; place < line.length; place += 1) {
      const to = bestPlace(wins, line, place);
      if (to === place) continue;
      line.splice(to, 0, ...line.splice(place, 1));
      hasMoved = true;
    }
  }
  return line;
}

/** The nearest of those where most contradictions end; where it stands if none do. @param {number[][]} wins @param {number[]} line @param {number} place */
function bestPlace(wins, line, place) {
  const one = /** @type {number} */ (line[place]);
  let [best, fewest] = [place, 0];
  for (const step of [-1, 1]) {
    let more = 0;
    for (let to = place + step; to >= 0 && to < line.length; to += step) {
      const other = /** @type {number} */ (line[to]);
      more -= step * (at(wins, other, one) - at(wins, one, other));
      if (more < fewest) [best, fewest] = [to, more];
    }
  }
  return best;
}

/** Neighbours tie where they were called alike as often as apart, or where nothing tells them apart. @param {Evidence} evidence @param {number[]} strength @param {number[]} line @returns {number[][]} */
function tied({ wins, alike }, strength, line) {
  /** @type {number[][]} */
  const groups = [];
  for (const i of line) {
    const above = groups.at(-1)?.at(-1);
    const isTie = (/** @type {number} */ j) => {
      const [upper, lower] = [at(wins, j, i), at(wins, i, j)];
      const isOpen = strength[i] === strength[j] && upper === lower;
      return isOpen || (at(alike, i, j) > 0 && at(alike, i, j) >= upper + lower);
    };
    if (above !== undefined && isTie(above)) groups.at(-1)?.push(i);
    else groups.push([i]);
  }
  return groups.map((group) => group.sort((i, j) => i - j));
}

/** @param {number[][]} table @param {number} i @param {number} j */
function at(table, i, j) {
  return Number(table[i]?.[j]);
}

/** @param {number[][]} table @param {number} i */
function row(table, i) {
  return /** @type {number[]} */ (table[i]);
}
