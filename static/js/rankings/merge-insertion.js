/**
 * Merge insertion (L. R. Ford and S. M. Johnson, "A tournament problem", 1959), which sorts a dozen things in as few
 * comparisons as any known way, or nearly so. It asks by yielding and hears by `next(said)`, so that a person, a log of
 * answers or a test can be the judge.
 *
 * Compare in pairs; sort the upper ones; insert the lower ones below their partners, in the order in which each
 * insertion meets 2^k − 1 others at most (1, 3, 5, 11, 21, 43, …: no half of a search is ever wasted). What is said to be
 * alike is one thing from then on, a group, which only ever saves questions.
 */

/** @typedef {"a" | "b" | "alike"} Said */
/** @typedef {{a: string, b: string, shorter: "a" | "b"}} Question   `shorter`: the answer after which fewer questions are left */
/** @typedef {string[]} Group   grows where it stands when something proves to be alike */

/** The groups from top to bottom. @param {readonly string[]} ids @returns {Generator<Question, Group[], Said>} */
export function* mergeInsertion(ids) {
  const rising = yield* sort(ids.map((id) => [id]));
  return rising.reverse();
}

/** @param {Group[]} groups @returns {Generator<Question, Group[], Said>} from the lowest */
function* sort(groups) {
  if (groups.length < 2) return groups;
  /** @type {Group[]} */
  const uppers = [];
  /** @type {Map<string | undefined, Group>} the lower of a pair, by an id of the upper */
  const lowers = new Map();
  for (let i = 0; i + 1 < groups.length; i += 2) {
    const [x, y] = [/** @type {Group} */ (groups[i]), /** @type {Group} */ (groups[i + 1])];
    const said = yield ask(x, y, "a");
    uppers.push(said === "alike" ? [...x, ...y] : said === "a" ? x : y);
    if (said !== "alike") lowers.set((said === "a" ? x : y)[0], said === "a" ? y : x);
  }
  const chain = yield* sort(uppers);
  return yield* insertAll(chain, lowers, groups.length % 2 === 1 ? (groups.at(-1) ?? null) : null);
}

/** @param {Group[]} chain the upper ones, rising @param {Map<string | undefined, Group>} lowers @param {Group | null} odd the one without a partner @returns {Generator<Question, Group[], Said>} */
function* insertAll(chain, lowers, odd) {
  const uppers = [...chain];
  // Upper ones that proved to be alike have several below them.
  const waiting = uppers.map((upper) => upper.flatMap((id) => [lowers.get(id)].filter((lower) => lower !== undefined)));
  const free = waiting[0]?.shift();
  if (free) chain.unshift(free);
  for (const i of turns(uppers.length + 1)) {
    const upper = uppers[i];
    for (const lower of waiting[i] ?? []) yield* insert(chain, lower, upper ? chain.indexOf(upper) : chain.length);
    if (!upper && odd) yield* insert(chain, odd, chain.length);
  }
  return chain;
}

/** Somewhere below the place `high`. @param {Group[]} chain @param {Group} group @param {number} high @returns {Generator<Question, void, Said>} */
function* insert(chain, group, high) {
  let low = 0;
  while (low < high) {
    const middle = Math.floor((low + high) / 2);
    const other = /** @type {Group} */ (chain[middle]);
    const said = yield ask(group, other, high - middle <= middle - low + 1 ? "a" : "b");
    if (said === "alike") {
      other.push(...group);
      return;
    }
    if (said === "a") low = middle + 1;
    else high = middle;
  }
  chain.splice(low, 0, group);
}

/** 0; 2, 1; 4, 3; 10 … 5; 20 … 11; …: each stretch downwards, cut off at n. @param {number} n */
function turns(n) {
  /** @type {number[]} */
  const order = [];
  for (let [before, end] = [0, 1]; before < n; [before, end] = [end, end + 2 * before]) {
    for (let i = Math.min(end, n) - 1; i >= before; i -= 1) order.push(i);
  }
  return order;
}

/** @param {Group} a @param {Group} b @param {"a" | "b"} shorter @returns {Question} */
function ask([a = ""], [b = ""], shorter) {
  return { a, b, shorter };
}
