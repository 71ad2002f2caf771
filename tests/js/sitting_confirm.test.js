import assert from "node:assert/strict";
import test from "node:test";
import { dice } from "./random.js";
import { Browser, busy, contents, logOf, REDO, stateOf, UNDO } from "./sitting_house.js";

const MINE = { means: "button" };

test("a confirmed order resolves when the server has it, with the log up to there", async () => {
  const browser = new Browser();
  const tab = await busy(browser);
  const confirmed = tab.sitting.confirm("success", MINE);
  assert.deepEqual(tab.sitting.pending.success.order, tab.sitting.orders.success);
  await tab.settle();
  const { ranking } = await confirmed;
  assert.deepEqual([ranking.version, ranking.order, ranking.n_events], [1, tab.sitting.orders.success, 10]);
  assert.equal(logOf(browser, tab).at(-1).type, "confirm");
  assert.deepEqual(tab.sitting.pending, {});
});

test("both lists confirmed at once are both stored", async () => {
  const browser = new Browser();
  const tab = await busy(browser);
  const both = Promise.all(["success", "failure"].map((outcome) => tab.sitting.confirm(outcome, MINE)));
  await tab.settle();
  assert.deepEqual(
    (await both).map(({ ranking }) => [ranking.outcome, ranking.version]),
    [
      ["success", 1],
      ["failure", 1],
    ],
  );
});

test("confirmed again it is the next version, without a question", async () => {
  const browser = new Browser();
  const tab = await busy(browser);
  for (const [i, id] of ["a", "b", "c"].entries()) {
    tab.top(id);
    const confirmed = tab.sitting.confirm("success", MINE);
    await tab.settle();
    assert.equal((await confirmed).ranking.version, i + 1);
  }
});

test("offline it waits and says so; confirmed again meanwhile, the last one counts", async () => {
  const browser = new Browser();
  const tab = await busy(browser);
  await tab.settle();
  browser.server.isAway = true;
  let nTold = 0;
  tab.sitting.subscribeSaving(() => {
    nTold += 1;
  });
  const first = tab.sitting.confirm("success", MINE);
  await tab.settle();
  assert.deepEqual([tab.sitting.waiting?.status, nTold > 0], [0, true]);
  tab.top("b");
  const second = tab.sitting.confirm("success", MINE);
  await tab.settle();
  browser.server.isAway = false;
  await tab.settle();
  assert.deepEqual((await second).ranking.order, tab.sitting.orders.success);
  assert.deepEqual(await first, await second);
  assert.equal(tab.sitting.waiting, null);
  assert.equal(browser.server.versions.success.length, 1);
  assert.equal(logOf(browser, tab).filter(({ type }) => type === "confirm").length, 2);
});

test("confirmed again while one is on its way, each is a version, and the page waits for the last", async () => {
  const browser = new Browser();
  const tab = await busy(browser);
  await tab.settle();
  const [answer, seen] = [globalThis.fetch, []];
  let again;
  globalThis.fetch = async (url, options) => {
    if (/rankings/.test(url) && !again) {
      tab.top("b");
      again = tab.sitting.confirm("success", MINE).then(({ ranking }) => seen.push(ranking.version));
    }
    return answer(url, options);
  };
  const first = tab.sitting.confirm("success", MINE);
  await tab.settle();
  assert.deepEqual([(await first).ranking.version, seen, tab.sitting.pending], [2, [2], {}]);
  assert.deepEqual(browser.server.versions.success.at(-1).order, tab.sitting.orders.success);
});

test("a server that takes every log and finds that none leads to the order is asked twice", async () => {
  const browser = new Browser();
  const tab = await busy(browser);
  await tab.settle();
  const never = { path: /rankings/, status: 422, code: "log_differs" };
  browser.server.refusals.push(never, never, never, never);
  const { order } = tab;
  const confirmed = tab.sitting.confirm("success", MINE);
  await Promise.all([tab.settle(), assert.rejects(confirmed, { status: 422, code: "log_differs" })]);
  assert.deepEqual([browser.server.refusals.length, tab.order, tab.sitting.pending], [2, order, {}]);
});

