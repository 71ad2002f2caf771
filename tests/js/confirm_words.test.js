/** What is said about confirming, word by word. */

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  agreementSentence,
  attemptWords,
  bothKeptSentence,
  cardsSentence,
  clockWords,
  confirmedSentence,
  conflictSentence,
  countsNowSentence,
  elsewhereSentence,
  movedWords,
  stateSentence,
  swappedSentence,
  takenAgainSentence,
  tookSentence,
  undecidedSentence,
  untouchedSentence,
  versionsSummary,
  versionWords,
} from "#js/rankings/confirm-words.js";

const PLAIN = { nCards: 6, canOrder: true, counts: {}, differs: [], onItsWay: [], trouble: null, lasts: true };
const at = (hours, minutes) => new Date(2026, 10, 22, hours, minutes);

test("the line beside the button says what counts and what has yet to be confirmed", () => {
  const both = ["success", "failure"];
  const cases = [
    [{ nCards: 0 }, ""],
    [{ differs: both }, "An order counts once you confirm it."],
    [{ canOrder: false }, "One attempt alone needs no order. Go on, or play more."],
    [
      { counts: { success: 2, failure: 1 } },
      "✓ Confirmed: version 2 of your successes and version 1 of your failures count. You can still change it.",
    ],
    [
      { counts: { success: 1, failure: 1 } },
      "✓ Confirmed: version 1 of your successes and of your failures counts. You can still change it.",
    ],
    [
      { counts: { success: 2, failure: 1 }, differs: ["success"] },
      "Your successes have changed since version 2. The new order counts once you confirm it.",
    ],
    [
      { counts: { success: 2, failure: 1 }, differs: both },
      "Your successes have changed since version 2 and your failures since version 1. The new order counts once you confirm it.",
    ],
    [{ differs: both, onItsWay: both }, "Sending the order of your successes and your failures …"],
  ];
  for (const [standing, sentence] of cases) assert.equal(stateSentence({ ...PLAIN, ...standing }), sentence);
});

test("an order that waits says why, where it is kept and that it is sent by itself", () => {
  const kept = "The order of your failures is kept in this browser and sent by itself; then it counts.";
  const cases = [
    [{ status: 0, retryAfterMs: null }, "The server cannot be reached just now."],
    [{ status: 503, retryAfterMs: null }, "The server is busy just now."],
    [{ status: 503, retryAfterMs: 20_000 }, "The server is busy and asked for 20 s."],
    [{ status: 429, retryAfterMs: 180_000 }, "The server is busy and asked for 3 min."],
    [{ status: 500, retryAfterMs: null }, "Something went wrong on the server."],
  ];
  const waiting = { ...PLAIN, differs: ["failure"], onItsWay: ["failure"] };
  for (const [trouble, why] of cases) assert.equal(stateSentence({ ...waiting, trouble }), `${why} ${kept}`);
  assert.equal(
    stateSentence({ ...waiting, trouble: { status: 0, retryAfterMs: null }, lasts: false }),
    "The server cannot be reached just now. The order of your failures is in this page alone, so keep it open: it is sent by itself; then it counts.",
  );
});

test("an untouched order is asked about in the words of its way", () => {
  const one = "They stand in a random order. Is it yours?";
  assert.equal(untouchedSentence(["success"], "lists"), `You have not moved anything in your successes. ${one}`);
  assert.equal(untouchedSentence(["failure"], "magnitude"), `You have not moved anything in your failures. ${one}`);
  assert.equal(untouchedSentence(["failure"], "pairwise"), `You have not compared anything in your failures. ${one}`);
  assert.equal(untouchedSentence(["success"], "segments"), `You have not marked anything in your successes. ${one}`);
  assert.equal(
    untouchedSentence(["success", "failure"], "lists"),
    "You have not moved anything in your successes or your failures. Both lists stand in a random order. Are they yours?",
  );
});

test("what was confirmed is told with its versions, and the way on once all is done", () => {
  assert.equal(confirmedSentence({ failure: 3 }, false), "Confirmed: version 3 of your failures counts.");
  assert.equal(
    confirmedSentence({ success: 1, failure: 1 }, true),
    "Confirmed: version 1 of your successes and of your failures counts. Next: Learn.",
  );
});

test("attempts that came or went are named, with what to do about them", () => {
  const news = (change) => cardsSentence({ outcome: "success", added: [], nRemoved: 0, nLeft: 5, ...change });
  assert.equal(
    news({ added: ["+2.1 in 12 steps"] }),
    "1 new success since this page was opened: +2.1 in 12 steps. It stands last: move it to its place.",
  );
  assert.equal(
    news({ added: ["a", "b", "c", "d", "e"], nLeft: 9 }),
    "5 new successes since this page was opened: a, b, c and 2 more. They stand last: move them to their places.",
  );
  assert.equal(news({ nRemoved: 1 }), "1 success was discarded meanwhile and has left its list.");
  assert.equal(
    news({ outcome: "failure", nRemoved: 2 }),
    "2 failures were discarded meanwhile and have left their list.",
  );
  assert.equal(news({ added: ["a"], nLeft: 1 }), "1 new success since this page was opened: a.");
});

