import assert from "node:assert/strict";
import test from "node:test";
import { comparisonSvg } from "#js/pictures/comparison.js";
import { comparisonData } from "#js/pictures/comparison-data.js";
import { captionOf, figureSentence } from "#js/pictures/comparison-words.js";
import { dotPlotSvg } from "#js/pictures/dot-plot.js";
import { stepsShown } from "#js/pictures/film.js";
import { lineChartSvg } from "#js/pictures/line-chart.js";
import { muxWebm } from "#js/pictures/webm-file.js";
import { makeWorld } from "./factories.js";
import { paper as theme } from "./paper.js";

const world = makeWorld([
  [-0.2, -3.5],
  [-0.4, 4],
]);
const entry = (who, title, mean_return, more = {}) => ({
  who,
  title,
  mean_return,
  standard_error: 0.3,
  expected_return: mean_return,
  greedy_return: mean_return,
  share_of_optimum: 0.9,
  place: 1,
  episodes: 50,
  ...more,
});
const walk = (total, states = [0, 2, 3]) => ({ states, total, reached_goal: states.at(-1) === 3 });
const learned = { reward: [[-1, -2], [0, 1]], policy: Array(4).fill([0, 0, 1, 0]) }; // biome-ignore format: as a board

/** The page data of a comparison. @param {string[]} learners */
function pageData(learners = ["meirl", "irlfr"]) {
  return {
    world,
    run: {
      id: "0123456789abcdef",
      seed: 11,
      learners: Object.fromEntries(learners.map((name) => [name, learned])),
      versions: { irlfr: "9.8.7", numpy: "2.4.6" },
    },
    comparison: {
      seed: 12,
      entries: [
        entry("optimal", "Optimum", 3.6, { standard_error: 0 }),
        ...learners.map((name, i) => entry(name, name.toUpperCase(), 3 - i, { place: i + 2 })),
        entry("human", "Human", 0.5, { place: 9, episodes: 3, expected_return: null, greedy_return: null }),
      ],
    },
    rollouts: {
      human: [walk(3.6), walk(0.4, [0, 1, 3]), walk(-2.5, [0, 1, 0])],
      optimal: [walk(3.6)],
      ...Object.fromEntries(learners.map((name) => [name, [walk(3.6), walk(0.5, [0, 1, 3])]])),
    },
  };
}
const drawn = (learners, episode = 0) =>
  comparisonData(pageData(learners), { unknownTo: () => [false, true, false, false], episode, citations: ["A 2008"] });
const wordsOf = (svg) => [...svg.matchAll(/>([^<>]+)<\/text>/g)].map(([, words]) => words).join(" ");

test("on the figure stand the person at their best and near their mean, every learner and the optimum", () => {
  const { walks, beliefs } = drawn();
  assert.deepEqual(
    walks.map(({ title, episode }) => [title, episode.total]),
    [
      ["Player, best attempt", 3.6],
      ["Player, mean attempt", 0.4],
      ["MEIRL", 3.6],
      ["IRLFR", 3.6],
      ["Optimum", 3.6],
    ],
  );
  assert.deepEqual(beliefs.map(({ who }) => who), ["meirl", "irlfr"]); // biome-ignore format: one thought
  assert.equal(drawn(undefined, 1).walks[2].episode.total, 0.5);
});

test("the figure is 183 mm wide and holds boards, plot, legend, seeds and caption", () => {
  const svg = comparisonSvg(drawn(), { theme });
  assert.match(svg, /^<svg [^>]*width="183mm"/);
  const words = wordsOf(svg);
  for (const part of [
    "MEIRL earned 3.0 ± 0.3 an episode, the player 0.5 ± 0.3 an attempt; the optimum is 3.6.",
    "Player, best attempt",
    "IRLFR",
    "Optimum",
    "2 steps, reaches the goal",
    "average return of an episode",
    "−1 to −7, hatched",
    "goal +4",
    "learned reward, each board on a scale of its own",
    "no attempt came here",
    "seed 1.",
    "Run 01234567 from 3 attempts, seed 11; episodes of at most 50 steps, seed 12; IRLFR 9.8.7 (NumPy 2.4.6).",
    "Methods: A 2008.",
  ]) {
    assert.ok(words.includes(part), `${part} in: ${words}`);
  }
  assert.doesNotMatch(svg, /NaN|undefined|Infinity|style=/);
});

