import assert from "node:assert/strict";
import test from "node:test";
import { ApiError } from "#js/lib/api.js";
import { Outbox } from "#js/lib/outbox.js";
import { wishId } from "#js/lib/parcels.js";
import { memoryParcels } from "./factories.js";

const parcel = (id, more = {}) => ({
  id,
  worldId: "w",
  world: { seed: 5 },
  body: { id, actions: [1], step_ms: [5], ending: "gave_up", ...more },
});
const kept = (id, more) => ({ ...parcel(id, more), at: 1, refusal: null });
const offline = () => new ApiError({ status: 0, code: "offline", message: "away" });
const refusal = (status, retryAfterMs = null) =>
  new ApiError({ status, code: "no", message: "cannot have happened", retryAfterMs });

/** An outbox whose server answers as the test says; pauses are collected, not slept; the clock stands. */
function make(answers, store = memoryParcels()) {
  const sent = [];
  const news = [];
  const pauses = [];
  const clock = { ms: 0 };
  const outbox = new Outbox({
    store,
    send: async ({ id }) => {
      sent.push(id);
      const answer = answers.shift();
      if (answer instanceof Error) throw answer;
      return answer;
    },
    report: ({ kind, parcel: { id }, isStored }) => news.push(`${kind}${isStored === false ? " in memory" : ""} ${id}`),
    wait: (run, ms) => pauses.push({ run, ms }),
    now: () => clock.ms,
  });
  return { outbox, store, sent, news, pauses, clock };
}

const idsIn = async (store) => (await store.all()).map(({ id }) => id);

/** A store that takes nothing while `isFull`. */
function fillable() {
  const store = memoryParcels();
  const full = { ...store, isFull: true };
  full.add = async (one) => {
    if (full.isFull) throw new DOMException("no room", "QuotaExceededError");
    return store.add(one);
  };
  return full;
}

test("an attempt is kept before it is sent, and forgotten once acknowledged", async () => {
  const { outbox, store, news } = make([{ id: "a" }]);
  const added = outbox.add(parcel("a"));
  await added;
  assert.deepEqual(await idsIn(store), ["a"]);
  await outbox.flush();
  assert.deepEqual(await store.all(), []);
  assert.deepEqual(news, ["kept a", "saved a"]);
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
  await store.add(kept("a"));
  await store.add(kept("b"));
  await outbox.flush();
  assert.ok(!sent.includes("b"));
});

test("what the server refuses is kept, said, and not sent again", async () => {
  const { outbox, store, sent, news } = make([refusal(409), { id: "b" }]);
  await store.add(kept("a"));
  await store.add(kept("b"));
  await outbox.flush();
  await outbox.flush();
  assert.deepEqual(sent, ["a", "b"]);
  assert.deepEqual(news, ["refused a", "saved b"]);
  assert.deepEqual(
    (await store.all()).map(({ id, refusal: words, status }) => [id, words, status]),
    [["a", "cannot have happened", 409]],
  );
  await outbox.forget("a");
  assert.deepEqual(await store.all(), []);
  assert.equal(news.at(-1), "forgotten a");
});

test("a busy server is no refusal", async () => {
  const { outbox, store, news } = make([refusal(503), { id: "a" }]);
  await store.add(kept("a"));
  await outbox.flush();
  assert.deepEqual(news, ["waiting a"]);
  await outbox.flush();
  assert.deepEqual(news, ["waiting a", "saved a"]);
});

test("a server that asks to be left alone is left alone, whatever gives reason to hope", async () => {
  const { outbox, store, sent, pauses, clock } = make([refusal(503, 20_000), { id: "a" }]);
  await store.add(kept("a"));
  await outbox.flush();
  await outbox.flush();
  clock.ms = 19_999;
  await outbox.flush();
  assert.deepEqual(sent, ["a"]);
  assert.ok(pauses.at(-1).ms > 20_000);
  clock.ms = pauses.at(-1).ms;
  pauses.at(-1).run();
  await outbox.flush();
  assert.deepEqual(sent, ["a", "a"]);
});

test("what another tab was asked for holds for this one", async () => {
  const { outbox, store, sent, pauses } = make([{ id: "a" }]);
  outbox.hear({ kind: "waiting", parcel: kept("z"), status: 503, retryAfterMs: 5000 });
  await store.add(kept("a"));
  await outbox.flush();
  assert.deepEqual(sent, []);
  assert.ok(pauses[0].ms >= 5000, "and this one comes back by itself, should the other be closed");
});

test("a child waits for its parent, even where they are kept in the wrong order", async () => {
  const { outbox, store, sent } = make([{ id: "parent" }, { id: "child" }]);
  await store.add(kept("child", { parent_id: "parent", parent_step: 1 }));
  await store.add(kept("parent"));
  await outbox.flush();
  assert.deepEqual(sent, ["parent", "child"]);
});

test("the child of a refused attempt is sent, refused and kept as well", async () => {
  const { outbox, store, news } = make([refusal(422), refusal(422)]);
  await store.add(kept("parent"));
  await store.add(kept("child", { parent_id: "parent", parent_step: 1 }));
  await outbox.flush();
  assert.deepEqual(news, ["refused parent", "refused child"]);
  assert.deepEqual(await idsIn(store), ["parent", "child"]);
});

