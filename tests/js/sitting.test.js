import assert from "node:assert/strict";
import test from "node:test";
import { dice } from "./random.js";
import { Browser, busy, contents, logOf, REDO, stateOf, UNDO } from "./sitting_house.js";

const typesOf = (log) => log.map(({ type }) => type);

test("it begins with the random order as drawn, and the server hears of it", async () => {
  const browser = new Browser();
  const tab = await browser.open("first");
  assert.equal(tab.order, "cba");
  const [begin] = logOf(browser, tab);
  assert.deepEqual(begin.from, { success: "random", failure: "random" });
  assert.deepEqual([begin.n, begin.at_ms, begin.based_on], [0, 0, { success: 0, failure: 0 }]);
});

test("what nothing comes of is no event, what cannot be is none, and listeners hear of the others", async () => {
  const tab = await new Browser().open("first");
  const heard = [];
  tab.sitting.subscribe((state, event) => heard.push([event.n, event.type, state === tab.sitting.state]));
  assert.ok(!tab.top("c"));
  assert.ok(!tab.sitting.do(REDO));
  assert.ok(!tab.top("x"));
  assert.ok(tab.top("a"));
  assert.ok(tab.sitting.do({ type: "watch", means: "mouse", id: "a" }));
  assert.deepEqual(heard, [
    [1, "place", true],
    [2, "watch", true],
  ]);
});

test("the server's log is what was done: in order, with its times, and it rebuilds the page", async () => {
  const browser = new Browser();
  const tab = await busy(browser);
  await tab.settle();
  const log = logOf(browser, tab);
  assert.deepEqual(typesOf(log), ["begin", "place", "place", "place", "place", "answer", "place", "undo", "undo"]);
  assert.deepEqual(
    log.map(({ n }) => n),
    [0, 1, 2, 3, 4, 5, 6, 7, 8],
  );
  assert.deepEqual(
    log.map(({ at_ms }) => at_ms),
    [0, 1000, 2000, 3000, 4000, 4000, 4000, 4000, 4000],
  );
  assert.deepEqual(stateOf(log), tab.sitting.state);
});

for (const isKilled of [false, true]) {
  test(`a page that is ${isKilled ? "killed" : "closed"} and opened again goes on, with undo and redo, and time goes on`, async () => {
    const browser = new Browser();
    const first = await busy(browser);
    const before = first.sitting.state;
    first.close({ isKilled });
    const second = await browser.open("second");
    assert.equal(second.sitting.id, first.sitting.id);
    assert.deepEqual(contents(second.sitting.state), contents(before));
    second.now = 500;
    assert.ok(second.sitting.do(REDO) && second.sitting.do(REDO) && second.sitting.do(UNDO));
    await second.settle();
    const log = logOf(browser, second);
    assert.deepEqual(typesOf(log.slice(-4)), ["resumed", "redo", "redo", "undo"]);
    assert.ok(log.at(-4).away_ms >= 0);
    assert.deepEqual(
      log.slice(-4).map(({ at_ms }) => at_ms),
      [4000, 4500, 4500, 4500],
    );
    assert.deepEqual(stateOf(log), second.sitting.state);
  });
}

test("killed after any event, it goes on from exactly there", async () => {
  for (let seed = 1; seed <= 40; seed += 1) {
    const rng = dice(seed);
    const browser = new Browser();
    const first = await browser.open("first");
    for (let n = rng.upTo(12); n > 0; n -= 1)
      rng.next() < 0.6 ? first.top(rng.of(["a", "b", "c"])) : first.sitting.do(rng.of([UNDO, REDO]));
    if (rng.next() < 0.5) await first.settle();
    first.close({ isKilled: true });
    const second = await browser.open("second");
    assert.deepEqual(contents(second.sitting.state), contents(first.sitting.state));
    await second.settle();
    assert.deepEqual(contents(stateOf(logOf(browser, second))), contents(second.sitting.state));
  }
});

