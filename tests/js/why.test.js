import assert from "node:assert/strict";
import test from "node:test";
import { readShown, writeShown } from "#js/comparisons/why/address.js";
import { Asking } from "#js/comparisons/why/asking.js";
import { attemptsOf, canBeCalledOtherwise, changedPlay, partnersOf } from "#js/comparisons/why/attempts.js";
import { squarePath } from "#js/comparisons/why/marks.js";
import { ApiError } from "#js/lib/api.js";

const played = (id, outcome, more = {}) => ({ id, outcome, ending: "goal", discarded: false, states: [0, 1], ...more });
const ranked = (...order) => ({ order });
const busy = () => new ApiError({ status: 503, code: "unavailable", message: "Busy." });

test("attempts stand as they were ordered, ties as they were placed, what is in no order as it was played", () => {
  const demonstrations = [
    played("f1", "failure"),
    played("a", "success"),
    played("b", "success"),
    played("c", "success"),
    played("f2", "failure"),
    played("gone", "success", { discarded: true }),
  ];
  const attempts = attemptsOf({ demonstrations, rankings: { success: ranked(["c"], ["a", "b"]), failure: null } });
  assert.deepEqual(
    attempts.map(({ id, place, count, isOrdered }) => [id, place, count, isOrdered]),
    [
      ["c", 1, 3, true],
      ["a", 2, 3, true],
      ["b", 3, 3, true],
      ["f1", 1, 2, false],
      ["f2", 2, 2, false],
    ],
  );
  assert.deepEqual(attempts[1].tiedWith, ["b"]);
});

test("only attempts of one order can trade places, and only who reached the goal is called a success", () => {
  const demonstrations = [
    played("a", "success"),
    played("b", "success"),
    played("f1", "failure"),
    played("f2", "failure", { ending: "gave_up" }),
  ];
  const attempts = attemptsOf({ demonstrations, rankings: { success: ranked(["a"], ["b"]), failure: null } });
  const [a, , f1, f2] = attempts;
  assert.deepEqual(
    partnersOf(attempts, a).map(({ id }) => id),
    ["b"],
  );
  assert.deepEqual(partnersOf(attempts, f1), []);
  assert.deepEqual([a, f1, f2].map(canBeCalledOtherwise), [true, true, false]);
});

test("the attempts after a change: one fewer, one called otherwise, the same that trade places", () => {
  const demonstrations = [played("a", "success"), played("f", "failure")];
  const told = (change) => changedPlay(demonstrations, change).map(({ id, outcome }) => `${id} ${outcome}`);
  assert.deepEqual(told({ drop: "a" }), ["f failure"]);
  assert.deepEqual(told({ relabel: "f" }), ["a success", "f success"]);
  assert.deepEqual(told({ swap: ["a", "f"] }), ["a success", "f failure"]);
});

test("a link says what stands open, and reads back the same", () => {
  const shown = { learner: "irlfr", open: ["mattered", "what-if"], change: { swap: ["a-1", "b-2"] } };
  assert.equal(writeShown(shown), "#why=irlfr&open=mattered,what-if&swap=a-1&with=b-2");
  assert.deepEqual(readShown(writeShown(shown)), shown);
  for (const change of [{ drop: "x" }, { relabel: "x" }, null])
    assert.deepEqual(readShown(writeShown({ ...shown, change })), { ...shown, change });
});

test("nothing open is no fragment, and what others write there is left alone", () => {
  assert.equal(writeShown({ learner: "irlfr", open: [], change: { drop: "x" } }), "");
  assert.equal(readShown("#table-title"), null);
  assert.deepEqual(readShown("#why=irlfr&open=doubt,nonsense&swap=alone"), {
    learner: "irlfr",
    open: ["doubt"],
    change: null,
  });
});

