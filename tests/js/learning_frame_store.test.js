import assert from "node:assert/strict";
import test from "node:test";
import { spread } from "#js/learning/chart-words.js";
import { FrameStore } from "#js/learning/frame-store.js";

const frame = (learner, iteration, more = {}) => ({
  learner,
  iteration,
  iterations: 500,
  gap: 1 / (1 + iteration),
  log_likelihood: -iteration,
  reward: [iteration, -2],
  policy: [],
  visitation: [],
  ...more,
});

const storeOf = (...frames) => {
  const store = new FrameStore();
  for (const one of frames) store.add(one);
  return store;
};

test("a frame is found at and after its iteration, until the next one", () => {
  const store = storeOf(frame("meirl", 0), frame("meirl", 40), frame("meirl", 80));
  assert.equal(store.at("meirl", 0)?.iteration, 0);
  assert.equal(store.at("meirl", 39)?.iteration, 0);
  assert.equal(store.at("meirl", 40)?.iteration, 40);
  assert.equal(store.at("meirl", 1000)?.iteration, 80);
});

test("before its first frame a learner shows that one, without any it shows nothing", () => {
  const store = storeOf(frame("meirl", 10));
  assert.equal(store.at("meirl", 0)?.iteration, 10);
  assert.equal(store.at("irlr", 0), null);
});

test("frames that come twice or out of order leave one time line", () => {
  const store = storeOf(frame("meirl", 40), frame("meirl", 0), frame("meirl", 40, { gap: 9 }));
  assert.equal(store.size, 2);
  assert.deepEqual(store.iterations, [0, 40]);
  assert.equal(store.at("meirl", 40)?.gap, 9);
});

test("columns are aligned over all learners, with null where one has no frame", () => {
  const store = storeOf(frame("meirl", 0), frame("meirl", 10), frame("irlr", 5));
  const { iterations, columns } = store.columns(["meirl", "irlr"], "log_likelihood");
  assert.deepEqual(iterations, [0, 5, 10]);
  assert.deepEqual(columns, [
    [-0, null, -10],
    [null, -5, null],
  ]);
});

const seeking = (name) => ({ name, seeks_visits: true });

test("the colour scale of a learner that descends is the largest size it ever showed", () => {
  const store = storeOf(frame("meirl", 0, { reward: [-9, 1] }), frame("meirl", 7), frame("irlr", 3));
  assert.equal(store.largestReward(seeking("meirl")), 9);
  assert.equal(store.largestReward(seeking("irlr")), 3);
  assert.equal(store.largestReward(seeking("irlf")), 0);
});

test("the colour scale of a chain that began far off is that of where it came to", () => {
  const store = storeOf(frame("birlfr", 0, { reward: [-40, 1] }), frame("birlfr", 400, { reward: [-0.3, 1] }));
  assert.equal(store.largestReward({ name: "birlfr", seeks_visits: false }), 1);
});

test("a figure that is not a number does not spoil the scale", () => {
  assert.equal(storeOf(frame("meirl", 0, { reward: [Number.NaN, 2, null] })).largestReward(seeking("meirl")), 2);
});

test("a long table keeps its first and last row", () => {
  const rows = spread(
    Array.from({ length: 100 }, (_, i) => i),
    12,
  );
  assert.equal(rows.length, 12);
  assert.equal(rows[0], 0);
  assert.equal(rows.at(-1), 99);
});
