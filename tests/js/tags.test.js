import assert from "node:assert/strict";
import test from "node:test";
import { EMPTY_VIEW } from "#js/board/state.js";
import { figureTags } from "#js/board/tags.js";

const world = {
  rows: 3,
  cols: 3,
  start: 0,
  goal: 8,
  goals: [8],
  walls: [],
  rewards: [
    [-1, -2, -3],
    [-4, -5, -6],
    [-0.5, -0.2, 6],
  ],
};
const view = { ...EMPTY_VIEW, numbers: true, agents: [{ state: 0, who: "human" }] };

test("a small board tells the figures beside the agent, or the one pointed at", () => {
  const texts = (change, at) =>
    figureTags(world, { ...view, ...change }, { cell: 6, pointed: null, ...at }).map(({ text }) => text);
  assert.deepEqual(texts({}), ["\u22122.0", "\u22124.0"]);
  assert.deepEqual(texts({}, { pointed: 8 }), ["6.0"]);
  assert.deepEqual(texts({ values: [0, 1, 2, 3, 4, 5, 6, 7, 8] }, { pointed: 4 }), ["4.0"]);
  assert.deepEqual(texts({ numbers: false }), []);
  assert.deepEqual(texts({}, { cell: 40 }), []);
});