/** @param {number[]} [pausesMs] */
function listening(pausesMs = []) {
  const heard = [];
  const asking = new Asking(
    {
      wait: () => heard.push("wait"),
      answer: (answer) => heard.push(answer),
      fail: ({ sentence, mayRetry }) => heard.push(`${sentence} ${mayRetry}`),
    },
    pausesMs,
  );
  return { asking, heard };
}

/** A server that answers when it is told to. */
function slowServer() {
  const waiting = [];
  const send = ({ signal }) => new Promise((resolve, reject) => waiting.push({ resolve, reject, signal }));
  return { waiting, send };
}
const settled = () => new Promise((resume) => setImmediate(resume));

test("the newest question wins: the answer to an older one is never heard", async () => {
  const { asking, heard } = listening();
  const { waiting, send } = slowServer();
  asking.ask("old", send);
  asking.ask("new", send);
  assert.equal(waiting[0].signal.aborted, true);
  waiting[1].resolve("to the new");
  waiting[0].resolve("to the old");
  await settled();
  assert.deepEqual(heard, ["wait", "wait", "to the new"]);
});

test("what was answered is not asked again: its answer stands, or comes back at once", async () => {
  const { asking, heard } = listening();
  const never = () => assert.fail("asked again");
  asking.ask("one", async () => "first");
  await settled();
  asking.ask("one", never);
  asking.ask("two", async () => "second");
  await settled();
  asking.ask("one", never);
  asking.stop();
  asking.ask("one", never);
  assert.deepEqual(heard, ["wait", "first", "wait", "second", "first", "first"]);
});

test("who goes back to the answer that stands does not wait for the other any more", async () => {
  const { asking, heard } = listening();
  const { waiting, send } = slowServer();
  asking.ask("one", async () => "first");
  await settled();
  asking.ask("two", send);
  asking.ask("one", send);
  waiting[0].resolve("second");
  await settled();
  assert.deepEqual([waiting.length, heard], [1, ["wait", "first", "wait", "first"]]);
});

test("a question under way is not asked twice", async () => {
  const { asking, heard } = listening();
  const { waiting, send } = slowServer();
  asking.ask("one", send);
  asking.ask("one", send);
  waiting[0].resolve("answer");
  await settled();
  assert.deepEqual([waiting.length, heard], [1, ["wait", "answer"]]);
});

test("a busy server is asked again by itself, then by who presses the button", async () => {
  const { asking, heard } = listening([0, 0]);
  let calls = 0;
  asking.ask("one", async () => {
    calls += 1;
    if (calls < 4) throw busy();
    return "at last";
  });
  while (heard.length < 2) await settled();
  assert.deepEqual([calls, heard], [3, ["wait", "Busy. true"]]);
  asking.again();
  await settled();
  assert.deepEqual(heard, ["wait", "Busy. true", "wait", "at last"]);
});

test("what cannot be learned, and a run that is gone, is said once and not asked again", async () => {
  const { asking, heard } = listening([0]);
  const refusing = (status, message) => async () => {
    throw new ApiError({ status, code: "", message });
  };
  asking.ask("one", refusing(422, "IRLF needs a success."));
  await settled();
  asking.ask("two", refusing(404, "There is no such run here."));
  await settled();
  assert.deepEqual(heard, [
    "wait",
    "IRLF needs a success. false",
    "wait",
    "This run is no longer there: it was deleted, or its link was taken back. false",
  ]);
});

test("a question that another took the place of may be asked again", async () => {
  const { asking, heard } = listening();
  asking.ask("one", async () => {
    throw new ApiError({ status: 409, code: "superseded", message: "Something newer was asked for." });
  });
  await settled();
  assert.deepEqual(heard, ["wait", "Something newer was asked for. true"]);
});

test("marks lie inside their squares, row by row", () => {
  assert.equal(squarePath({ cols: 3 }, [0, 4], 0.25), "M0.25,0.25h0.5v0.5h-0.5zM1.25,1.25h0.5v0.5h-0.5z");
});
