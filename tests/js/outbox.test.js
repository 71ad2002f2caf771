import assert from "node:assert/strict";
import test from "node:test";
import { ApiError } from "#js/lib/api.js";
import { memoryStore, Outbox } from "#js/lib/outbox.js";

const parcel = (id) => ({
  id,
  worldId: "w",
  world: { seed: 5 },
  body: { id, actions: [1], step_ms: [5], ending: "gave_up" },
});
const offline = () => new ApiError({ status: 0, code: "offline", message: "away" });
const refusal = (status) => new ApiError({ status, code: "no", message: "cannot have happened" });

/** An outbox whose server answers as the test says; pauses are collected, not slept. */
function make(answers) {
  const sent = [];
  const news = [];
  const pauses = [];
  const store = memoryStore();
  const outbox = new Outbox({
    store,
    send: async ({ id }) => {
      sent.push(id);
      const answer = answers.shift();
      if (answer instanceof Error) throw answer;
      return answer;
    },
    report: ({ kind, parcel: { id } }) => news.push(`${kind} ${id}`),
    wait: (run, ms) => pauses.push({ run, ms }),
  });
  return { outbox, store, sent, news, pauses };
}

test("an attempt is kept before it is sent, and forgotten once acknowledged", async () => {
  const { outbox, store, news } = make([{ id: "a" }]);
  const added = outbox.add(parcel("a"));
  await added;
  assert.equal((await store.all()).length, 1);
  await outbox.flush();
  assert.deepEqual(await store.all(), []);
  assert.deepEqual(news, ["saved a"]);
});

test("without a server it waits, tries again with growing pauses, and arrives once", async () => {
  const { outbox, store, sent, news, pauses } = make([offline(), offline(), { id: "a" }]);
  await outbox.add(parcel("a"));
  await outbox.flush();
  while (pauses.length < 2) {
    pauses.at(-1).run();
    await outbox.flush();
  }
  assert.ok(pauses[1].ms > pauses[0].ms);
  pauses.at(-1).run();
  await outbox.flush();
  assert.deepEqual(await store.all(), []);
  assert.equal(news.filter((line) => line === "saved a").length, 1);
  assert.ok(sent.length >= 3);
});

test("the first attempt that finds no server stops the round: order is kept", async () => {
  const { outbox, store, sent } = make([offline(), offline()]);
  await store.put({ ...parcel("a"), at: 1, refusal: null });
  await store.put({ ...parcel("b"), at: 2, refusal: null });
  await outbox.flush();
  assert.ok(!sent.includes("b"));
});

test("what the server refuses is kept, said, and not sent again", async () => {
  const { outbox, store, sent, news } = make([refusal(422), { id: "b" }]);
  await store.put({ ...parcel("a"), at: 1, refusal: null });
  await store.put({ ...parcel("b"), at: 2, refusal: null });
  await outbox.flush();
  await outbox.flush();
  assert.deepEqual(sent, ["a", "b"]);
  assert.deepEqual(news, ["refused a", "saved b"]);
  assert.deepEqual(
    (await store.all()).map(({ id, refusal: words }) => [id, words]),
    [["a", "cannot have happened"]],
  );
});

test("a busy server is no refusal", async () => {
  const { outbox, store, news } = make([refusal(503), { id: "a" }]);
  await store.put({ ...parcel("a"), at: 1, refusal: null });
  await outbox.flush();
  assert.deepEqual(news, ["waiting a"]);
  await outbox.flush();
  assert.deepEqual(news, ["waiting a", "saved a"]);
});
