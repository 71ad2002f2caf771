import assert from "node:assert/strict";
import test from "node:test";
import { Unfinished } from "#js/worlds/unfinished.js";

const WORLD = { id: "w" };

const draft = (id, nSteps, more = {}) => ({
  id,
  worldId: "w",
  actions: Array(nSteps).fill(1),
  stepMs: Array(nSteps).fill(250),
  slipSeeds: [[id, 0]],
  parentId: null,
  parentStep: 0,
  record: {},
  savedAt: 1,
  ...more,
});

/** One browser: its drafts, and what each tab holds. */
function makeBrowser(stored = []) {
  const drafts = new Map(stored.map((one) => [one.id, one]));
  const held = new Map();
  const writes = [];
  const gate = { open: Promise.resolve(), isFull: false };
  const straws = new Map();
  const lastStraw = {
    keep: (items) => [...items].map((one) => straws.set(one.id, one)),
    all: () => [...straws.values()],
    drop: (id) => void straws.delete(id),
  };
  /** As transactions are: done in the order in which they were asked for. */
  let last = Promise.resolve();
  const inTurn = (work) => {
    last = last.then(work, work);
    return last;
  };
  const store = {
    put: (one) => {
      browser.onPut(one);
      const copy = structuredClone(one);
      return inTurn(async () => {
        await gate.open;
        if (gate.isFull) throw new DOMException("no room", "QuotaExceededError");
        writes.push(`${one.id} ${one.actions?.length}`);
        drafts.set(one.id, copy);
      });
    },
    delete: (id) => inTurn(async () => void drafts.delete(id)),
    all: async () => [...drafts.values()],
  };
  /** @param {string} tab */
  const open = (tab) =>
    new Unfinished(WORLD, {
      drafts: store,
      lastStraw,
      quiet: async () => {},
      belongings: {
        has: (name) => held.get(name) === tab,
        take: async (name) => {
          if (!held.has(name)) held.set(name, tab);
          return held.get(name) === tab;
        },
        giveBack: (name) => void held.delete(name),
        ofOthers: async () => new Set([...held].filter(([, by]) => by !== tab).map(([name]) => name)),
      },
    });
  const close = (tab) => {
    for (const [name, by] of held) if (by === tab) held.delete(name);
  };
  const browser = { drafts, straws, writes, gate, open, close, onPut: (_one) => {} };
  return browser;
}

const settled = () => new Promise((resolve) => setTimeout(resolve, 5));

test("what a tab left is offered as far as it had come", async () => {
  const browser = makeBrowser();
  const first = browser.open("first");
  first.keep(draft("a", 1));
  first.keep(draft("a", 2));
  await settled();
  browser.close("first");
  const { drafts } = await browser.open("second").left();
  assert.deepEqual(
    drafts.map(({ id, actions }) => [id, actions.length]),
    [["a", 2]],
  );
});

test("what another tab is playing is not offered", async () => {
  const browser = makeBrowser();
  browser.open("first").keep(draft("a", 1));
  await settled();
  assert.deepEqual((await browser.open("second").left()).drafts, []);
});

test("two tabs never go on with the same attempt", async () => {
  const browser = makeBrowser([draft("a", 3)]);
  const [one, other] = [browser.open("one"), browser.open("other")];
  const [left] = await Promise.all([one.left(), other.left()]);
  assert.equal(left.drafts.length, 1);
  const taken = await Promise.all([one.take("a"), other.take("a")]);
  assert.deepEqual([taken[0]?.id, taken[1]], ["a", null]);
});

test("an attempt that another tab took up and ended since it was offered does not come back", async () => {
  const browser = makeBrowser([draft("a", 3)]);
  const [one, other] = [browser.open("one"), browser.open("other")];
  assert.equal((await one.left()).drafts.length, 1);
  await other.take("a");
  other.keep(draft("a", 4));
  other.drop("a");
  await settled();
  browser.close("other");
  assert.equal(await one.take("a"), null);
  assert.equal((await browser.open("third").left()).drafts.length, 0);
});

test("an attempt that another tab took up and left again goes on where that one stood", async () => {
  const browser = makeBrowser([draft("a", 3)]);
  const [one, other] = [browser.open("one"), browser.open("other")];
  await one.left();
  await other.take("a");
  other.keep(draft("a", 5));
  await settled();
  browser.close("other");
  assert.equal((await one.take("a"))?.actions.length, 5);
});

