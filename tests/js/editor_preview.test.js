import assert from "node:assert/strict";
import test from "node:test";
import { ApiError } from "#js/lib/api.js";
import { Ground } from "#js/worlds/editor/ground.js";
import { planOf } from "#js/worlds/editor/plan.js";
import { Preview } from "#js/worlds/editor/preview.js";
import { makeWorld } from "./factories.js";

const SILENT = new ApiError({ status: 0, code: "offline", message: "Gone." });
const REFUSAL = new ApiError({ status: 422, code: "invalid", message: "No way.", fields: { walls: "No way." } });
const soon = (ms = 15) => new Promise((resolve) => setTimeout(resolve, ms));

/** A server whose answers are given by hand, and a note of what was heard. */
function makePreview() {
  const asked = [];
  const heard = [];
  const get = (path, { signal }) =>
    new Promise((resolve, reject) => {
      signal.addEventListener("abort", () => reject(new DOMException("", "AbortError")));
      asked.push({ path, resolve, reject });
    });
  const listener = {
    answer: (world) => heard.push(world),
    refuse: ({ message, fields }) => heard.push({ message, fields }),
    miss: () => heard.push("gone"),
  };
  return { asked, heard, preview: new Preview(get, listener, { pauseMs: 1, retryMs: 5 }) };
}

test("only the last of quick changes is asked about", async () => {
  const { asked, preview } = makePreview();
  preview.ask("seed=1");
  preview.ask("seed=2");
  await soon();
  assert.deepEqual(
    asked.map(({ path }) => path),
    ["/worlds/preview?seed=2"],
  );
});

test("an older answer never comes over a newer one", async () => {
  const { asked, heard, preview } = makePreview();
  preview.ask("seed=1");
  await soon();
  preview.ask("seed=2");
  await soon();
  asked[1].resolve("second");
  asked[0].resolve("first");
  await soon();
  assert.deepEqual(heard, ["second"]);
});

test("a refusal is told with its fields", async () => {
  const { asked, heard, preview } = makePreview();
  preview.ask("seed=1");
  await soon();
  asked[0].reject(REFUSAL);
  await soon();
  assert.deepEqual(heard, [{ message: "No way.", fields: { walls: "No way." } }]);
  assert.equal(asked.length, 1);
});

test("a silent server is asked again until it answers", async () => {
  const { asked, heard, preview } = makePreview();
  preview.ask("seed=1");
  await soon();
  asked[0].reject(SILENT);
  await soon(30);
  asked[1].resolve("here");
  await soon(30);
  assert.deepEqual(heard, ["gone", "here"]);
  assert.equal(asked.length, 2);
});

test("what is painted shows before the server knows of it, and what is erased comes back", () => {
  const ground = new Ground();
  const world = makeWorld([
    [-0.1, -2],
    [-0.3, 4],
  ]);
  ground.learn({ ...world, seed: 5 });
  const spec = { rows: 2, cols: 2, seed: 5 };
  const painted = ground.draw(planOf({ ...spec, walls: [1], painted: [[2, -7]] }));
  assert.deepEqual(painted.rewards, [
    [-0.1, -2],
    [-7, 4],
  ]);
  assert.deepEqual(painted.colours, [
    ["blue", "wall"],
    ["red", "goal"],
  ]);
  assert.deepEqual(ground.draw(planOf(spec)).rewards, world.rewards);
});

test("the ground below what the server painted is not taken from its paint", () => {
  const ground = new Ground();
  const world = makeWorld([
    [-0.1, -2],
    [-7, 4],
  ]);
  ground.learn({ ...world, spec: { painted: [[2, -7]] } });
  const plan = planOf({ rows: 2, cols: 2, seed: 1 });
  assert.equal(ground.draw(plan).rewards[1][0], -0.5);
  ground.learn({
    ...world,
    rewards: [
      [-0.1, -2],
      [-0.9, 4],
    ],
  });
  assert.equal(ground.draw(plan).rewards[1][0], -0.9);
});
