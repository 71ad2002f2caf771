import assert from "node:assert/strict";
import test from "node:test";
import { ApiError } from "#js/lib/api.js";
import { inTurns, Previews } from "#js/rankings/policy-previews.js";

const BUSY = new ApiError({ status: 503, code: "unavailable", message: "Busy." });
const TOO_SLOW = new ApiError({ status: 422, code: "too_slow", message: "Too slow." });
const soon = () => new Promise((resolve) => setTimeout(resolve, 5));
const about = (...ids) => ({ learner: "irlr", orders: { success: ids.map((id) => [id]) } });

/** A server whose answers are given by hand, and a note of what was heard. */
function makePreviews({ retryMs = 10_000 } = {}) {
  const asked = [];
  const heard = [];
  const post = (question, { signal }) =>
    new Promise((resolve, reject) => {
      signal.addEventListener("abort", () => reject(signal.reason));
      asked.push({ question, resolve, reject, signal });
    });
  const listener = {
    onAnswer: (preview) => heard.push(preview),
    onRefusal: (error) => heard.push(error.message),
    onAsking: (isAsking) => heard.push(isAsking ? "…" : "."),
  };
  return { asked, heard, post, previews: new Previews(post, listener, { retryMs }) };
}

test("the first question goes out at once; of those after it only the newest", async () => {
  const { asked, heard, previews } = makePreviews();
  previews.ask(about("a"));
  previews.ask(about("b"));
  previews.ask(about("c"));
  assert.equal(asked.length, 1, "one is on its way at most");
  asked[0].resolve("first");
  await soon();
  assert.deepEqual(asked[1].question, about("c"));
  asked[1].resolve("third");
  await soon();
  assert.deepEqual(heard, ["…", "first", "…", "third", "."]);
});

test("the same order is not asked about twice, and a former one is", async () => {
  const { asked, previews } = makePreviews();
  for (const id of ["a", "a", "b", "a"]) {
    previews.ask(about(id));
    asked.at(-1).resolve(id);
    await soon();
  }
  assert.deepEqual(
    asked.map(({ question }) => question),
    [about("a"), about("b"), about("a")],
  );
});

test("what is stopped is never heard of, and may be asked again", async () => {
  const { asked, heard, previews } = makePreviews();
  previews.ask(about("a"));
  previews.stop();
  assert.ok(asked[0].signal.aborted);
  previews.ask(about("a"));
  asked[0].resolve("late");
  asked[1].resolve("new");
  await soon();
  assert.deepEqual(heard, ["…", ".", "…", "new", "."]);
});

test("a refusal is told, unless something newer is to be asked", async () => {
  const { asked, heard, previews } = makePreviews();
  previews.ask(about("a"));
  previews.ask(about("b"));
  asked[0].reject(BUSY);
  await soon();
  asked[1].reject(TOO_SLOW);
  await soon();
  assert.deepEqual(heard, ["…", "…", "Too slow.", "."]);
  previews.ask(about("b"));
  assert.equal(asked.length, 3, "it is asked again when something brings it up");
});

test("a busy server is asked again after a while, one that will not is not", async () => {
  const { asked, heard, previews } = makePreviews({ retryMs: 1 });
  previews.ask(about("a"));
  asked[0].reject(BUSY);
  await soon();
  assert.equal(asked.length, 2);
  asked[1].resolve("well");
  await soon();
  assert.deepEqual(heard, ["…", "Busy.", ".", "…", "well", "."]);
  previews.ask(about("b"));
  asked[2].reject(TOO_SLOW);
  await soon();
  assert.equal(asked.length, 3);
});

test("two who ask take turns, also after a refusal", async () => {
  const { asked, post } = makePreviews();
  const { signal } = new AbortController();
  const turns = inTurns(post);
  const [first, second] = [turns(about("a"), { signal }), turns(about("b"), { signal })];
  await soon();
  assert.equal(asked.length, 1);
  asked[0].reject(BUSY);
  await assert.rejects(first);
  await soon();
  asked[1].resolve("second");
  assert.equal(await second, "second");
});