test("what was confirmed offline before the page was closed is still known, and arrives", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  browser.server.isAway = true;
  void first.sitting.confirm("success", MINE);
  await first.settle();
  first.close();
  const second = await browser.open("second");
  assert.equal(second.sitting.id, first.sitting.id);
  const { done, order } = second.sitting.pending.success;
  assert.deepEqual(order, second.sitting.orders.success);
  browser.server.isAway = false;
  await second.settle();
  assert.equal((await done).ranking.version, 1);
  const confirmed = second.sitting.confirm("success", MINE);
  await second.settle();
  assert.equal((await confirmed).ranking.version, 2);
});

test("confirmed again after an answer that was lost, an order follows its own, whichever page sends it", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  const answer = globalThis.fetch;
  globalThis.fetch = async (url, options) => {
    await answer(url, options);
    throw new TypeError("the answer is lost");
  };
  void first.sitting.confirm("success", MINE);
  await first.settle();
  first.top("b");
  void first.sitting.confirm("success", MINE);
  first.close();
  globalThis.fetch = answer;
  const second = await browser.open("second");
  const [before, now] = browser.server.versions.success;
  assert.deepEqual([before.version, now.order], [1, second.sitting.orders.success]);
  assert.deepEqual((await second.atFirst.success.done).ranking, now);
});

test("what was refused while the page was closed is told to the next", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  browser.server.isAway = true;
  void first.sitting.confirm("success", MINE);
  await first.settle();
  first.close();
  browser.server.isAway = false;
  browser.server.refusals.push({ path: /rankings/, status: 409, code: "new_attempts", fields: { missing: "d" } });
  await first.outbox.flush();
  const second = await browser.open("second");
  await assert.rejects(second.atFirst.success.done, { status: 409, code: "new_attempts", fields: { missing: "d" } });
  assert.deepEqual([second.sitting.pending, await browser.parcels.all()], [{}, []]);
});

test("what was refused while another tab was at work is told to the next page all the same", async () => {
  const browser = new Browser();
  const [first, second] = [await busy(browser), await browser.open("second")];
  browser.server.isAway = true;
  void first.sitting.confirm("success", MINE);
  await first.settle();
  first.close();
  browser.server.isAway = false;
  browser.server.refusals.push({ path: /rankings/, status: 409, code: "stale_version", fields: { version: "1" } });
  second.top("c");
  await second.settle();
  second.close();
  browser.entries.get(second.sitting.id).savedAt += 1000;
  const third = await browser.open("third");
  assert.deepEqual([third.sitting.id, third.order], [first.sitting.id, first.order]);
  await assert.rejects(third.atFirst.success.done, { code: "stale_version" });
});

test("an order that is damaged where it waits stops no page", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  await first.settle();
  browser.server.isAway = true;
  void first.sitting.confirm("success", MINE);
  await first.settle();
  first.close();
  for (const damage of [{ order: null }, { sitting: { id: first.sitting.id, events: [] } }]) {
    const [parcel] = (await browser.parcels.all()).filter(({ kind }) => kind === "ranking");
    await browser.parcels.add({ ...parcel, body: { ...parcel.body, ...damage } });
    const next = await browser.open("next");
    assert.deepEqual([next.order, next.sitting.pending], [first.order, {}]);
    next.close();
  }
});

test("confirmed and acknowledged, the page opened anew begins anew, from what counts", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  for (const outcome of ["success", "failure"]) void first.sitting.confirm(outcome, MINE);
  await first.settle();
  first.sitting.do({ type: "hidden", means: "page" });
  first.close();
  const second = await browser.open("second");
  assert.notEqual(second.sitting.id, first.sitting.id);
  assert.deepEqual(second.sitting.orders, first.sitting.orders);
  const [begin] = logOf(browser, second);
  assert.deepEqual([begin.from.success, begin.based_on], ["version", { success: 1, failure: 1 }]);
  assert.equal(logOf(browser, first).at(-1).type, "hidden");
  assert.deepEqual([...browser.entries.keys()], [second.sitting.id]);
});