test("a discard waits behind its attempt, and the last wish counts", async () => {
  const { outbox, store, sent } = make([offline(), offline(), offline(), { id: "a" }, { id: "a" }]);
  await outbox.add(parcel("a"));
  await outbox.setDiscarded({ attemptId: "a", worldId: "w", discarded: true });
  await outbox.setDiscarded({ attemptId: "a", worldId: "w", discarded: false });
  await outbox.setDiscarded({ attemptId: "a", worldId: "w", discarded: true });
  await outbox.flush();
  while ((await store.all()).length > 0) await outbox.flush();
  assert.deepEqual([...new Set(sent)], ["a", wishId("a")]);
  assert.equal(sent.at(-1), wishId("a"));
});

test("a wish that came while the one before it was under way is sent too", async () => {
  const store = memoryParcels();
  const sent = [];
  const outbox = new Outbox({
    store,
    wait: () => {},
    send: async ({ discarded }) => {
      sent.push(discarded);
      if (sent.length === 1) await outbox.setDiscarded({ attemptId: "a", worldId: "w", discarded: false });
      return { id: "a" };
    },
  });
  await outbox.setDiscarded({ attemptId: "a", worldId: "w", discarded: true });
  await outbox.flush();
  assert.deepEqual(sent, [true, false]);
  assert.deepEqual(await store.all(), []);
});

test("a wish that cannot be granted is told and over", async () => {
  const { outbox, store, news } = make([refusal(404)]);
  await outbox.setDiscarded({ attemptId: "a", worldId: "w", discarded: true });
  await outbox.flush();
  assert.equal(news.at(-1), `refused ${wishId("a")}`);
  assert.deepEqual(await store.all(), []);
});

test("where the storage is full an attempt lives in memory, says so, and is sent all the same", async () => {
  const { outbox, news, sent } = make([offline(), { id: "a" }], fillable());
  await outbox.add(parcel("a"));
  assert.equal(outbox.nUnstored, 1);
  assert.equal(news[0], "kept in memory a");
  await outbox.flush();
  await outbox.flush();
  assert.ok(sent.length >= 2);
  assert.equal(news.at(-1), "saved a");
  assert.equal(outbox.nUnstored, 0);
});

test("an attempt in memory goes to the storage as soon as there is room", async () => {
  const store = fillable();
  const { outbox, news } = make([offline(), offline(), offline()], store);
  await outbox.add(parcel("a"));
  await outbox.flush();
  store.isFull = false;
  await outbox.flush();
  assert.ok(news.includes("kept a"));
  assert.equal(outbox.nUnstored, 0);
  assert.deepEqual(await idsIn(store), ["a"]);
});

test("what the storage did not take survives the closing of the page, until it has arrived", async () => {
  const straws = new Map();
  const lastStraw = {
    keep: (items) => [...items].map((one) => straws.set(one.id, one)),
    all: () => [...straws.values()],
    drop: (id) => void straws.delete(id),
  };
  const outbox = new Outbox({
    store: fillable(),
    lastStraw,
    wait: () => {},
    send: async () => {
      throw offline();
    },
  });
  const adding = outbox.add(parcel("a"));
  outbox.rescue();
  assert.deepEqual([...straws.keys()], ["a"]);
  await adding;
  await outbox.forget("a");
  assert.deepEqual([...straws.keys()], []);
});

test("a damaged parcel is kept and said, and stops nobody", async () => {
  const { outbox, store, sent, news } = make([{ id: "b" }]);
  await store.add({ id: "a", worldId: "w", at: 1, refusal: null, body: "?" });
  await store.add(kept("b"));
  await outbox.flush();
  assert.deepEqual(sent, ["b"]);
  assert.deepEqual(news, ["refused a", "saved b"]);
  assert.match((await store.all())[0].refusal, /damaged/);
});

test("a storage that cannot forget does not make the page send for ever", async () => {
  const store = memoryParcels();
  store.delete = async () => {
    throw new DOMException("closed", "InvalidStateError");
  };
  const { outbox, sent } = make([{ id: "a" }], store);
  await store.add(kept("a"));
  await outbox.flush();
  await outbox.flush();
  assert.deepEqual(sent, ["a"]);
});

const ranking = (n) => ({
  kind: "ranking",
  id: "ranking:s:success",
  worldId: "w",
  sittingId: "s",
  outcome: "success",
  body: { order: [["a"]], confirmed: true, based_on: 0, untouched: false, sitting: { id: "s", events: [{ n }] } },
});

test("an order that the server refuses is kept with all it said, until its page has read it", async () => {
  const stale = new ApiError({ status: 409, code: "stale_version", message: "another", fields: { version: "3" } });
  const { outbox, store, sent } = make([stale]);
  await outbox.add(ranking(4));
  await outbox.flush();
  const [{ refusal: words, status, code, fields }] = await store.all();
  assert.deepEqual([words, status, code, fields], ["another", 409, "stale_version", { version: "3" }]);
  await outbox.flush();
  assert.deepEqual(sent, ["ranking:s:success"]);
  await outbox.forget("ranking:s:success");
  assert.deepEqual(await store.all(), []);
});

test("an order confirmed again takes the place of the one that waits", async () => {
  const { outbox, store } = make([offline(), offline(), offline()]);
  await outbox.add(ranking(4));
  await outbox.add(ranking(9));
  assert.deepEqual(
    (await store.all()).map(({ body }) => body.sitting.events),
    [[{ n: 9 }]],
  );
});

test("a log that the server refuses is told, and over: its sitting still has it", async () => {
  const { outbox, store, news } = make([refusal(422)]);
  await outbox.add({ kind: "log", id: "log:s", worldId: "w", sittingId: "s", events: [{ n: 0 }] });
  await outbox.flush();
  assert.equal(news.at(-1), "refused log:s");
  assert.deepEqual(await store.all(), []);
});
