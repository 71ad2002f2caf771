/** Children brought into an order by the fewest moves: whatever is moved may lose its focus and is painted anew. */

/** Others that the parent still has stay where they are. @param {Element} parent @param {readonly Element[]} wanted */
export function arrange(parent, wanted) {
  const places = new Map([...parent.children].map((child, i) => [child, i]));
  const stays = new Set(longestRising(wanted.map((one) => places.get(one) ?? -1)));
  let next = /** @type {Element | null} */ (null);
  for (const [i, one] of [...wanted.entries()].reverse()) {
    if (!stays.has(i)) moveBefore(parent, one, next);
    next = one;
  }
}

/** Indices of a longest rising run of the numbers, those below 0 left out. @param {readonly number[]} numbers @returns {number[]} */
export function longestRising(numbers) {
  /** @type {number[][]} */
  const runs = [];
  for (const [i, value] of numbers.entries()) {
    const before = runs.filter((run, j) => run.length > 0 && numbers[j] < value);
    runs.push(value < 0 ? [] : [...longest(before), i]);
  }
  return longest(runs);
}

/** @param {number[][]} runs @returns {number[]} */
function longest(runs) {
  return runs.reduce((best, run) => (run.length > best.length ? run : best), []);
}

/** Where the browser can, without taking it out: its focus and its scrolling stay. @param {Element} parent @param {Element} child @param {Element | null} next */
function moveBefore(parent, child, next) {
  const able = /** @type {Element & {moveBefore?: (node: Node, next: Node | null) => void}} */ (parent);
  if (able.moveBefore && child.isConnected && parent.isConnected) able.moveBefore(child, next);
  else parent.insertBefore(child, next);
}
