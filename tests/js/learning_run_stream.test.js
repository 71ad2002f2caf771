import assert from "node:assert/strict";
import test from "node:test";
import { RunStream } from "#js/learning/run-stream.js";

/** The browser's EventSource as the test plays it. */
class FakeSource extends EventTarget {
  static CONNECTING = 0;
  static OPEN = 1;
  static CLOSED = 2;
  static all = [];
  readyState = 0;

  constructor(address) {
    super();
    this.address = address;
    FakeSource.all.push(this);
  }

  close() {
    this.readyState = FakeSource.CLOSED;
  }

  send(kind, data) {
    this.dispatchEvent(Object.assign(new Event(kind), { data: JSON.stringify(data) }));
  }

  fail(readyState) {
    this.readyState = readyState;
    this.dispatchEvent(new Event("error"));
  }
}

/** A page with a stream; what it heard, and the pauses it made, which end when the test says so. */
function make(answers = {}) {
  FakeSource.all = [];
  const pauses = [];
  const heard = [];
  const document = Object.assign(new EventTarget(), { visibilityState: "visible" });
  const window = Object.assign(new EventTarget(), { setTimeout: (act, ms) => pauses.push({ act, ms }) });
  Object.assign(globalThis, { EventSource: FakeSource, document, window, location: { search: "" } });
  globalThis.fetch = async (path) => {
    const answer = answers[path.split("/").at(-1)];
    if (answer === undefined) throw new TypeError("no network");
    return new Response(JSON.stringify(answer), { status: answer.error ? 404 : 200 });
  };
  const kinds = ["snapshot", "frame", "progress", "learner", "queue", "end", "connection"];
  const listener = Object.fromEntries(kinds.map((kind) => [kind, (...told) => heard.push([kind, ...told])]));
  const stream = new RunStream(listener, new AbortController().signal);
  return { stream, heard, pauses, answers, document, newest: () => FakeSource.all.at(-1) };
}

const settled = () => new Promise((resolve) => setTimeout(resolve, 0));

test("all runs of a page come by one connection, each event to its run", () => {
  const { stream, heard, newest } = make();
  stream.follow(["a", "b"], ["a"]);
  stream.follow(["a", "b"], ["a"]);
  assert.equal(FakeSource.all.length, 1);
  assert.equal(newest().address, "/api/v1/events?run=a&run=b&frames=a");
  newest().send("frame", { run_id: "a", number: 1, learner: "meirl" });
  newest().send("progress", { run_id: "b", number: 4, learner: "irlr", iteration: 3, iterations: 9 });
  newest().send("queue", { run_id: "b", ahead: 1, worker: "ready" });
  assert.deepEqual(heard, [
    ["frame", "a", { number: 1, learner: "meirl" }],
    ["progress", "b", { number: 4, learner: "irlr", iteration: 3, iterations: 9 }],
    ["queue", "b", { ahead: 1, worker: "ready" }],
  ]);
});

test("the connection is closed with the last run's end, or the browser would come back for ever", () => {
  const { stream, heard, newest } = make();
  stream.follow(["a", "b"], []);
  newest().send("done", { run_id: "a", status: "done", number: 9 });
  assert.notEqual(newest().readyState, FakeSource.CLOSED);
  newest().send("failed", { run_id: "b", status: "deleted", message: "It was deleted." });
  assert.equal(newest().readyState, FakeSource.CLOSED);
  assert.deepEqual(heard.at(-1), ["end", "b", "deleted", "It was deleted.", null]);
});

test("a snapshot of a run that has ended is its end", () => {
  const { stream, heard, newest } = make();
  stream.follow(["a"], ["a"]);
  newest().send("snapshot", { run_id: "a", status: "done", reason: null, number: 12, latest: {} });
  newest().send("done", { run_id: "a", status: "done", number: 12 });
  assert.deepEqual(
    heard.map(([kind]) => kind),
    ["snapshot", "end"],
  );
});

test("while the browser tries again by itself the page only says so", () => {
  const { stream, heard, newest } = make();
  stream.follow(["a"], ["a"]);
  newest().fail(FakeSource.CONNECTING);
  assert.deepEqual(heard, [["connection", false]]);
  assert.equal(FakeSource.all.length, 1);
});

test("where the browser gives up, the page asks how the runs stand and goes on with those that go on", async () => {
  const { stream, heard, pauses, newest } = make({ a: { status: "running" }, b: { status: "done", reason: null } });
  stream.follow(["a", "b"], ["a"]);
  newest().fail(FakeSource.CLOSED);
  await settled();
  assert.deepEqual(heard, [["end", "b", "done", "", null]]);
  pauses.shift().act();
  assert.equal(newest().address, "/api/v1/events?run=a&frames=a");
});

test("a run that is not there any more was deleted; the page waits longer and longer for a server that is away", async () => {
  const { stream, heard, pauses, answers, newest } = make();
  stream.follow(["a"], ["a"]);
  const waits = [];
  for (let i = 0; i < 6; i++) {
    newest().fail(FakeSource.CLOSED);
    await settled();
    const { act, ms } = pauses.shift();
    waits.push(ms);
    act();
  }
  assert.deepEqual(waits, [500, 1000, 2000, 4000, 8000, 8000]);
  answers.a = { error: { code: "not_found", message: "There is no such run here." } };
  newest().fail(FakeSource.CLOSED);
  await settled();
  assert.deepEqual(heard.at(-1), ["end", "a", "deleted", "There is no such run here.", null]);
});

test("a page that is seen again begins anew where its connection died in its sleep", () => {
  const { stream, document, newest } = make();
  stream.follow(["a"], ["a"]);
  const first = newest();
  first.readyState = FakeSource.OPEN;
  first.send("queue", { run_id: "a", ahead: 0 });
  document.dispatchEvent(new Event("visibilitychange"));
  assert.equal(newest(), first, "it has just been heard");
  first.readyState = FakeSource.CLOSED;
  document.visibilityState = "hidden";
  document.dispatchEvent(new Event("visibilitychange"));
  assert.equal(newest(), first, "nobody sees it");
  document.visibilityState = "visible";
  document.dispatchEvent(new Event("visibilitychange"));
  assert.notEqual(newest(), first);
});
