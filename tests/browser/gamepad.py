"""A gamepad that is not there: a stand-in for `navigator.getGamepads` that a test presses."""

from typing import Final

from playwright.sync_api import Page

BUTTONS: Final = {
    "A": 0,
    "B": 1,
    "X": 2,
    "Y": 3,
    "Back": 8,
    "Start": 9,
    "up": 12,
    "down": 13,
    "left": 14,
    "right": 15,
}
WAYS: Final = ("up", "right", "down", "left")

STAND_IN: Final = """
  const pad = {
    id: "Stand-in", index: 1, mapping: "standard", connected: false, timestamp: 0, axes: [0, 0, 0, 0],
    buttons: Array.from({ length: 17 }, () => ({ pressed: false, touched: false, value: 0 })),
  };
  let nReads = 0;
  navigator.getGamepads = () => {
    nReads += 1;
    return [null, pad.connected ? pad : null, null, null];
  };
  window.standInGamepad = {
    connect(isConnected) {
      pad.connected = isConnected;
      const event = new Event(isConnected ? "gamepadconnected" : "gamepaddisconnected");
      window.dispatchEvent(Object.assign(event, { gamepad: pad }));
    },
    set(button, isPressed) {
      pad.buttons[button] = { pressed: isPressed, touched: isPressed, value: Number(isPressed) };
      pad.timestamp = performance.now();
    },
    push(x, y) {
      pad.axes = [x, y, 0, 0];
      pad.timestamp = performance.now();
    },
    /** Two frames: one that may have begun already, and one that has read what was set. */
    seen: () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
    get nReads() { return nReads; },
  };
"""


class Gamepad:
    """Give it a page before the page goes anywhere; connect it once the page is there."""

    def __init__(self, page: Page) -> None:
        self._page = page
        page.add_init_script(STAND_IN)

    def connect(self) -> None:
        self._page.evaluate("standInGamepad.connect(true)")

    def disconnect(self) -> None:
        self._page.evaluate("standInGamepad.connect(false)")

    def press(self, button: str) -> None:
        """Down and up again, each long enough to be seen."""
        self.hold(button)
        self.release(button)

    def hold(self, button: str) -> None:
        self._set(button, pressed=True)

    def release(self, button: str) -> None:
        self._set(button, pressed=False)

    def push(self, x: float, y: float) -> None:
        """Push the left stick: right and down are positive."""
        self._page.evaluate("([x, y]) => { standInGamepad.push(x, y); return standInGamepad.seen(); }", [x, y])

    def walk(self, actions: list[int]) -> None:
        for action in actions:
            self.press(WAYS[action])

    def reads_in_ten_frames(self) -> int:
        """How often the page asked for gamepads during ten frames."""
        reads: int = self._page.evaluate("""async () => {
          const before = standInGamepad.nReads;
          for (let i = 0; i < 5; i += 1) await standInGamepad.seen();
          return standInGamepad.nReads - before;
        }""")
        return reads

    def _set(self, button: str, *, pressed: bool) -> None:
        script = "([button, isPressed]) => { standInGamepad.set(button, isPressed); return standInGamepad.seen(); }"
        self._page.evaluate(script, [BUTTONS[button], pressed])
