import assert from "node:assert/strict";
import { test } from "node:test";
import { cardWords, labelOf, placeWords, say, timeText, weightText } from "#js/rankings/sentences.js";

const CARD = {
  words: "Success with +8.8 in 12 steps",
  standing: { rank: 2, n: 6, nOthers: 0 },
  weight: "0.24",
  tiedWith: [],
};
const TIED = { ...CARD, standing: { rank: 2, n: 6, nOthers: 1 }, tiedWith: ["Success with +3.0 in 9 steps"] };

test("a card says its outcome, its total only where totals are shown, and its steps", () => {
  const one = { outcome: "success", total: 8.8, actions: Array(12).fill(1) };
  assert.equal(cardWords(one, true), "Success with +8.8 in 12 steps");
  assert.equal(cardWords(one, false), "Success in 12 steps");
  assert.equal(cardWords({ outcome: "failure", total: -3, actions: [1] }, true), "Failure with −3.0 in 1 step");
});

test("a place is said as people count, and who shares it", () => {
  assert.equal(placeWords({ rank: 2, n: 6, nOthers: 0 }), "place 2 of 6");
  assert.equal(placeWords({ rank: 2, n: 6, nOthers: 1 }), "place 2 of 6, shared with 1 other");
  assert.equal(placeWords({ rank: 2, n: 6, nOthers: 3 }), "place 2 of 6, shared with 3 others");
  assert.equal(labelOf("Success in 12 steps", CARD.standing), "Success in 12 steps, place 2 of 6");
});

test("weights have the digits that tell them apart, times the unit that fits", () => {
  assert.deepEqual([weightText(0.2857, 6), weightText(0.0488, 40)], ["0.29", "0.049"]);
  assert.deepEqual([[400, 2950], [9960], [60000, 5000]].map(timeText), ["3.4 s", "10 s", "1 min 5 s"]);
});

test("a time is never said as 60 seconds", () => {
  assert.deepEqual([[59600], [119700], [9940]].map(timeText), ["1 min 0 s", "2 min 0 s", "9.9 s"]);
});

test("what is announced, word by word", () => {
  assert.equal(
    say.lifted(CARD),
    "Lifted: Success with +8.8 in 12 steps, place 2 of 6. Arrows move it, T ties it with the one above, Space puts it down, Escape puts it back.",
  );
  assert.equal(say.stepped(CARD), "Place 2 of 6. Weight 0.24.");
  assert.equal(say.placed(CARD), "Success with +8.8 in 12 steps, place 2 of 6. Weight 0.24.");
  assert.equal(say.putDown(CARD), "Put down: Success with +8.8 in 12 steps, place 2 of 6. Weight 0.24.");
  assert.equal(say.putBack(CARD), "Put back: Success with +8.8 in 12 steps, place 2 of 6.");
  assert.equal(say.tied(TIED), "Tied with the success with +3.0 in 9 steps: place 2 of 6. Weight 0.24.");
  assert.equal(say.tied({ ...TIED, tiedWith: ["A", "B"] }), "Tied with 2 others: place 2 of 6. Weight 0.24.");
  assert.equal(say.parted(CARD), "No longer tied: place 2 of 6. Weight 0.24.");
  assert.equal(say.noFurther(-1), "It stands first already.");
  assert.equal(say.noFurther(1), "It stands last already.");
  assert.equal(
    say.marked(CARD, true),
    "To compare: Success with +8.8 in 12 steps. Press C on the other one; Escape forgets it.",
  );
  assert.equal(
    say.marked(CARD, false),
    "To compare: Success with +8.8 in 12 steps. Now press Compare on the other one.",
  );
});
