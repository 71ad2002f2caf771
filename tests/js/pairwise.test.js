import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { mergeInsertion } from "#js/rankings/merge-insertion.js";
import { leftWords, questionOf, saidWords } from "#js/rankings/pair-words.js";
import { pairwise } from "#js/rankings/pairwise.js";

const VECTORS = JSON.parse(readFileSync(new URL("../core/comparison_vectors.json", import.meta.url), "utf8"));

describe("the order that answers come to", () => {
  for (const { name, ids, answers, order } of VECTORS) {
    it(`is the same as in Python: ${name}`, () => {
      const told = answers.map(([a, b, said]) => ({ a, b, said }));
      assert.deepEqual(pairwise(ids, told).order, order);
    });
  }
});

describe("merge insertion", () => {
  for (const [n, mean, most] of [
    [3, 8 / 3, 3],
    [4, 14 / 3, 5],
    [5, 104 / 15, 7],
    [6, 9.6, 10],
    [7, 12 + 16 / 35, 13],
  ]) {
    it(`sorts every order of ${n} with as many comparisons as are known of it`, () => {
      const counts = permutations(n).map((worth) => sort(worth).nQuestions);
      assert.equal(Math.max(...counts), most);
      assert.ok(Math.abs(counts.reduce((sum, count) => sum + count, 0) / counts.length - mean) < 1e-12);
    });
  }

  it("finds every order of five with ties, too, and never asks more for them", () => {
    for (const worth of grades(5)) {
      const { order, nQuestions } = sort(worth);
      assert.deepEqual(
        order.map((group) => group.map(Number).sort()),
        groupsOf(worth),
      );
      assert.ok(nQuestions <= 7);
    }
  });
});

describe("two at a time", () => {
  for (const n of [1, 2, 3, 5, 6, 7, 12, 20, 40]) {
    it(`settles ${n} things as a consistent judge means them, ties included`, () => {
      for (let seed = 0; seed < (n > 12 ? 3 : 20); seed += 1) {
        const random = chance(seed);
        const worth = Array.from({ length: n }, () => Math.floor(random() * n * (1 + (seed % 3))));
        const { order } = ask(worth, () => null);
        assert.deepEqual(
          order.map((group) => group.map(Number).sort((a, b) => a - b)),
          groupsOf(worth),
        );
      }
    });
  }

  it("never asks more than it said, whoever answers, and comes to an order of all", () => {
    for (let seed = 0; seed < 200; seed += 1) {
      const random = chance(seed);
      const n = 1 + Math.floor(random() * 13);
      const worth = Array.from({ length: n }, () => Math.floor(random() * n));
      const { order } = ask(worth, () => (random() < 0.4 ? ["a", "b", "alike"][Math.floor(random() * 3)] : null));
      assert.deepEqual(order.flat().sort(), worth.map((_, i) => String(i)).sort());
    }
  });

  it("asks the same again when an answer is taken back", () => {
    const ids = idsOf(9);
    const answers = [];
    const asked = [];
    for (;;) {
      const { next } = pairwise(ids, answers);
      asked.push(next);
      if (!next) break;
      answers.push({ a: next[0], b: next[1], said: next[0] > next[1] ? "a" : "b" });
    }
    while (answers.length > 0) {
      answers.pop();
      asked.pop();
      assert.deepEqual(pairwise(ids, answers).next, asked.at(-1));
    }
  });

  it("goes on asking when an answer contradicts the others, and says so", () => {
    const worth = [5, 3, 8, 1, 9, 2, 7, 4];
    let nAsked = 0;
    const { standing, contradicted } = ask(worth, () => {
      nAsked += 1;
      return nAsked === 17 ? "wrong" : null;
    });
    assert.ok(contradicted.includes(true));
    assert.ok(standing.left.most === 0);
  });

  it("uses what was said when a card is gone or another has come", () => {
    const worth = [4, 0, 5, 2, 1, 3];
    const { answers } = ask(worth, () => null);
    const without = ask(
      worth.slice(0, 5),
      () => null,
      answers.filter(({ a, b }) => a !== "5" && b !== "5"),
    );
    assert.deepEqual(without.order, [["2"], ["0"], ["3"], ["4"], ["1"]]);
    assert.ok(without.nAsked <= 2, String(without.nAsked));
    const more = ask([...worth, 2.5], () => null, answers);
    assert.ok(more.nAsked <= 5, String(more.nAsked));
    assert.deepEqual(more.order.flat(), ["2", "0", "5", "6", "3", "4", "1"]);
  });

  it("shows neither card of a pair always on the same side", () => {
    const left = new Map();
    for (let seed = 0; seed < 60; seed += 1) {
      const random = chance(seed);
      const ids = idsOf(8).map((id) => `${id}-${Math.floor(random() * 1e9)}`);
      const { next } = pairwise(ids, []);
      left.set(next[0] === ids[0], (left.get(next[0] === ids[0]) ?? 0) + 1);
    }
    assert.ok(left.get(true) > 15 && left.get(false) > 15);
  });
});

