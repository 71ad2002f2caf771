"""What the board promises on every page: motion, effects, the trail, the close-up, the board as text."""

from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from tests.browser.conftest import watched

#: Puts a board of its own on the page and hands it to the function that follows, with the means to wait for a frame.
STAGE = """
async ({ n, width, argument }) => {
  await import("#js/elements/irl-board.js");
  const rows = (of) => Array.from({ length: n }, (_, row) => Array.from({ length: n }, (_, col) => of(row * n + col)));
  const goal = n * n - 1;
  const reward = (state) => (state === goal ? 2 * n : -((state * 37) % 70) / 10);
  const colour = (state) => (state === goal ? "goal" : reward(state) < -1 ? "red" : "blue");
  const world = { id: "of-this-test", slip: 0, horizon: 2 * n * n, rows: n, cols: n, start: 0,
                  goal, goals: [goal], walls: [], rewards: rows(reward), colours: rows(colour) };
  const board = document.createElement("irl-board");
  board.style.inlineSize = `${width}px`;
  board.world = world;
  document.body.prepend(board);
  const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
  const stand = (state, more = {}) => {
    board.view = { ...more, agents: [{ state, who: "human", facing: 1 }] };
  };
  const agent = () => {
    const [box, stage] = [".agent", ".board-stage"].map((name) => board.querySelector(name).getBoundingClientRect());
    return { x: box.x - stage.x, y: box.y - stage.y };
  };
  stand(0);
  await frame();
  await frame();
  return await (ACTION)({ world, board, frame, stand, agent, argument });
}
"""


def on_a_board(page: Page, action: str, *, n: int = 7, width: int = 350, argument: object = None) -> Any:
    page.goto("/docs")
    return page.evaluate(STAGE.replace("ACTION", action), {"n": n, "width": width, "argument": argument})


WALK = """
async ({ frame, stand, agent }) => {
  const places = [agent()];
  stand(1);
  await frame();  // the board's own callback came first: it asked for this frame before we did
  places.push(agent());
  stand(8);
  await frame();
  places.push(agent());
  for (let i = 0; i < 12; i++) await frame();
  places.push(agent());
  return places;
}
"""


def test_the_first_frame_after_a_step_shows_the_agent_on_its_way(page: Page) -> None:
    start, first, interrupted, last = on_a_board(page, WALK)
    assert start == {"x": 0, "y": 0}
    assert 10 < first["x"] < 50
    assert first["y"] == 0
    # The next step takes it from where it is drawn: never back, never first to the square it was bound for.
    assert first["x"] <= interrupted["x"] < 50
    assert interrupted["y"] > 10
    assert last == {"x": 50, "y": 50}


def test_with_reduced_motion_a_step_is_there_at_once(browser: Browser, base_url: str) -> None:
    context = browser.new_context(base_url=base_url, reduced_motion="reduce")
    page = context.new_page()
    with watched(page, base_url):
        _, first, second, _ = on_a_board(page, WALK)
        assert (first, second) == ({"x": 50, "y": 0}, {"x": 50, "y": 50})
    context.close()


def test_a_jump_is_no_walk(page: Page) -> None:
    """Another attempt begins, a replay starts over: the agent does not fly across the board."""
    action = "async ({ frame, stand, agent }) => { stand(24); await frame(); return agent(); }"
    assert on_a_board(page, action) == {"x": 150, "y": 150}


def test_a_board_says_when_its_view_was_painted(page: Page) -> None:
    action = """
    async ({ board, frame, stand }) => {
      const before = board.paintedAt;
      stand(1);
      const waiting = board.paintedAt;
      const now = await frame();
      const painted = board.paintedAt;
      await frame();
      return { before, isWaiting: Number.isNaN(waiting), late: painted - now, after: board.paintedAt - painted };
    }
    """
    found = on_a_board(page, action)
    assert found["before"] > 0
    assert (found["isWaiting"], found["late"], found["after"]) == (True, 0, 0)


def test_figures_that_come_and_go_leave_it_as_it_was(page: Page) -> None:
    action = """
    async ({ board, frame }) => {
      const before = board.paintedAt;
      board.view = { ...board.view, numbers: true };
      const waiting = board.paintedAt;
      await frame();
      return [waiting - before, board.paintedAt - before];
    }
    """
    assert on_a_board(page, action) == [0, 0]


def test_costs_in_quick_succession_take_each_others_place(page: Page) -> None:
    action = """
    async ({ board, frame }) => {
      const seen = [];
      for (let i = 0; i < 8; i++) {
        board.float(i, `−${i}.0`, "loss");
        const notes = [...board.querySelectorAll(".board-float")];
        seen.push([notes.length, notes[0].textContent, Number(getComputedStyle(notes[0]).opacity)]);
        await frame();
      }
      return seen;
    }
    """
    seen = on_a_board(page, action)
    assert [(count, text) for count, text, _ in seen] == [(1, f"−{i}.0") for i in range(8)]
    assert [opacity for *_, opacity in seen] == [0, *[1] * 7], "one that follows closely does not fade in again"