test("an attempt is named with its total only where totals are shown", () => {
  const attempt = { total: 2.13, actions: [0, 1, 2] };
  assert.equal(attemptWords(attempt, true), "+2.1 in 3 steps");
  assert.equal(attemptWords(attempt, false), "3 steps");
});

test("two orders: what differs, what each choice does, and what counts in the end", () => {
  const conflict = { outcome: "success", version: 3, at: "10:42", n: 6 };
  assert.equal(
    conflictSentence({ ...conflict, nElsewhere: 4 }),
    "Version 3 was confirmed at 10:42, after this page was opened, perhaps in another tab. 4 of 6 stand elsewhere. Which order counts?",
  );
  assert.match(
    conflictSentence({ ...conflict, nElsewhere: 0 }),
    /in the same places; what was said beside that differs/,
  );
  assert.equal(
    bothKeptSentence(3),
    "Nothing is lost: if yours counts, version 3 is kept beside it; if you take the other one, Undo brings yours back.",
  );
  assert.equal(
    countsNowSentence("success", 4, 3),
    "Version 4 of your successes counts, the one on this page. Version 3 is kept beside it.",
  );
  assert.equal(
    tookSentence("success", 3),
    "Version 3 of your successes counts, and your list stands as in it. Undo brings your own order back.",
  );
  assert.equal(
    undecidedSentence("failure", 3),
    "Version 3 of your failures counts for now. Yours is as you left it; confirm again to decide.",
  );
  assert.equal(
    elsewhereSentence("failure", 2),
    "Version 2 of your failures was confirmed in another tab just now, and it counts. This page's order is as you left it; confirm it to choose between the two.",
  );
});

test("a card that stands elsewhere says how far, in a sign and in words", () => {
  assert.deepEqual(movedWords(0), { sign: "", words: "" });
  assert.deepEqual(movedWords(1), { sign: "▲ 1", words: ", 1 place higher than in the other" });
  assert.deepEqual(movedWords(-3), { sign: "▼ 3", words: ", 3 places lower than in the other" });
});

test("versions tell which counts, when each was confirmed and how", () => {
  const today = new Date();
  today.setHours(10, 42);
  const one = { version: 3, created_at: today.toISOString(), way: "pairwise", untouched: false };
  assert.equal(
    versionsSummary("success", one),
    "Successes: version 3 counts, confirmed 10:42 · 2 earlier ones are kept",
  );
  assert.equal(
    versionsSummary("failure", { ...one, version: 2 }),
    "Failures: version 2 counts, confirmed 10:42 · 1 earlier one is kept",
  );
  assert.equal(versionsSummary("failure", { ...one, version: 1 }), "Failures: version 1 counts, confirmed 10:42");
  assert.equal(versionWords(one, true), "Version 3 · 10:42 · two at a time · counts");
  assert.equal(
    versionWords({ ...one, way: "lists", untouched: true }, false),
    "Version 3 · 10:42 · in two lists · nothing moved",
  );
  assert.equal(
    takenAgainSentence({ outcome: "success", version: 1, nNew: 0 }),
    "Your successes stand as in version 1 again. It counts once you confirm it.",
  );
  assert.equal(
    takenAgainSentence({ outcome: "success", version: 1, nNew: 2 }),
    "Your successes stand as in version 1 again. 2 that are newer stand last. It counts once you confirm it.",
  );
});

test("a time of another day is told with its day", () => {
  assert.equal(clockWords(at(9, 5), at(18, 0)), "09:05");
  assert.equal(clockWords(at(9, 5), new Date(2026, 10, 24)), "22 Nov, 09:05");
});

test("agreement is told in pairs and as Kendall's tau-b, and blames nobody", () => {
  const told = { version: 1, tau_b: 0.7333, n_pairs: 15, n_agreeing: 13, n_swapped: 2, n_tied: 0, swapped: [] };
  assert.equal(
    agreementSentence(told),
    "Of 15 pairs you put 13 as their totals would, 2 the other way round. Kendall’s tau-b: 0.73.",
  );
  assert.equal(
    agreementSentence({ ...told, n_agreeing: 12, n_tied: 1 }),
    "Of 15 pairs you put 12 as their totals would, 2 the other way round, 1 is tied by you or by the totals. Kendall’s tau-b: 0.73.",
  );
  assert.equal(
    agreementSentence({ ...told, tau_b: null, n_pairs: 1, n_agreeing: 0, n_swapped: 0, n_tied: 1 }),
    "Of 1 pair you put 0 as their totals would, 1 is tied by you or by the totals. Kendall’s tau-b cannot be told where everything is tied.",
  );
  assert.equal(
    agreementSentence({ ...told, tau_b: -1, n_pairs: 1, n_agreeing: 0, n_swapped: 1 }),
    "Of 1 pair you put 0 as their totals would, 1 the other way round. Kendall’s tau-b: −1.00.",
  );
  assert.equal(swappedSentence("success", 0), "");
  assert.equal(
    swappedSentence("failure", 1),
    "This pair stands the other way round: by the totals, the lower one would be the worse one.",
  );
  assert.equal(
    swappedSentence("success", 2),
    "These pairs stand the other way round: by the totals, the lower one of each would be the better one.",
  );
});