test("what was said beside a confirmed order is still there when the page is opened anew, also what was said since", async () => {
  const browser = new Browser();
  browser.ways = ["magnitude"];
  const first = await browser.open("first");
  const say = (value) =>
    first.sitting.do({ type: "gap", means: "key", outcome: "success", above: "c", below: "b", value });
  say(40);
  for (const outcome of ["success", "failure"]) void first.sitting.confirm(outcome, { ...MINE, untouched: true });
  await first.settle();
  say(60);
  first.close();
  const second = await browser.open("second");
  assert.deepEqual(second.sitting.state.present.gaps.success, [{ above: "c", below: "b", value: 60 }]);
  assert.equal(second.sitting.do(UNDO), true);
  assert.equal(second.sitting.state.present.gaps.success[0].value, 40);
});

test("where all that was confirmed was discarded, what came since is in the order drawn, and says so", async () => {
  const browser = new Browser();
  const first = await busy(browser);
  for (const outcome of ["success", "failure"]) void first.sitting.confirm(outcome, MINE);
  await first.settle();
  first.close();
  browser.entries.clear();
  browser.cards.success = ["d", "e"];
  const [begin] = logOf(browser, await browser.open("second"));
  assert.deepEqual([begin.orders.success, begin.from], [[["e"], ["d"]], { success: "random", failure: "version" }]);
});

test("a refusal rejects with what the server said, and the order stays", async () => {
  const browser = new Browser();
  const tab = await busy(browser);
  const { order } = tab;
  browser.server.refusals.push({ path: /rankings/, status: 422, code: "invalid", fields: { order: "discarded: a" } });
  const confirmed = tab.sitting.confirm("success", MINE);
  await Promise.all([
    tab.settle(),
    assert.rejects(confirmed, { status: 422, code: "invalid", fields: { order: "discarded: a" } }),
  ]);
  assert.deepEqual([tab.order, tab.sitting.pending, await browser.parcels.all()], [order, {}, []]);
});

test("two tabs: the second to confirm is asked, both versions stay, and each hears of the other", async () => {
  const browser = new Browser();
  const [first, second] = [await busy(browser, "first"), await browser.open("second")];
  const news = [];
  second.sitting.subscribeNews(({ outcome, ranking }) => news.push([outcome, ranking.version]));
  void first.sitting.confirm("success", MINE);
  await first.settle();
  assert.deepEqual(news, [["success", 1]]);
  second.top("b");
  const refused = assert.rejects(second.sitting.confirm("success", MINE), {
    status: 409,
    code: "stale_version",
    fields: { version: "1" },
  });
  await second.settle();
  await refused;
  const again = second.sitting.confirm("success", { ...MINE, basedOn: 1 });
  await second.settle();
  assert.equal((await again).ranking.version, 2);
  assert.equal(browser.server.versions.success.length, 2);
});

test("a server that has lost some of the log gets it again", async () => {
  const browser = new Browser();
  const tab = await busy(browser);
  await tab.settle();
  browser.server.logs.set(tab.sitting.id, logOf(browser, tab).slice(0, 3));
  tab.top("b");
  const confirmed = tab.sitting.confirm("success", MINE);
  await tab.settle();
  assert.equal((await confirmed).ranking.version, 1);
  assert.deepEqual(stateOf(logOf(browser, tab)), tab.sitting.state);
  browser.server.logs.clear();
  tab.top("a");
  await tab.settle();
  assert.deepEqual(stateOf(logOf(browser, tab)), tab.sitting.state);
});