def test_joy_is_over_within_a_second_and_stands_still_with_reduced_motion(
    page: Page, browser: Browser, base_url: str
) -> None:
    action = """
    async ({ board, frame }) => {
      board.celebrate(48);
      board.celebrate(48);
      await frame();
      const [animation, ...more] = board.querySelector(".board-joy").getAnimations();
      const moves = new Set(animation.effect.getKeyframes().map((one) => one.transform));
      const found = { ms: animation.effect.getComputedTiming().endTime, nMore: more.length, nMoves: moves.size };
      animation.finish();
      await frame();
      return { ...found, isGone: board.querySelector(".board-joy") === null };
    }
    """
    found = on_a_board(page, action)
    assert found["ms"] <= 1000
    assert (found["nMore"], found["isGone"]) == (0, True)
    assert found["nMoves"] > 1
    context = browser.new_context(base_url=base_url, reduced_motion="reduce")
    assert on_a_board(context.new_page(), action)["nMoves"] == 1
    context.close()


@pytest.mark.parametrize("mark", ["joy", "bump"])
def test_joy_and_bumps_stay_behind_nobody(page: Page, mark: str) -> None:
    """Else one would fail under the last success's sun, or see a wall where none is."""
    action = """
    async ({ board, stand, argument }) => {
      const isThere = () => board.querySelector(`.board-${argument}`) !== null;
      stand(48);
      if (argument === "joy") board.celebrate(48);
      else board.bump(1);
      stand(48, { numbers: true });
      const before = isThere();
      stand(0);
      return [before, isThere()];
    }
    """
    assert on_a_board(page, action, argument=mark) == [True, False]


def test_a_cursor_marks_a_square_and_goes_with_the_world(page: Page) -> None:
    action = """
    async ({ board, world }) => {
      board.cursor = 9;
      const cursor = board.querySelector(".board-cursor");
      const [mark, stage] = [cursor, board.querySelector(".board-stage")].map((one) => one.getBoundingClientRect());
      const at = [mark.x - stage.x, mark.y - stage.y, mark.width];
      const { borderTopColor, outlineColor } = getComputedStyle(cursor);
      board.world = { ...world };
      return { at, colours: [borderTopColor, outlineColor], left: [board.cursor, cursor.isConnected] };
    }
    """
    found = on_a_board(page, action)
    assert found["at"] == [100, 50, 50]
    assert found["colours"] == ["rgb(22, 25, 27)", "rgb(255, 255, 255)"]
    assert found["left"] == [None, False]


def test_in_forced_colours_agent_cursor_and_focus_keep_their_outlines(browser: Browser, base_url: str) -> None:
    action = """
    async ({ board }) => {
      board.tabIndex = 0;
      board.focus();
      board.cursor = 9;
      const style = (name) => getComputedStyle(board.querySelector(name));
      const agent = style(".agent-body");
      const ring = style(".board-stage");
      const cursor = style(".board-cursor");
      return { agent: [agent.fill, agent.stroke], ring: [ring.outlineStyle, ring.outlineWidth],
               cursor: [cursor.borderTopColor, cursor.outlineColor] };
    }
    """
    context = browser.new_context(base_url=base_url, forced_colors="active")
    found = on_a_board(context.new_page(), action)
    context.close()
    assert found["agent"][0] != found["agent"][1]
    assert found["ring"] == ["solid", "3px"]
    assert found["cursor"] == ["rgb(22, 25, 27)", "rgb(255, 255, 255)"]


