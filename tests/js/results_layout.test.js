import assert from "node:assert/strict";
import { test } from "node:test";
import { layOutPlaces, layOutShares, lines, nameWidth } from "#js/results/layout.js";

/** @param {string} who @param {number[]} counts @param {[number | null, number | null, number | null]} [share] */
function standing(who, counts, [value, low, high] = [0.5, 0.4, 0.6]) {
  const of = counts.reduce((sum, count) => sum + count, 0);
  const places = counts.map((count) => ({ count, of }));
  return { who, title: who.toUpperCase(), n_comparisons: of, places, share_of_optimum: { value, low, high } };
}

test("a bar is as long as the comparisons somebody took part in, and has a segment for each place they had", () => {
  const { left, n_places, rows } = layOutPlaces([standing("irlfr", [6, 0, 4]), standing("irlr", [1, 4])], 600);
  assert.equal(n_places, 3);
  const [all, half] = rows.map(({ segments }) => segments.reduce((sum, { width }) => sum + width, 0));
  assert.ok(Math.abs((all ?? 0) - (598 - left)) < 1e-9);
  assert.ok(Math.abs((half ?? 0) - (all ?? 0) / 2) < 1e-9);
  assert.deepEqual(
    rows[0]?.segments.map(({ place, count }) => [place, count]),
    [
      [1, 6],
      [3, 4],
    ],
  );
  assert.equal(rows[0]?.segments[0]?.x, left);
});

test("a segment too narrow for its figure goes without", () => {
  const [row] = layOutPlaces([standing("irlfr", [200, 1])], 400).rows;
  assert.deepEqual(
    row?.segments.map(({ hasRoom }) => hasRoom),
    [true, false],
  );
});

test("nothing and the optimum are always on the axis of shares, and far below is cut off", () => {
  const shares = [standing("irlfr", [1], [0.3, null, null]), standing("human", [1], [-4, -6, -2])];
  const { left, right, zero, optimum, rows } = layOutShares(shares, 500);
  assert.ok(left < zero && zero < optimum && optimum === right);
  assert.deepEqual(
    rows.map(({ isOffScale, interval }) => [isOffScale, interval]),
    [
      [false, null],
      [true, [left, left]],
    ],
  );
  assert.equal(layOutShares([standing("irlfr", [1], [null, null, null])], 500).rows[0]?.x, null);
});

test("a long name takes two lines rather than the bars' room", () => {
  const width = nameWidth([standing("behavioural cloning", [1])], 300);
  assert.equal(width, 126);
  assert.deepEqual(lines("Behavioural cloning", width), ["Behavioural", "cloning"]);
  assert.deepEqual(lines("IRLFR", width), ["IRLFR"]);
});