describe("the words of a question", () => {
  it("say how many are left, and at most", () => {
    const words = (least, most, isContradictory = false) => leftWords({ left: { least, most }, isContradictory });
    assert.equal(words(7, 9), "About 7 questions left (at most 9)");
    assert.equal(words(1, 2), "About 1 question left (at most 2)");
    assert.equal(words(1, 1), "1 question left");
    assert.equal(words(1, 6, true), "Some of your answers do not fit together yet: at most 6 more questions.");
  });

  it("ask for the better success and the worse failure", () => {
    assert.equal(questionOf("success"), "Which one is better?");
    assert.equal(questionOf("failure"), "Which one is worse?");
    assert.equal(saidWords("a", "failure"), "The left one is worse.");
    assert.equal(saidWords("alike", "success"), "They are alike.");
  });
});

/** Ask until nothing is left to ask, holding the count of questions left to its word. */
function ask(worth, slip, before = []) {
  const ids = idsOf(worth.length);
  const answers = [...before];
  const contradicted = [];
  for (let most = Number.POSITIVE_INFINITY; ; ) {
    const standing = pairwise(ids, answers);
    const { next, order, left, phase, isContradictory } = standing;
    assert.ok(left.most < most && left.least <= left.most, JSON.stringify(left));
    assert.equal(next === null, phase === "done");
    contradicted.push(isContradictory);
    if (!next) return { order, answers, contradicted, standing, nAsked: answers.length - before.length };
    assert.ok(left.least >= 1);
    most = left.most;
    const [a, b] = next;
    const said = saidOf(worth[a], worth[b]);
    const slipped = slip();
    answers.push({ a, b, said: slipped === "wrong" ? (said === "a" ? "b" : "a") : (slipped ?? said) });
  }
}

function sort(worth) {
  const asking = mergeInsertion(idsOf(worth.length));
  let nQuestions = 0;
  let step = asking.next();
  for (; !step.done; nQuestions += 1) step = asking.next(saidOf(worth[step.value.a], worth[step.value.b]));
  return { order: step.value, nQuestions };
}

function saidOf(a, b) {
  return a === b ? "alike" : a > b ? "a" : "b";
}

function idsOf(n) {
  return Array.from({ length: n }, (_, i) => String(i));
}

function groupsOf(worth) {
  const values = [...new Set(worth)].sort((a, b) => b - a);
  return values.map((value) => [...worth.keys()].filter((i) => worth[i] === value));
}

function permutations(n) {
  if (n === 0) return [[]];
  return permutations(n - 1).flatMap((rest) => idsOf(n).map((_, i) => rest.toSpliced(i, 0, n)));
}

function grades(n) {
  if (n === 0) return [[]];
  return grades(n - 1).flatMap((rest) => [0, 1, 2, 3, 4].map((grade) => [...rest, grade]));
}

function chance(seed) {
  let state = (seed * 2654435761) >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}
