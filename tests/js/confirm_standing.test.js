/** What counts already and what has yet to be confirmed; attempts that come or go under an open page; an order as a file. */

import assert from "node:assert/strict";
import { afterEach, test } from "node:test";
import { bringUpToDate } from "#js/rankings/late-cards.js";
import { flat } from "#js/rankings/order.js";
import { linesOf } from "#js/rankings/order-file.js";
import { apply, beginState } from "#js/rankings/sitting-state.js";
import { canOrder, differing, givenOf, printOf, says } from "#js/rankings/standing.js";

const NONE = { success: null, failure: null };

function sittingOf(success, failure, way = "lists") {
  let state = beginState({ type: "begin", orders: { success, failure }, way });
  return {
    get state() {
      return state;
    },
    get orders() {
      return state.present.orders;
    },
    do(change) {
      const next = apply(state, change);
      if (next === null || next === state) return false;
      state = next;
      return true;
    },
  };
}

const rankingOf = (outcome, order, given = null) => ({ outcome, order, given, version: 1, created_at: "" });

test("what was confirmed counts until the order is another", () => {
  const sitting = sittingOf([["a"], ["b"]], [["c"], ["d"]]);
  const newest = { success: rankingOf("success", [["a"], ["b"]]), failure: rankingOf("failure", [["c"], ["d"]]) };
  assert.deepEqual(differing(sitting.state, NONE), ["success", "failure"]);
  assert.deepEqual(differing(sitting.state, newest), []);
  sitting.do({ type: "swap", outcome: "failure", id: "c", with: "d" });
  assert.deepEqual(differing(sitting.state, newest), ["failure"]);
  sitting.do({ type: "undo" });
  assert.deepEqual(differing(sitting.state, newest), []);
});

test("an attempt alone needs no confirming, and goes along with others", () => {
  const alone = sittingOf([["a"]], [["c"]]);
  assert.equal(canOrder(alone.state), false);
  assert.deepEqual(differing(alone.state, NONE), []);
  const beside = sittingOf([["a"]], [["c"], ["d"]]);
  assert.equal(canOrder(beside.state), true);
  assert.deepEqual(differing(beside.state, NONE), ["success", "failure"]);
  assert.deepEqual(differing(beside.state, { ...NONE, failure: rankingOf("failure", [["c"], ["d"]]) }), []);
});

test("what is said beside an order counts with it, whatever way its fields came", () => {
  const sitting = sittingOf([["a"], ["b"]], [], "magnitude");
  const confirmed = { ...NONE, success: rankingOf("success", [["a"], ["b"]]) };
  assert.ok(says(sitting.state, confirmed.success, "success"), "to look at another way says nothing new");
  sitting.do({ type: "gap", outcome: "success", above: "a", below: "b", value: 40 });
  assert.deepEqual(givenOf(sitting.state, "success"), [{ above: "a", below: "b", value: 40 }]);
  assert.deepEqual(differing(sitting.state, confirmed), ["success"]);
  const given = [{ value: 40, below: "b", above: "a" }];
  assert.ok(says(sitting.state, rankingOf("success", [["a"], ["b"]], given), "success"));
});

test("stretches belong to the order that holds their attempt", () => {
  const sitting = sittingOf([["a"]], [["c"], ["d"]], "segments");
  sitting.do({ type: "stretch", id: "c", from: 1, to: 2, kind: "bad" });
  assert.deepEqual(givenOf(sitting.state, "success"), {});
  assert.deepEqual(givenOf(sitting.state, "failure"), { c: [{ from: 1, to: 2, kind: "bad" }] });
  assert.notEqual(printOf(sitting.state, "failure"), printOf(sittingOf([["a"]], [["c"], ["d"]]).state, "failure"));
});

const { fetch } = globalThis;
afterEach(() => {
  globalThis.fetch = fetch;
});

function serverHas(...demonstrations) {
  globalThis.fetch = async () => new Response(JSON.stringify(demonstrations));
}

const told = (id, outcome, discarded = false) => ({ id, outcome, discarded, total: 0, actions: [], states: [0] });

test("attempts that came join their list last, discarded ones leave, and nothing else moves", async () => {
  const sitting = sittingOf([["b"], ["a", "e"]], [["c"], ["d"]]);
  const demonstrations = new Map();
  serverHas(
    ...["a", "b", "f", "g"].map((id) => told(id, "success")),
    told("e", "success", true),
    told("c", "failure"),
    told("d", "failure"),
  );
  const news = await bringUpToDate({ sitting, worldId: "w", demonstrations });
  assert.equal(news.length, 1);
  assert.equal(news[0].outcome, "success");
  assert.deepEqual(news[0].added.toSorted(), ["f", "g"]);
  assert.deepEqual(news[0].removed, ["e"]);
  assert.deepEqual(sitting.orders.success.slice(0, 2), [["b"], ["a"]]);
  assert.deepEqual(flat(sitting.orders.success.slice(2)).toSorted(), ["f", "g"]);
  assert.deepEqual(sitting.orders.failure, [["c"], ["d"]]);
  assert.ok(demonstrations.has("f") && demonstrations.get("e").discarded);
  assert.deepEqual(await bringUpToDate({ sitting, worldId: "w", demonstrations }), []);
});

test("a browser that the server does not know loses none of its cards", async () => {
  const sitting = sittingOf([["a"]], [["c"]]);
  serverHas();
  assert.equal(await bringUpToDate({ sitting, worldId: "w", demonstrations: new Map() }), "stranger");
  serverHas(told("z", "success"));
  assert.equal(await bringUpToDate({ sitting, worldId: "w", demonstrations: new Map() }), "stranger");
  assert.deepEqual(sitting.orders, { success: [["a"]], failure: [["c"]] });
});

test("an order leaves as ranking lines of a demonstration file", () => {
  const lines = linesOf("w", sittingOf([["a", "b"]], []).state)
    .trimEnd()
    .split("\n");
  assert.deepEqual(
    lines.map((line) => JSON.parse(line)),
    [
      {
        kind: "ranking",
        world_id: "w",
        outcome: "success",
        order: [["a", "b"]],
        confirmed: false,
        way: "lists",
        given: null,
      },
    ],
  );
});
