import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { layOutDotPlot } from "#js/charts/dot-plot-layout.js";
import { figure, listed, percent, significant, withError } from "#js/charts/figures.js";
import { decades, linearScale, roundDomain, ticks } from "#js/charts/scales.js";

test("figures have a true minus, no minus zero, and a dash where there is none", () => {
  assert.equal(figure(-3.44), "−3.4");
  assert.equal(figure(-0.04), "0.0");
  assert.equal(figure(null), "–");
  assert.equal(figure(Number.NaN), "–");
});

test("significant figures stay readable at any size", () => {
  assert.deepEqual([0.4321, 0.00012, 4.26, 123.4, 2.5e6, 0].map(significant), [
    "0.43",
    "0.00012",
    "4.3",
    "123",
    "2.5 × 10⁶",
    "0",
  ]);
});

test("intervals, shares and lists", () => {
  assert.equal(withError(5.1, 0.42), "5.1 ± 0.4");
  assert.equal(withError(5.1, 0), "5.1");
  assert.equal(percent(0.614), "61 %");
  assert.equal(percent(-3.7), "below 0");
  assert.equal(listed(["a", "b", "c"]), "a, b and c");
});

test("ticks are round and inside", () => {
  assert.deepEqual(ticks(-1, 1, 4), [-1, -0.5, 0, 0.5, 1]);
  assert.deepEqual(ticks(0, 0.3, 3), [0, 0.1, 0.2, 0.3]);
});

test("a round domain holds every value with room to spare", () => {
  const [low, high] = roundDomain([-3.2, 7.7]);
  assert.ok(low < -3.2 && high > 7.7);
  assert.deepEqual(roundDomain([]), [0, 1]);
});

test("decades surround the positive values", () => {
  assert.deepEqual(decades([0.04, 4.9, null, 0]), [0.01, 10]);
  assert.deepEqual(decades([1, 1]), [1, 10]);
});

test("a linear scale maps ends to ends", () => {
  const x = linearScale([-1, 1], [100, 200]);
  assert.deepEqual([x(-1), x(0), x(1)], [100, 150, 200]);
});

const entry = (who, mean_return, standard_error, expected_return) => ({
  who,
  title: who,
  mean_return,
  standard_error,
  expected_return,
  greedy_return: expected_return,
  share_of_optimum: null,
  place: 1,
  episodes: 50,
});

test("the dot plot keeps everything inside, with zero and the optimum", () => {
  const layout = layOutDotPlot(
    [entry("optimal", 7.7, 0, 7.7), entry("irlr", 5, 0.5, 5.1), entry("human", -4, 2, null)],
    500,
  );
  assert.ok(layout.zero !== null && layout.optimum !== null && layout.zero < layout.optimum);
  for (const row of layout.rows) assert.ok(row.mean >= layout.left && row.mean <= layout.right);
  assert.deepEqual(layout.rows[2]?.expected, null);
  assert.equal(layout.rows[0]?.interval, null);
});

test("one endless loss does not press the others into a point", () => {
  const layout = layOutDotPlot([entry("irlr", 5, 0.5, 5.1), entry("human", -400, 90, null)], 500);
  assert.equal(layout.rows[1]?.isOffScale, true);
  assert.equal(layout.rows[0]?.isOffScale, false);
});

test("the learn page links the stylesheet of the uPlot that is installed", () => {
  const { dependencies } = JSON.parse(readFileSync(new URL("../../package.json", import.meta.url), "utf8"));
  const page = readFileSync(new URL("../../templates/learning/learn.html", import.meta.url), "utf8");
  assert.ok(page.includes(`vendor/uplot@${dependencies.uplot}/dist/uPlot.min.css`));
});