for (const by of ["log", "order"]) {
  test(`where the server would not have the log (met by the ${by}) the work goes on in another sitting, and is confirmed in it`, async () => {
    const browser = new Browser();
    const tab = await busy(browser);
    const all = { means: "key", outcome: "success" };
    tab.sitting.do({ ...all, type: "answer", a: "a", b: "c", said: "alike" });
    tab.sitting.do({ ...all, type: "gap", above: "b", below: "a", value: 7 });
    tab.sitting.do({ ...all, type: "stretch", id: "a", from: 1, to: 2, kind: "good" });
    await tab.settle();
    const before = tab.sitting.id;
    const { present } = tab.sitting.state;
    const last = logOf(browser, tab).at(-1);
    browser.server.logs.get(before).push({ n: last.n + 1, at_ms: last.at_ms, type: "watch", means: "mouse", id: "a" });
    if (by === "log") {
      tab.sitting.do({ type: "watch", means: "mouse", id: "b" });
      await tab.settle();
    }
    const confirmed = tab.sitting.confirm("success", MINE);
    await tab.settle();
    assert.equal((await confirmed).ranking.version, 1);
    assert.notEqual(tab.sitting.id, before);
    assert.deepEqual(tab.sitting.state.present, present);
    assert.deepEqual(logOf(browser, tab)[0].from, { success: "draft", failure: "draft" });
    assert.deepEqual(stateOf(logOf(browser, tab)), tab.sitting.state);
    assert.ok(browser.entries.get(before).isSetAside);
  });
}

test("what the storage did not take of a sitting never gets into the one that goes on with its work", async () => {
  const browser = new Browser();
  const tab = await browser.open("tab");
  browser.isFull = true;
  for (const id of ["a", "b", "a", "b", "c"]) tab.top(id);
  browser.server.refusals.push({ path: /events/, status: 409, code: "conflict" });
  await tab.settle();
  browser.isFull = false;
  tab.top("a");
  await tab.settle();
  assert.deepEqual(await browser.shelf.events(tab.sitting.id), logOf(browser, tab));
});

test("a server that has no logs at all is asked no more than twice, and nothing on the page is lost", async () => {
  const browser = new Browser();
  const no = (status, code, fields) =>
    browser.server.refusals.push(...Array(9).fill({ path: /events/, status, code, fields }));
  no(422, "invalid", { events: "no" });
  const tab = await busy(browser);
  await tab.settle();
  tab.top("b");
  await tab.settle();
  assert.equal(browser.server.calls.length, 2);
  assert.equal(tab.order, "bca");
});

test("where the server does not know the browser any more the sitting stays as it is", async () => {
  const browser = new Browser();
  browser.server.refusals.push(...Array(9).fill({ path: /events/, status: 404, code: "not_found" }));
  const first = await busy(browser);
  await first.settle();
  const { id, state } = first.sitting;
  first.close();
  const second = await browser.open("second");
  assert.deepEqual([second.sitting.id, second.sitting.state.past.length], [id, state.past.length]);
});

test("a log longer than a call may be goes in several, the confirmation last", async () => {
  const browser = new Browser();
  const tab = await browser.open("first");
  browser.server.isAway = true;
  for (let i = 0; i < 700; i += 1) tab.top("abc"[i % 3]);
  const confirmed = tab.sitting.confirm("success", MINE);
  await tab.settle();
  browser.server.isAway = false;
  await tab.settle();
  assert.equal((await confirmed).ranking.n_events, 702);
  assert.deepEqual(stateOf(logOf(browser, tab)), tab.sitting.state);
});

test("every version that the server stored is what its log rebuilds, whatever was done", async () => {
  for (let seed = 1; seed <= 25; seed += 1) {
    const rng = dice(seed);
    const browser = new Browser();
    let tab = await browser.open("0");
    for (let n = 1; n < 25; n += 1) {
      const what = rng.upTo(9);
      if (what < 3) tab.top(rng.of(["a", "b", "c"]));
      else if (what < 5) tab.sitting.do(rng.of([UNDO, REDO]));
      else if (what < 6) void tab.sitting.confirm(rng.of(["success", "failure"]), MINE).catch(() => {});
      else if (what < 7) browser.server.isAway = !browser.server.isAway;
      else if (what < 8) await tab.settle();
      else {
        tab.close({ isKilled: rng.next() < 0.5 });
        tab = await browser.open(String(n));
      }
    }
    browser.server.isAway = false;
    await tab.settle();
    for (const { outcome, order, sitting_id, n_events } of Object.values(browser.server.versions).flat())
      assert.deepEqual(stateOf(browser.server.logs.get(sitting_id).slice(0, n_events)).present.orders[outcome], order);
    assert.deepEqual(contents(stateOf(logOf(browser, tab))), contents(tab.sitting.state));
    assert.deepEqual(await browser.parcels.all(), []);
  }
});
