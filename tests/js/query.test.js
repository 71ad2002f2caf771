import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { toQuery } from "#js/worlds/query.js";

const CASES = JSON.parse(readFileSync(new URL("../core/world_queries.json", import.meta.url), "utf8"));

for (const { spec, query } of CASES) {
  test(`a world is written as ${query}`, () => assert.equal(toQuery(spec), query));
}

test("what is not said is not written", () => {
  assert.equal(toQuery({}), "");
  assert.equal(toQuery({ seed: null, walls: [], goals: [], painted: [], step_limit: null }), "");
});

test("an address needs no escaping", () => {
  const query = toQuery({ seed: 5, walls: [3, 4, 9], painted: [[12, -3.5]], red_probability: 1e-7 });
  assert.equal(query, encodeURI(query));
  assert.equal(new URLSearchParams(query).get("painted"), "12:-3.5");
});

test("a hundred rows of walls are one range", () => {
  assert.equal(toQuery({ seed: 1, walls: Array.from({ length: 9_000 }, (_, i) => i + 50) }), "seed=1&walls=50-9049");
});
