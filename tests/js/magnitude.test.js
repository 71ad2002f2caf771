import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { gapsBetween, positionsFromGaps, saidGaps, scaleOf } from "#js/rankings/magnitude.js";

const VECTORS = JSON.parse(readFileSync(new URL("../core/gap_and_stretch_vectors.json", import.meta.url), "utf8"));
const ABC = [["a"], ["b"], ["c"]];

for (const { what, order, gaps, said, positions } of VECTORS.gaps) {
  test(`as in Python: ${what}`, () => {
    assert.deepEqual(saidGaps(order, gaps), said);
    assert.deepEqual(positionsFromGaps(order, gaps), positions);
  });
}

test("all that was said between two groups is found, whoever of them it named", () => {
  const [ac, bc, cd] = [
    { above: "a", below: "c", value: 1 },
    { above: "b", below: "c", value: 2 },
    { above: "c", below: "d", value: 3 },
  ];
  assert.deepEqual(gapsBetween([ac, bc, cd], ["b", "a"], ["c"]), [ac, bc]);
  assert.deepEqual(gapsBetween([ac, bc, cd], ["c"], ["a"]), []);
});

test("on the scale the groups stand as far apart as was said", () => {
  const gaps = [
    { above: "a", below: "b", value: 75 },
    { above: "b", below: "c", value: 25 },
  ];
  const { stops, spans } = scaleOf(ABC, gaps);
  assert.deepEqual(
    stops.map(({ at }) => at),
    [0, 75, 100],
  );
  assert.deepEqual(
    spans.map(({ from, to, value }) => [from, to, value]),
    [
      [0, 75, 75],
      [75, 100, 25],
    ],
  );
});

test("what was not said has its room on the scale and no value", () => {
  const { stops, spans } = scaleOf(ABC, [{ above: "a", below: "b", value: 100 }]);
  assert.ok(Math.abs((stops[1]?.at ?? 0) - 200 / 3) < 1e-9);
  assert.equal(spans[1]?.value, null);
});

test("a tie is one stop on the scale, with the place it shares", () => {
  const { stops } = scaleOf([["a", "b"], ["c"]], []);
  assert.deepEqual(
    stops.map(({ rank, n }) => [rank, n]),
    [
      [1, 2],
      [3, 1],
    ],
  );
});

test("figures on the scale never touch, and both ends have theirs", () => {
  const order = Array.from({ length: 40 }, (_, i) => [`${i}`]);
  const gaps = order.slice(1).map(([below], i) => ({ above: `${i}`, below: below ?? "", value: 1 + ((i * 37) % 100) }));
  const labelled = scaleOf(order, gaps).stops.filter(({ isLabelled }) => isLabelled);
  assert.deepEqual([labelled[0]?.rank, labelled.at(-1)?.rank], [1, 40]);
  for (const [i, { at }] of labelled.entries()) if (i > 0) assert.ok(at - (labelled[i - 1]?.at ?? 0) >= 7);
});
