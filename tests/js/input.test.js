import assert from "node:assert/strict";
import test, { mock } from "node:test";
import { Hold } from "#js/board/hold.js";
import { actionOf, commandOf, listenToKeys, listenToPointer } from "#js/board/input.js";

const [UP, RIGHT, DOWN, LEFT] = [0, 1, 2, 3];

/** A key event as browsers make them. */
function press(key, code, more = {}) {
  return Object.assign(new Event("keydown", { cancelable: true }), { key, code, repeat: false, ...more });
}

/** A player who writes down what happens, listening to a document of ours. */
function listening(options = {}) {
  globalThis.document = Object.assign(new EventTarget(), { open: [], querySelectorAll: () => document.open });
  globalThis.window = new EventTarget();
  globalThis.Element = class {};
  const told = [];
  const player = {
    move: (action, { device }) => told.push(`${device} ${action}`) < (options.until ?? Number.POSITIVE_INFINITY),
    command: (name) => told.push(name),
    look: (direction) => told.push(`look ${direction}`),
  };
  const life = new AbortController();
  listenToKeys(player, { signal: life.signal, ...options });
  return { told, life, down: (...event) => document.dispatchEvent(press(...event)), up };
}

function up(key, code) {
  document.dispatchEvent(Object.assign(new Event("keyup"), { key, code }));
}

test("arrows, the number pad's arrows, WASD and HJKL move", () => {
  const ways = { [UP]: "ArrowUp", [RIGHT]: "ArrowRight", [DOWN]: "ArrowDown", [LEFT]: "ArrowLeft" };
  for (const [action, key] of Object.entries(ways)) assert.equal(actionOf({ key, code: key }), Number(action));
  assert.equal(actionOf({ key: "ArrowUp", code: "Numpad8" }), UP);
  assert.deepEqual(
    ["w", "d", "s", "a"].map((key) => actionOf({ key, code: `Key${key.toUpperCase()}` })),
    [UP, RIGHT, DOWN, LEFT],
  );
  assert.deepEqual(
    ["k", "l", "j", "h"].map((key) => actionOf({ key, code: `Key${key.toUpperCase()}` })),
    [UP, RIGHT, DOWN, LEFT],
  );
});

test("WASD lies in the same place on every keyboard; HJKL and the commands are the letters printed", () => {
  assert.equal(actionOf({ key: "z", code: "KeyW" }), UP, "AZERTY: the key above the S");
  assert.equal(commandOf({ key: "z", code: "KeyW" }), undefined);
  assert.equal(commandOf({ key: "z", code: "KeyY" }), "undo", "QWERTZ");
  assert.equal(actionOf({ key: "h", code: "KeyJ" }), LEFT, "Dvorak");
  assert.equal(commandOf({ key: "R", code: "KeyR" }), "restart", "Caps Lock");
});

test("where the layout has no Latin letters, the place of the key decides", () => {
  assert.equal(actionOf({ key: "р", code: "KeyH" }), LEFT, "Cyrillic");
  assert.equal(commandOf({ key: "к", code: "KeyR" }), "restart", "Cyrillic");
  assert.equal(commandOf({ key: "γ", code: "KeyG" }), "giveUp", "Greek");
  assert.equal(commandOf({ key: "é", code: "KeyR" }), undefined, "a Latin letter is what it is");
});

test("one press is one step, however long the key is held", () => {
  const { told, down, life } = listening();
  down("ArrowRight", "ArrowRight");
  down("ArrowRight", "ArrowRight", { repeat: true });
  down("ArrowRight", "ArrowRight");
  up("ArrowRight", "ArrowRight");
  down("ArrowRight", "ArrowRight");
  assert.deepEqual(told, ["key 1", "key 1"]);
  life.abort();
});

test("shift looks around, and letters mean commands", () => {
  const { told, down, life } = listening();
  down("ArrowDown", "ArrowDown", { shiftKey: true });
  down("i", "KeyI");
  down("m", "KeyM");
  down("Backspace", "Backspace");
  assert.deepEqual(told, ["look 2", "where", "sound", "undo"]);
  life.abort();
});

test("a browser's shortcuts are left alone, and so is a dialog above the board", () => {
  const { told, down, life } = listening();
  down("r", "KeyR", { ctrlKey: true });
  document.open = [{}];
  down("ArrowDown", "ArrowDown");
  assert.deepEqual(told, []);
  life.abort();
});

