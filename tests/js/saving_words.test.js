import assert from "node:assert/strict";
import test from "node:test";
import { ApiError, retryAfterMs } from "#js/lib/api.js";
import { uuid } from "#js/lib/uuid.js";
import { damagedSentence, refusalSentence, savingNews, savingWords } from "#js/worlds/saving-words.js";

const calm = { nAttempts: 1, nWishes: 0, nUnstored: 0, nRefused: 0, trouble: null };

test("saved, saving, offline, busy and in memory alone have each a badge", () => {
  const words = (more) => savingWords({ ...calm, ...more });
  assert.deepEqual(words({ nAttempts: 0 }), { sync: "saved", badge: "✓ all saved", sentence: "" });
  assert.equal(words({ nAttempts: 0, nRefused: 2 }).badge, "2 not saved");
  assert.equal(words({}).badge, "saving 1 attempt …");
  assert.equal(words({ nAttempts: 0, nWishes: 2 }).badge, "saving 2 changes …");
  const gone = words({ nAttempts: 3, trouble: { status: 0, retryAfterMs: null } });
  assert.equal(gone.badge, "offline: 3 attempts kept");
  assert.match(gone.sentence, /kept in this browser and sent later/);
  const busy = words({ trouble: { status: 503, retryAfterMs: 20_000 } });
  assert.equal(busy.sync, "busy");
  assert.match(busy.sentence, /^The server is busy and asked for 20 s\. .* sends it again then\.$/);
  assert.match(words({ trouble: { status: 500, retryAfterMs: null } }).sentence, /wrong on the server/);
  const memory = words({ nUnstored: 1, trouble: { status: 0, retryAfterMs: null } });
  assert.equal(memory.badge, "keep this page open");
  assert.match(memory.sentence, /storage is full or closed/);
});

test("what changes is spoken once, what goes well is not", () => {
  const saved = savingWords({ ...calm, nAttempts: 0 });
  const waiting = savingWords(calm);
  const offline = savingWords({ ...calm, trouble: { status: 0, retryAfterMs: null } });
  assert.equal(savingNews(waiting, "saved"), "");
  assert.equal(savingNews(saved, "waiting"), "");
  assert.equal(savingNews(offline, "waiting"), offline.sentence);
  assert.equal(savingNews(offline, "offline"), "");
  assert.equal(savingNews(saved, "offline"), "Everything is saved again.");
});

test("a refused attempt says why, and that it is still there", () => {
  for (const parcel of [{ refusal: "Another attempt has this id already.", status: 409 }, { refusal: "Step 3 …" }]) {
    assert.match(refusalSentence(parcel), /stays in this browser: save it as a file, or forget it/);
  }
  assert.match(refusalSentence({ refusal: "Step 3 cannot be." }), /Step 3 cannot be\./);
});

test("damaged attempts are counted in words", () => {
  assert.match(damagedSentence(1), /^An unfinished attempt .* is damaged/);
  assert.match(damagedSentence(2), /^2 unfinished attempts .* are damaged/);
});

test("Retry-After is read as seconds or as a date, and never believed beyond ten minutes", () => {
  const now = Date.parse("Sun, 22 Nov 2026 08:00:00 GMT");
  assert.equal(retryAfterMs("20"), 20_000);
  assert.equal(retryAfterMs("Sun, 22 Nov 2026 08:00:30 GMT", now), 30_000);
  assert.equal(retryAfterMs("Sun, 22 Nov 2026 07:00:00 GMT", now), 0);
  assert.equal(retryAfterMs("86400"), 600_000);
  for (const none of [null, "", "soon"]) assert.equal(retryAfterMs(none), null);
  assert.equal(new ApiError({ status: 503, code: "busy", message: "" }).retryAfterMs, null);
});

test("ids are UUIDs of version 4, with and without crypto.randomUUID", () => {
  const shape = /^[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}$/;
  assert.match(uuid(), shape);
  const { randomUUID } = crypto;
  crypto.randomUUID = undefined;
  try {
    const ids = new Set(Array.from({ length: 1000 }, uuid));
    assert.equal(ids.size, 1000);
    for (const id of ids) assert.match(id, shape);
  } finally {
    crypto.randomUUID = randomUUID;
  }
});