test("each step is on its way to the storage before its key press is over", async () => {
  const browser = makeBrowser();
  const tab = browser.open("tab");
  browser.gate.open = new Promise(() => {});
  const asked = [];
  browser.onPut = (one) => asked.push(one.actions.length);
  for (const n of [1, 2, 3]) tab.keep(draft("a", n));
  assert.deepEqual(asked, [1, 2, 3]);
});

test("steps of a long attempt that come while one is being written are written together, the last of them last", async () => {
  const browser = makeBrowser();
  const tab = browser.open("tab");
  let open = () => {};
  browser.gate.open = new Promise((resolve) => {
    open = resolve;
  });
  tab.keep(draft("a", 2001));
  await settled();
  for (const n of [2002, 2003, 2004]) tab.keep(draft("a", n));
  open();
  await settled();
  assert.deepEqual(browser.writes, ["a 2001", "a 2004"]);
});

test("a finished attempt is gone, even if a step of it was still to be written", async () => {
  const browser = makeBrowser();
  const tab = browser.open("tab");
  tab.keep(draft("a", 1));
  tab.keep(draft("a", 2));
  tab.drop("a");
  await settled();
  assert.deepEqual([...browser.drafts], []);
  assert.deepEqual((await browser.open("other").left()).drafts, []);
});

test("an attempt taken back to its start and begun again at once stays this tab's own", async () => {
  const browser = makeBrowser();
  const tab = browser.open("tab");
  tab.keep(draft("a", 1));
  await settled();
  tab.drop("a");
  tab.keep(draft("a", 1));
  await settled();
  assert.ok(browser.drafts.has("a"));
  assert.deepEqual((await browser.open("other").left()).drafts, []);
});

test("the newest comes first, and those of other worlds not at all", async () => {
  const stored = [draft("old", 1), draft("new", 2, { savedAt: 9 }), draft("else", 3, { worldId: "v" })];
  const { drafts } = await makeBrowser(stored).open("tab").left();
  assert.deepEqual(
    drafts.map(({ id }) => id),
    ["new", "old"],
  );
});

for (const [what, wrong] of [
  ["without actions", { actions: undefined }],
  ["with an action there is not", { actions: [1, 7, 1] }],
  ["with a time missing", { stepMs: [1] }],
  ["with times that are none", { stepMs: ["x", "y", "z"] }],
  ["with times that are nothing", { stepMs: [1, null, 3] }],
  ["with seeds that are none", { slipSeeds: [[5]] }],
  ["with the seeds of another", { slipSeeds: [["z", 0]] }],
  ["copied beyond its length", { parentId: "p", parentStep: 9 }],
  ["of a time that is none", { savedAt: "yesterday" }],
]) {
  test(`a draft ${what} is set aside, counted once, and kept`, async () => {
    const browser = makeBrowser([draft("a", 3, wrong), draft("b", 1)]);
    const left = await browser.open("tab").left();
    assert.deepEqual([left.drafts.map(({ id }) => id), left.nDamaged], [["b"], 1]);
    assert.equal((await browser.open("tab").left()).nDamaged, 0);
    assert.ok(browser.drafts.get("a").isSetAside);
  });
}

test("a full storage is noticed, and costs nothing but the keeping", async () => {
  const browser = makeBrowser();
  const tab = browser.open("tab");
  browser.gate.isFull = true;
  tab.keep(draft("a", 1));
  await settled();
  assert.equal(tab.lasts, false);
  browser.gate.isFull = false;
  tab.keep(draft("a", 2));
  await settled();
  assert.equal(tab.lasts, true);
  assert.equal(browser.drafts.get("a").actions.length, 2);
});

test("what the storage was too slow to take survives the closing of the page", async () => {
  const browser = makeBrowser();
  const tab = browser.open("tab");
  browser.gate.isFull = true;
  tab.keep(draft("a", 3));
  await settled();
  tab.rescue();
  browser.close("tab");
  browser.gate.isFull = false;
  const { drafts } = await browser.open("next").left();
  assert.deepEqual(
    drafts.map(({ id, actions }) => [id, actions.length]),
    [["a", 3]],
  );
  assert.deepEqual([...browser.straws], []);
});

test("what is finished after all leaves no straw behind", async () => {
  const browser = makeBrowser();
  const tab = browser.open("tab");
  browser.gate.isFull = true;
  tab.keep(draft("a", 3));
  await settled();
  tab.rescue();
  tab.drop("a");
  tab.rescue();
  await settled();
  assert.deepEqual([...browser.straws], []);
});