test("a board in a dialog of its own hears its keys", () => {
  const root = {};
  const { told, down, life } = listening({ root });
  document.open = [root];
  down("ArrowDown", "ArrowDown");
  assert.deepEqual(told, ["key 2"]);
  life.abort();
});

test("keys that are held when the window loses the focus count as let go", () => {
  const { told, down, life } = listening();
  down("ArrowUp", "ArrowUp");
  window.dispatchEvent(new Event("blur"));
  down("ArrowUp", "ArrowUp");
  assert.deepEqual(told, ["key 0", "key 0"]);
  life.abort();
});

test("a held direction goes on only where a study wants it", (t) => {
  t.mock.timers.enable({ apis: ["setTimeout"] });
  const without = listening();
  without.down("ArrowUp", "ArrowUp");
  t.mock.timers.tick(1000);
  assert.deepEqual(without.told, ["key 0"]);
  without.life.abort();

  const held = listening({ holdToMove: true });
  held.down("ArrowUp", "ArrowUp");
  t.mock.timers.tick(219);
  assert.deepEqual(held.told, ["key 0"]);
  t.mock.timers.tick(1);
  t.mock.timers.tick(120);
  assert.deepEqual(held.told, ["key 0", "hold 0", "hold 0"]);
  up("ArrowUp", "ArrowUp");
  t.mock.timers.tick(1000);
  assert.equal(held.told.length, 3);
  held.life.abort();
});

test("a held direction stops at the end, at a command, in a dialog and when the focus leaves", (t) => {
  t.mock.timers.enable({ apis: ["setTimeout"] });
  const ways = {
    end: () => {},
    command: ({ down }) => down("r", "KeyR"),
    dialog: () => document.open.push({}),
    blur: () => window.dispatchEvent(new Event("blur")),
  };
  for (const [name, stop] of Object.entries(ways)) {
    const held = listening({ holdToMove: true, until: name === "end" ? 2 : undefined });
    held.down("ArrowUp", "ArrowUp");
    t.mock.timers.tick(220);
    stop(held);
    t.mock.timers.tick(2000);
    assert.deepEqual(
      held.told.filter((one) => one !== "restart"),
      ["key 0", "hold 0"],
      name,
    );
    held.life.abort();
  }
});

test("of two held directions the latest leads, and the first takes over again", (t) => {
  t.mock.timers.enable({ apis: ["setTimeout"] });
  const repeat = mock.fn(() => true);
  const hold = new Hold(repeat);
  hold.press("right", RIGHT);
  hold.press("down", DOWN);
  t.mock.timers.tick(220);
  hold.release("down");
  t.mock.timers.tick(120);
  hold.release("right");
  t.mock.timers.tick(1000);
  assert.deepEqual(
    repeat.mock.calls.map((call) => call.arguments[0]),
    [DOWN, RIGHT],
  );
});

/** A finger or a mouse on a board whose every point is square 5. */
function pointing(pointerType) {
  const told = [];
  const board = Object.assign(new EventTarget(), { stateAt: () => 5 });
  const player = {
    move: (action, { when, device }) => told.push([device, action, when]),
    tap: (state, { when, device }) => told.push([device, state, when]),
  };
  listenToPointer(board, player, new AbortController().signal);
  const send = (type, x, y) => {
    const about = { pointerType, pointerId: 1, isPrimary: true, button: 0, clientX: x, clientY: y };
    const event = Object.assign(new Event(type), about);
    board.dispatchEvent(event);
    return event.timeStamp;
  };
  return { told, send };
}

test("a swipe is one step, in the direction and at the time it became clear", () => {
  const { told, send } = pointing("touch");
  send("pointerdown", 100, 100);
  send("pointermove", 110, 102);
  const when = send("pointermove", 128, 104);
  send("pointermove", 190, 104);
  send("pointerup", 190, 104);
  assert.deepEqual(told, [["swipe", RIGHT, when]]);
});

test("a finger that is lifted where it lay, and a click, are taps", () => {
  for (const pointerType of ["touch", "mouse"]) {
    const { told, send } = pointing(pointerType);
    send("pointerdown", 100, 100);
    const when = send("pointerup", 103, 98);
    assert.deepEqual(told, [["tap", 5, when]]);
  }
});

test("a touch that the browser takes for something else is nothing", () => {
  const { told, send } = pointing("touch");
  send("pointerdown", 100, 100);
  send("pointercancel", 100, 100);
  send("pointerup", 100, 100);
  assert.deepEqual(told, []);
});