test("a card that was lifted when the page went is put down where it was", async () => {
  const browser = new Browser();
  const first = await browser.open("first");
  first.sitting.do({ type: "lift", means: "key", outcome: "success", id: "a" });
  first.top("a");
  first.close({ isKilled: true });
  const { sitting, order } = await browser.open("second");
  assert.deepEqual([order, sitting.state.lifted, sitting.state.past.length], ["acb", null, 1]);
});

test("attempts that came and went meanwhile join and leave, and nothing else moves", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  first.close();
  browser.cards = { success: ["a", "c", "d"], failure: ["x", "y"] };
  const second = await browser.open("second");
  assert.equal(second.order, "cad");
  await second.settle();
  assert.deepEqual(logOf(browser, second).at(-1).added, ["d"]);
});

test("before there is anything to order the server hears nothing; then it begins with what was drawn", async () => {
  const browser = new Browser();
  const { cards } = browser;
  browser.cards = { success: [], failure: [] };
  const first = await browser.open("first");
  first.sitting.do({ type: "hidden", means: "page" });
  await first.settle();
  assert.deepEqual(browser.server.calls, []);
  first.close();
  browser.cards = cards;
  const second = await browser.open("second");
  await second.settle();
  assert.deepEqual(logOf(browser, second)[0].orders.success, [["c"], ["b"], ["a"]]);
});

test("a stranger finds nothing of it, and leaves it as it was", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  first.close();
  const { cards } = browser;
  browser.cards = { success: ["s"], failure: [] };
  const second = await browser.open("second");
  assert.equal(second.order, "s");
  await browser.parcels.add({
    kind: "ranking",
    id: "refused",
    worldId: "w",
    sittingId: first.sitting.id,
    outcome: "success",
    body: { order: first.sitting.orders.success, sitting: { id: first.sitting.id, events: [{ n: 0 }] } },
    refusal: "You have no such sitting.",
  });
  second.close();
  assert.equal((await browser.open("again")).sitting.id, second.sitting.id);
  browser.cards = cards;
  browser.entries.delete(second.sitting.id);
  assert.equal((await browser.open("third")).order, first.order);
});

test("a way that is no longer offered makes room for one that is", async () => {
  const browser = new Browser();
  (await busy(browser)).close();
  browser.ways = ["magnitude"];
  assert.equal((await browser.open("second")).sitting.state.way, "magnitude");
});

test("while another tab holds it this one begins its own", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  const second = await browser.open("second");
  assert.notEqual(second.sitting.id, first.sitting.id);
  assert.equal(second.order, "cba");
});

test("a storage that is damaged at any event goes on from the one before", async () => {
  for (const damage of [(event) => ({ ...event, id: "nobody" }), () => null, () => ({ n: 3 })]) {
    const browser = new Browser();
    browser.server.isAway = true;
    const first = await browser.open("first");
    for (const id of ["a", "b", "a", "c"]) first.top(id);
    first.close({ isKilled: true });
    const key = `${first.sitting.id} 3`;
    const damaged = damage(browser.events.get(key));
    if (damaged) browser.events.set(key, damaged);
    else browser.events.delete(key);
    assert.equal((await browser.open("second")).order, "bac", String(damage));
  }
});

test("a sitting without a beginning is set aside, and stops nobody", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  first.close();
  browser.events.delete(`${first.sitting.id} 0`);
  const second = await browser.open("second");
  assert.equal(second.order, "cba");
  assert.ok(browser.entries.get(first.sitting.id).isSetAside);
});

test("where the storage is full the page goes on; what it did not take survives the closing", async () => {
  const browser = new Browser();
  const first = await browser.open("first");
  browser.isFull = true;
  first.top("a");
  first.top("b");
  await first.settle();
  assert.equal(first.sitting.lasts, false);
  first.close();
  browser.isFull = false;
  assert.equal((await browser.open("second")).order, "bac");
});

test("where the storage fails once, in the middle of quick work, no step is missing between others", async () => {
  const browser = new Browser();
  const first = await browser.open("first");
  await first.settle();
  browser.nFailures = 1;
  first.top("a");
  first.top("b");
  await first.settle();
  first.close({ isKilled: true });
  assert.equal((await browser.open("second")).order, "bac");
});
