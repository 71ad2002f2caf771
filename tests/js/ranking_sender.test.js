import assert from "node:assert/strict";
import test from "node:test";
import { rankingSender } from "#js/lib/ranking-sender.js";

const events = (from, to) => Array.from({ length: to - from }, (_, i) => ({ n: from + i, at_ms: 0, type: "watch" }));
const log = (from, to) => ({ kind: "log", id: "log:s", worldId: "w", sittingId: "s", events: events(from, to) });
const order = (from, to) => ({
  kind: "ranking",
  id: "ranking:s:success",
  worldId: "w",
  sittingId: "s",
  outcome: "success",
  body: {
    order: [["a"]],
    confirmed: true,
    based_on: 0,
    untouched: false,
    sitting: { id: "s", events: events(from, to) },
  },
});

/** A way to a server that answers as told; what it was asked. @param {((body: any) => any)[]} answers */
function asked(...answers) {
  const calls = [];
  globalThis.fetch = async (url, { method, body }) => {
    calls.push({ url: `${method} ${url}`, body: JSON.parse(body) });
    const { status = 200, ...answer } = answers.shift()(calls.at(-1).body);
    return new Response(JSON.stringify(answer), { status });
  };
  return calls;
}

const has = (n) => () => ({ id: "s", n_events: n });
const version = (number, n) => () => ({ version: number, n_events: n, sitting_id: "s" });
const numbers = (body) => (body.events ?? body.sitting.events).map(({ n }) => n);

test("what the server has is not sent again; the confirmation always goes with its order", async () => {
  const calls = asked(has(3), version(1, 5), version(2, 5));
  const send = rankingSender();
  await send(log(0, 3));
  await send(order(0, 5));
  await send(order(0, 5));
  assert.deepEqual(
    calls.map(({ body }) => numbers(body)),
    [[0, 1, 2], [3, 4], [4]],
  );
});

test("a log that the server has as a whole asks it nothing", async () => {
  const calls = asked(has(3));
  const send = rankingSender();
  await send(log(0, 3));
  assert.deepEqual(await send(log(0, 3)), { id: "s", n_events: 3 });
  assert.equal(calls.length, 1);
});

test("no call holds more than 500 events, and the confirmation goes last", async () => {
  const calls = asked(has(500), has(701), version(1, 1201));
  await rankingSender()(order(0, 1201));
  assert.deepEqual(
    calls.map(({ body }) => numbers(body).length),
    [500, 201, 500],
  );
  assert.equal(numbers(calls[2].body).at(-1), 1200);
});

test("a gateway that answers in the server's place has saved nothing: it is sent again as a whole", async () => {
  const calls = asked(
    () => ({}),
    has(3),
    () => ({ page: "sign in" }),
    version(1, 5),
  );
  const send = rankingSender();
  await assert.rejects(send(log(0, 3)), { status: 0 });
  await send(log(0, 3));
  await assert.rejects(send(order(0, 5)), { status: 0 });
  await send(order(0, 5));
  assert.deepEqual(numbers(calls.at(-1).body), [0, 1, 2, 3, 4]);
});
