/**
 * Simulated judges who answer the very questions of the rank page. Reads a line (JSON: {n, nJudges, kind, seed}), prints
 * one: for each judge the questions asked, Kendall's τ-b of the order against the judge's own, and the questions of plain
 * merge insertion on the same things; of all, how often the count of questions left was wrong, and the milliseconds of
 * CPU time until the next question.
 */

import { createInterface } from "node:readline";
import { mergeInsertion } from "#js/rankings/merge-insertion.js";
import { pairwise } from "#js/rankings/pairwise.js";

/** What a judge says of two worths, and by what chance. */
const KINDS = {
  consistent: ([a, b]) => truth(a, b),
  /** One answer in ten is another than the true one. */
  errs: ([a, b], random) => (random() < 0.1 ? other(truth(a, b), random) : truth(a, b)),
  /** One in thirty. */
  slips: ([a, b], random) => (random() < 1 / 30 ? other(truth(a, b), random) : truth(a, b)),
  /** Bradley and Terry's: errs on a quarter of the neighbours, hardly ever on what is far apart. */
  close: ([a, b], random) => (random() < 1 / (1 + Math.exp(-1.1 * (a - b))) ? "a" : "b"),
  /** Knows half as many grades as there are things, so that many are alike; errs one time in ten. */
  grades: ([a, b], random) => KINDS.errs([Math.floor(a / 2), Math.floor(b / 2)], random),
};

function judgeAll({ n, nJudges, kind, seed }) {
  const judges = Array.from({ length: nJudges }, (_, k) => judge(n, kind, chance(seed * 1_000_003 + k)));
  const column = (name) => judges.map((one) => one[name]);
  return {
    questions: column("questions"),
    tau: column("tau"),
    reference: column("reference"),
    nBrokenPromises: column("nBrokenPromises").reduce((sum, count) => sum + count, 0),
    ms: quantiles(column("ms").flat()),
  };
}

function judge(n, kind, random) {
  const ids = Array.from({ length: n }, (_, i) => `attempt ${i}`);
  const worth = new Map(shuffled(n, random).map((value, i) => [ids[i], value]));
  const said = (a, b) => KINDS[kind]([worth.get(a), worth.get(b)], random);
  const { answers, order, nBrokenPromises, ms } = ask(ids, said);
  const own = (id) => (kind === "grades" ? Math.floor(worth.get(id) / 2) : worth.get(id));
  const reference = countOf(mergeInsertion(ids), (a, b) => truth(own(a), own(b)));
  return { questions: answers.length, tau: tauB(order, own), reference, nBrokenPromises, ms };
}

function ask(ids, said) {
  const answers = [];
  const ms = [];
  let [nBrokenPromises, most] = [0, Number.POSITIVE_INFINITY];
  for (;;) {
    const began = process.cpuUsage();
    const { next, order, left } = pairwise(ids, answers);
    const { user, system } = process.cpuUsage(began);
    ms.push((user + system) / 1000);
    if (left.most >= most || left.least > left.most || (next ? left.least < 1 : left.most > 0)) nBrokenPromises += 1;
    if (!next) return { answers, order, nBrokenPromises, ms };
    most = left.most;
    answers.push({ a: next[0], b: next[1], said: said(...next) });
  }
}

function countOf(sort, said) {
  let count = 0;
  for (let step = sort.next(); !step.done; count += 1) step = sort.next(said(step.value.a, step.value.b));
  return count;
}

function truth(a, b) {
  return a === b ? "alike" : a > b ? "a" : "b";
}

/** A wrong answer: the other one; for two that are alike, either. */
function other(said, random) {
  if (said === "alike") return random() < 0.5 ? "a" : "b";
  return said === "a" ? "b" : "a";
}

function tauB(order, own) {
  const placed = order.flatMap((group, place) => group.map((id) => [own(id), place]));
  let [agreement, nOrdered, nWorthApart] = [0, 0, 0];
  for (const [k, [worth, place]] of placed.entries()) {
    for (const [otherWorth, otherPlace] of placed.slice(0, k)) {
      const [byWorth, byPlace] = [Math.sign(worth - otherWorth), Math.sign(otherPlace - place)];
      agreement += byWorth * byPlace;
      nOrdered += Math.abs(byPlace);
      nWorthApart += Math.abs(byWorth);
    }
  }
  return nOrdered && nWorthApart ? agreement / Math.sqrt(nOrdered * nWorthApart) : 0;
}

/** @param {number[]} values */
function quantiles(values) {
  const ordered = values.sort((a, b) => a - b);
  const at = (share) => ordered[Math.min(ordered.length - 1, Math.floor(share * ordered.length))];
  return { count: ordered.length, median: at(0.5), p99: at(0.99), most: at(1) };
}

function shuffled(n, random) {
  const values = Array.from({ length: n }, (_, i) => i);
  for (let i = n - 1; i > 0; i -= 1) {
    const j = Math.floor(random() * (i + 1));
    [values[i], values[j]] = [values[j], values[i]];
  }
  return values;
}

/** Numbers in [0, 1) that look like chance (Mulberry32). */
function chance(seed) {
  let state = Math.imul(seed, 0x9e3779b1) >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

for await (const line of createInterface({ input: process.stdin })) {
  process.stdout.write(`${JSON.stringify(judgeAll(JSON.parse(line)))}\n`);
}
