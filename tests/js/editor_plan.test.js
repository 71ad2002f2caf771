import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { brushAt, paint, Stroke, TOOLS } from "#js/worlds/editor/brushes.js";
import { History } from "#js/worlds/editor/history.js";
import { cleared, layoutOf, lineOf, placeAt, planOf, specOf } from "#js/worlds/editor/plan.js";
import { toQuery } from "#js/worlds/query.js";

const CASES = JSON.parse(readFileSync(new URL("../core/world_queries.json", import.meta.url), "utf8"));
const WALL = { tool: "wall", reward: -3, pay: 14 };
const brush = (tool, more = {}) => ({ ...WALL, tool, ...more });

/** The same draws each time. @param {number} seed */
function dice(seed) {
  let state = seed;
  return (n) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * n);
  };
}

/** A hand that tries everything, impossible things too. @param {any} plan @param {(n: number) => number} roll */
function randomChange(plan, roll) {
  const place = () => roll(12) * 100 + roll(12);
  if (roll(6) === 0) return { ...plan, rows: 2 + roll(10), cols: 2 + roll(10) };
  const stroke = new Stroke(plan, brush(TOOLS[roll(5)], { reward: -roll(8), pay: roll(30) }), place());
  let after = stroke.first.plan;
  for (let n = roll(4); n > 0; n--) after = stroke.moveTo(after, place()).plan;
  return stroke.end(after).plan;
}

for (const { spec, query } of CASES) {
  test(`a plan keeps the world of ${query}`, () => {
    const again = specOf(planOf(spec));
    assert.equal(toQuery(specOf(planOf(again))), toQuery(again));
    const { rows, cols, ...marks } = spec;
    for (const [name, value] of Object.entries(marks)) {
      if (name !== "red_probability" || value !== 0.3) assert.deepEqual(again[name], value, name);
    }
    assert.equal(again.rows ?? 7, rows ?? 7);
    assert.equal(again.cols ?? 7, cols ?? 7);
  });
}

test("an ordinary world is its seed alone", () => {
  assert.deepEqual(specOf(planOf({ seed: 5 })), { seed: 5 });
});

test("a stroke paints every square on its way", () => {
  const plan = planOf({ seed: 5 });
  const stroke = new Stroke(plan, WALL, 102);
  const after = stroke.moveTo(stroke.first.plan, 106).plan;
  assert.deepEqual(specOf(stroke.end(after).plan).walls, [9, 10, 11, 12, 13]);
  assert.deepEqual(lineOf(0, 204), [0, 101, 102, 203, 204]);
  assert.deepEqual(lineOf(0, 303), [0, 101, 202, 303]);
});

test("pressing again on the same square takes it back; drawing on from it does not", () => {
  const plan = paint(planOf({ seed: 5 }), WALL, [3]).plan;
  assert.deepEqual(specOf(new Stroke(plan, WALL, 3).end(plan).plan), { seed: 5 });
  const stroke = new Stroke(plan, WALL, 3);
  const after = stroke.moveTo(stroke.first.plan, 4).plan;
  assert.deepEqual(specOf(stroke.end(after).plan).walls, [3, 4]);
});

test("a square is one thing: wall, painted or goal, whatever came last", () => {
  let plan = paint(planOf({ seed: 5 }), brush("paint"), [3]).plan;
  assert.deepEqual(specOf(plan).painted, [[3, -3]]);
  plan = paint(plan, WALL, [3]).plan;
  assert.deepEqual(specOf(plan), { seed: 5, walls: [3] });
  plan = paint(plan, brush("goal"), [3]).plan;
  assert.deepEqual(specOf(plan), { seed: 5, goals: [48, 3] });
  plan = paint(plan, brush("erase"), [3]).plan;
  assert.deepEqual(specOf(plan), { seed: 5 });
});

test("start and goals are protected, and it is said why", () => {
  const plan = planOf({ seed: 5 });
  const refused = [
    [WALL, 0, /start cannot be a wall/],
    [WALL, 606, /goal cannot be a wall/],
    [brush("paint"), 606, /goal pays/],
    [brush("goal"), 0, /start cannot be a goal/],
    [brush("start"), 606, /goal cannot be the start/],
    [brush("erase"), 606, /needs a goal/],
    [brush("erase"), 0, /needs a start/],
  ];
  for (const [tool, place, why] of refused) {
    const after = paint(plan, tool, [place]);
    assert.equal(after.plan, plan);
    assert.match(after.refusal, why);
  }
});

test("a world that shrinks and grows again has everything it had", () => {
  const spec = { seed: 5, walls: [24], start: 30, goals: [48, 40], painted: [[25, -7]], step_limit: 60 };
  const plan = planOf(spec);
  const small = { ...plan, rows: 3, cols: 3 };
  assert.deepEqual(specOf(small), { rows: 3, cols: 3, seed: 5, step_limit: 60 });
  const touched = paint(small, WALL, [1]).plan;
  const grown = specOf({ ...touched, rows: 7, cols: 7 });
  assert.deepEqual(grown, { ...spec, walls: [1, 24] });
});