@pytest.mark.parametrize("n", [7, 100])
def test_a_trail_painted_step_by_step_looks_as_if_painted_at_once(page: Page, n: int) -> None:
    action = """
    async ({ board, world, frame, stand, argument: actions }) => {
      const n = world.cols;
      const show = async (states) => {
        stand(states.at(-1), { paths: [{ states: [...states], who: "human", width: 0.35, fade: true }] });
        await frame();
      };
      const states = [0];
      for (const action of actions) {
        const [row, col] = [Math.floor(states.at(-1) / n), states.at(-1) % n];
        if (action === 4 && states.length > 2) states.pop();
        else if (action === 1 && col < n - 1) states.push(states.at(-1) + 1);
        else if (action === 2 && row < n - 1) states.push(states.at(-1) + n);
        else if (action === 3 && col > 0) states.push(states.at(-1) - 1);
        else if (row > 0) states.push(states.at(-1) - n);
        await show(states);
      }
      const pixels = () => {
        const canvas = board.querySelector(".board-trail");
        const copy = document.createElement("canvas");
        [copy.width, copy.height] = [canvas.width, canvas.height];
        const context = copy.getContext("2d", { willReadFrequently: true });
        context.drawImage(canvas, 0, 0);
        return context.getImageData(0, 0, copy.width, copy.height).data;
      };
      const grown = pixels();
      board.world = { ...world };
      await frame();
      const fresh = pixels();
      const apart = grown.reduce((most, value, i) => Math.max(most, Math.abs(value - fresh[i])), 0);
      return { apart, ink: fresh.some((value) => value > 100), n: states.length };
    }
    """
    actions = [(i * i // 3 + i) % 5 for i in range(150)]
    found = on_a_board(page, action, n=n, width=500, argument=actions)
    assert found["ink"]
    assert found["n"] > 30
    assert found["apart"] <= 16, "no more than the edges of lines are rounded differently"


CLOSE_UP = """
async ({ board, frame, stand }) => {
  const { CloseUp } = await import("#js/board/close-up.js");
  const host = document.body.appendChild(document.createElement("div"));
  host.style.inlineSize = "200px";
  new CloseUp(host, board);
  const near = host.querySelector("irl-board");
  const seen = [];
  for (const state of [0, 1, 550]) {
    stand(state);
    await frame();
    seen.push([host.hidden, near.world?.cols, Number(near.querySelector(".agent")?.dataset.state)]);
  }
  board.float(550, "−1.0", "loss");
  board.cursor = 551;
  const told = [near.querySelector(".board-float")?.textContent, board.querySelector(".board-float"), near.cursor];
  board.style.inlineSize = "1500px";
  await frame();
  await frame();
  board.float(550, "−1.0", "loss");
  return { seen, told, isHiddenWhenLarge: host.hidden, isToldOnBoard: board.querySelector(".board-float") !== null };
}
"""


def test_a_close_up_shows_the_squares_around_the_agent_where_they_are_small(page: Page) -> None:
    found = on_a_board(page, CLOSE_UP, n=100, width=500)
    # From the corner the first two squares; then, five rows down, the middle of nine.
    assert found["seen"] == [[False, 9, 0], [False, 9, 1], [False, 9, 40]]
    assert found["told"] == ["−1.0", None, 41], "costs and the cursor are shown where they can be seen"
    assert (found["isHiddenWhenLarge"], found["isToldOnBoard"]) == (True, True)


def test_a_board_of_large_squares_has_no_close_up(page: Page) -> None:
    action = CLOSE_UP.replace("550", "50").replace("551", "51")
    assert all(is_hidden for is_hidden, *_ in on_a_board(page, action, n=24, width=500)["seen"])


def test_the_board_can_be_read_as_a_table(page: Page) -> None:
    action = """
    async ({ world }) => {
      const { TextBoard } = await import("#js/board/text-board.js");
      document.body.insertAdjacentHTML("beforeend", "<details><summary>Text</summary><table></table></details>");
      const details = document.body.lastElementChild;
      const table = details.querySelector("table");
      const text = new TextBoard(table);
      text.update(world, 0);
      const closed = table.rows.length;
      details.open = true;
      await new Promise((resolve) => details.addEventListener("toggle", resolve, { once: true }));
      text.update(world, 1);
      const here = [...table.querySelectorAll("[aria-current]")];
      return { closed, caption: table.caption.textContent, rows: table.rows.length,
               scopes: [...new Set([...table.querySelectorAll("th")].map((one) => one.scope))],
               start: table.rows[1].cells[1].textContent, here: here.map((one) => one.textContent),
               column: here[0].cellIndex };
    }
    """
    small = on_a_board(page, action)
    assert (small["closed"], small["rows"], small["scopes"]) == (0, 8, ["col", "row"])
    assert small["caption"] == "The whole board: 7 rows, 7 columns."
    assert small["start"].startswith("start, ")
    assert small["column"] == 2
    assert [one.partition(",")[0] for one in small["here"]] == ["you"]
    large = on_a_board(page, action, n=40)
    assert large["rows"] == 16
    assert large["caption"] == "Around you: rows 1 to 15 of 40, columns 1 to 15 of 40."


def test_goals_tell_what_they_pay_where_one_pays_more_than_another(page: Page) -> None:
    action = """
    async ({ board, world, frame, stand }) => {
      const inkOf = async (pays) => {
        const rewards = world.rewards.map((row) => [...row]);
        [rewards[0][6], rewards[6][6]] = pays;
        board.world = { ...world, goals: [6, 48], rewards };
        stand(0);
        await frame();
        await frame();
        return board.querySelector(".board-ink").toDataURL();
      };
      const [alike, different] = [await inkOf([14, 14]), await inkOf([3, 24])];
      return { alike: alike === (await inkOf([3, 3])), different: different !== alike };
    }
    """
    assert on_a_board(page, action) == {"alike": True, "different": True}