test("any number of learners fits into the figure's width", () => {
  for (const count of [0, 1, 5, 12]) {
    const learners = Array.from({ length: count }, (_, i) => `learner-${i}`);
    const svg = comparisonSvg(drawn(learners), { theme });
    const places = [...svg.matchAll(/translate\(([\d.-]+)/g)].map(([, x]) => Number(x));
    assert.ok(Math.max(...places) < 692 && Math.min(...places) >= -0.5, `${count} learners`);
    assert.doesNotMatch(svg, /NaN|Infinity/);
  }
});

test("the caption claims no error where there is none and no intervals that the comparison lacks", () => {
  const data = drawn(["meirl"]);
  data.entries[1].standard_error = 0.001;
  assert.match(figureSentence(data), /^MEIRL earned 3\.0 an episode/);
  assert.match(captionOf(data)[0], /two standard errors to each side/);
  data.entries[1].interval_low = 2;
  assert.match(captionOf(data)[0], /95 % intervals/);
});

test("charts alone carry title, note, names and axes", () => {
  const dots = wordsOf(dotPlotSvg(pageData().comparison.entries, { title: "Returns", note: "50 episodes.", theme }));
  for (const part of ["Returns", "50 episodes.", "MEIRL", "Player", "optimum"]) assert.ok(dots.includes(part), part);
  const data = { iterations: [1, 10, 100], columns: [[4, 1, 0.02], [null, 2, 0]] }; // biome-ignore format: as a table
  const what = { learners: ["meirl", "irlfr"], measure: "gap", last: 100, title: "Convergence", theme };
  const lines = lineChartSvg(data, what);
  for (const part of ["Convergence", "IRLFR", "iteration", "gap to the play", "0.010"])
    assert.ok(wordsOf(lines).includes(part), part);
  assert.doesNotMatch(lines, /NaN|Infinity/); // a gap that vanished has no place on a logarithmic axis
});

test("a film shows every step of a short walk, and of a long one as many as it has room for, the last always", () => {
  assert.deepEqual(stepsShown(3), [0, 1, 2, 3]);
  assert.deepEqual(stepsShown(0), [0]);
  for (const longest of [98, 120, 121, 800, 1600]) {
    const steps = stepsShown(longest);
    assert.equal(steps[0], 0);
    assert.equal(steps.at(-1), longest);
    assert.ok(steps.length <= 121, `${longest} steps in ${steps.length} frames`);
  }
});

test("a WebM file says its length and size, and begins a cluster at each key frame", () => {
  const chunk = (milliseconds, isKey) => ({ bytes: new Uint8Array([7, 7]), milliseconds, isKey });
  const chunks = [chunk(0, true), chunk(250, false), chunk(500, true)];
  const file = Buffer.from(muxWebm(chunks, { width: 640, height: 360, milliseconds: 750 }));
  assert.equal(file.subarray(0, 4).toString("hex"), "1a45dfa3");
  const duration = file.indexOf(Buffer.from("4489", "hex"));
  assert.equal(file.readDoubleBE(duration + 10), 750);
  const segment = file.indexOf(Buffer.from("18538067", "hex"));
  assert.equal(Number(file.readBigUInt64BE(segment + 4) & 0xffffffffffffffn), file.length - segment - 12);
  const clusters = file.toString("latin1").split(Buffer.from("1f43b675", "hex").toString("latin1")).length - 1;
  assert.equal(clusters, 2);
});