test("the usual goal moves along with its corner, and pays as the size has it", () => {
  const plan = { ...planOf({ seed: 5 }), rows: 4, cols: 9 };
  assert.deepEqual([...layoutOf(plan).goals], [[35, null]]);
  assert.deepEqual(specOf(plan), { rows: 4, cols: 9, seed: 5 });
  const dear = paint(plan, brush("goal", { pay: 40 }), [placeAt(plan, 35)]).plan;
  assert.deepEqual(specOf(dear).painted, [[35, 40]]);
});

test("an impossible world opens with what can be read of it", () => {
  const spec = {
    rows: 1,
    cols: 500,
    seed: -3,
    slip: 2,
    walls: [0, 99, 3],
    start: 48,
    goals: [48],
    painted: [[70, -1]],
  };
  assert.deepEqual(specOf(planOf(spec)), { seed: 0, walls: [3] });
});

test("clearing takes everything painted and leaves the numbers", () => {
  const plan = planOf({ rows: 4, seed: 5, slip: 0.1, walls: [3], goals: [5], painted: [[9, -2]], time_limit_s: 60 });
  assert.deepEqual(specOf(cleared(plan)), { rows: 4, seed: 5, slip: 0.1, time_limit_s: 60 });
});

test("how attempts are ordered stays through clearing, and a way there is none of is nobody's choice", () => {
  assert.deepEqual(specOf(cleared(planOf({ seed: 5, rank_by: "pairwise", walls: [3] }))), {
    seed: 5,
    rank_by: "pairwise",
  });
  assert.deepEqual(specOf(planOf({ seed: 5, rank_by: /** @type {any} */ ("alphabet") })), { seed: 5 });
  assert.deepEqual(specOf(planOf({ seed: 5, rank_by: null })), { seed: 5 });
  assert.deepEqual(specOf(cleared(planOf({ seed: 5, pooled: true, walls: [3] }))), { seed: 5, pooled: true });
  assert.deepEqual(specOf(planOf({ seed: 5, pooled: false })), { seed: 5 });
});

test("a brush can be picked up from any square", () => {
  const plan = planOf({ seed: 5, walls: [3], goals: [48, 6], painted: [[6, 30]] });
  assert.deepEqual(brushAt(plan, 3, 0, WALL), WALL);
  assert.deepEqual(brushAt(plan, 6, 30, WALL), brush("goal", { pay: 30 }));
  assert.deepEqual(brushAt(plan, 606, 14, WALL), brush("goal", { pay: 14 }));
  assert.deepEqual(brushAt(plan, 0, -1, WALL), brush("start"));
  assert.deepEqual(brushAt(plan, 100, -5.5, WALL), brush("paint", { reward: -5.5 }));
});

test("whatever a hand does, the world has a start, goals and walls that do not meet", () => {
  const roll = dice(7);
  let plan = planOf({ seed: 5 });
  for (let n = 0; n < 3_000; n++) {
    plan = randomChange(plan, roll);
    const { start, goals, walls, painted } = layoutOf(plan);
    const nSquares = plan.rows * plan.cols;
    const all = [start, ...goals.keys(), ...walls];
    assert.equal(new Set(all).size, all.length);
    assert.ok(goals.size >= 1);
    assert.ok([...all, ...painted.map(([square]) => square)].every((square) => square >= 0 && square < nSquares));
    assert.ok(painted.every(([square]) => !walls.includes(square) && !goals.has(square)));
  }
});

test("undo and redo walk through exactly what was, however long the way", () => {
  const roll = dice(11);
  const history = new History(planOf({ seed: 5 }));
  const seen = [history.present];
  while (seen.length < 150) {
    const next = randomChange(history.present, roll);
    if (next !== history.present) seen.push(next);
    history.change(next, { stroke: seen.length });
  }
  for (const plan of seen.toReversed().slice(1)) {
    history.undo();
    assert.equal(history.present, plan);
  }
  assert.ok(!history.canUndo);
  for (const plan of seen.slice(1)) {
    history.redo();
    assert.equal(history.present, plan);
  }
  assert.ok(!history.canRedo);
});

test("a gesture is one step of undo, and what comes after an undo replaces what was undone", () => {
  const history = new History("a");
  history.change("b", "pull");
  history.change("c", "pull");
  history.endGesture();
  history.change("d", "pull");
  history.undo();
  assert.equal(history.present, "c");
  history.undo();
  assert.equal(history.present, "a");
  history.change("e");
  assert.ok(!history.canRedo);
});
