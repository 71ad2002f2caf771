"""Two at a time: a person says which of two belongs higher, by keyboard, mouse and finger; two cards side by side."""

import random
import re
from collections.abc import Callable, Iterator
from typing import Literal

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import walk
from tests.browser.conftest import watched
from tests.browser.ranking import Order, Outcome, any_order, order_shown, played_before, world_with
from tests.browser.test_pages import check_axe
from tests.live_server import LiveServer

Answer = Callable[[Page, str], None]

SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
KEYS = {"a": "ArrowLeft", "b": "ArrowRight", "alike": "="}


def by_key(page: Page, said: str) -> None:
    page.keyboard.press(KEYS[said])


def by_mouse(page: Page, said: str) -> None:
    page.locator(f'#pairs [data-said="{said}"]').click()


def by_finger(page: Page, said: str) -> None:
    page.locator(f'#pairs [data-said="{said}"]').tap()


def open_pairs(page: Page, address: str, *, successes: int, failures: int, confirms: bool = False) -> str:
    world = world_with if confirms else played_before
    world_id = world(page, address, successes=successes, failures=failures)
    page.goto(f"/worlds/{world_id}/rank")
    page.locator('#ways [value="pairwise"]').click()
    expect(page.locator("#pairs-asking")).to_be_visible()
    return world_id


def on_show(page: Page) -> tuple[str, str]:
    left, right = [page.locator(f'#pairs [data-side="{side}"]').get_attribute("data-shows") for side in "ab"]
    assert left
    assert right
    return left, right


def most_left(page: Page) -> int:
    return max(int(figure) for figure in re.findall(r"\d+", page.locator("#pairs-left").inner_text()))


def judged(pair: tuple[str, str], target: Order) -> str:
    left, right = [next(at for at, group in enumerate(target) if id_ in group) for id_ in pair]
    return "alike" if left == right else "a" if left < right else "b"


def answer_all(page: Page, target: Order, answer: Answer) -> int:
    """Answer as the target says while its list is asked about; how many answers that took."""
    promised, n_answers = most_left(page), 0
    ids = {id_ for group in target for id_ in group}
    while page.locator("#pairs-asking").is_visible() and set(on_show(page)) <= ids:
        assert most_left(page) <= promised - n_answers
        answer(page, judged(on_show(page), target))
        n_answers += 1
        assert n_answers <= promised
    return n_answers


def target_of(page: Page, outcome: Outcome, rng: random.Random) -> Order:
    return any_order(sorted(id_ for group in order_shown(page, outcome) for id_ in group), rng)


def as_sets(order: Order) -> list[set[str]]:
    return [set(group) for group in order]


@pytest.mark.parametrize("seed", range(2))
def test_answers_by_keyboard_make_the_order_meant_ties_included(page: Page, base_url: str, seed: int) -> None:
    world_id = open_pairs(page, base_url, successes=6, failures=3, confirms=True)
    rng = random.Random(seed)
    successes, failures = target_of(page, "success", rng), target_of(page, "failure", rng)
    expect(page.locator("#pairs-title")).to_have_text("Which one is better?")
    answer_all(page, successes, by_key)
    expect(page.locator("#pairs-title")).to_have_text("Which one is worse?")
    answer_all(page, failures, by_key)
    expect(page.locator("#pairs-done-text")).to_contain_text("This is the order they make")
    assert as_sets(order_shown(page, "success")) == as_sets(successes)
    assert as_sets(order_shown(page, "failure")) == as_sets(failures)
    walk.confirm_order(page)
    stored = walk.ContextClient(page, base_url).get(f"/worlds/{world_id}/rankings")
    assert as_sets(stored["success"]["order"]) == as_sets(successes)
    assert stored["failure"]["way"] == "pairwise"
    assert {answer["said"] for answer in stored["success"]["given"]} <= {"a", "b", "alike"}


def test_answers_by_mouse_make_the_order_meant(page: Page, base_url: str) -> None:
    open_pairs(page, base_url, successes=5, failures=1)
    target = target_of(page, "success", random.Random(1))
    assert answer_all(page, target, by_mouse) <= 7
    assert as_sets(order_shown(page, "success")) == as_sets(target)


def test_answers_by_finger_make_the_order_meant(phone: Page, base_url: str) -> None:
    open_pairs(phone, base_url, successes=4, failures=0)
    target = target_of(phone, "success", random.Random(2))
    answer_all(phone, target, by_finger)
    assert as_sets(order_shown(phone, "success")) == as_sets(target)


def test_a_phone_shows_both_boards_and_the_answers_without_scrolling(phone: Page, base_url: str) -> None:
    open_pairs(phone, base_url, successes=3, failures=0)
    for part in ('[data-side="a"]', '[data-side="b"]', '[data-said="a"]', '[data-said="alike"]', '[data-said="b"]'):
        box = phone.locator(f"#pairs {part}").bounding_box()
        assert box is not None
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 360, part
        assert box["y"] + box["height"] <= 740, part


def test_an_answer_taken_back_brings_back_its_question_and_so_does_a_reload(page: Page, base_url: str) -> None:
    open_pairs(page, base_url, successes=6, failures=0)
    seen = []
    for said in ("a", "b", "a", "alike"):
        seen.append((on_show(page), page.locator("#pairs-left").inner_text()))
        by_key(page, said)
    asked = on_show(page)
    page.reload()
    expect(page.locator("#pairs-asking")).to_be_visible()
    assert on_show(page) == asked
    for pair, left in reversed(seen):
        page.keyboard.press("Backspace")
        assert (on_show(page), page.locator("#pairs-left").inner_text()) == (pair, left)
    expect(page.locator("#announcer")).to_have_text(
        re.compile(rf"^Taken back\. Which one is better\? Left: Success[^?]*{re.escape(seen[0][1])}\.$")
    )
    page.keyboard.press("Backspace")
    expect(page.locator("#announcer")).to_have_text("There is no answer to take back yet.")


def test_the_last_answer_and_its_order_are_taken_back_and_done_again_together(page: Page, base_url: str) -> None:
    open_pairs(page, base_url, successes=3, failures=0)
    before = order_shown(page, "success")
    answer_all(page, [*reversed(before)], by_key)
    after = order_shown(page, "success")
    page.keyboard.press("z")
    expect(page.locator("#pairs-asking")).to_be_visible()
    expect(page.locator("#pairs-title")).to_be_focused()
    assert order_shown(page, "success") == before
    page.locator("#redo").click()
    expect(page.locator("#pairs-done")).to_be_visible()
    assert order_shown(page, "success") == after


def test_an_order_changed_by_hand_can_become_that_of_the_answers_again(page: Page, base_url: str) -> None:
    open_pairs(page, base_url, successes=3, failures=0)
    answer_all(page, [*reversed(order_shown(page, "success"))], by_key)
    answered = order_shown(page, "success")
    page.locator("#list-success .card").nth(2).locator('[data-act="up"]').click()
    expect(page.locator("#pairs-done-text")).to_contain_text("another one than your answers make")
    page.locator("#pairs-take").click()
    assert order_shown(page, "success") == answered


def test_each_answer_and_the_next_question_are_announced(page: Page, base_url: str) -> None:
    open_pairs(page, base_url, successes=3, failures=2)
    page.keyboard.press("ArrowRight")
    words = {side: page.locator(f'#pairs [data-part="words-{side}"]').inner_text() for side in "ab"}
    question = f"Which one is better? Left: {words['a']}. Right: {words['b']}."
    expect(page.locator("#announcer")).to_have_text(
        re.compile(rf"^The right one is better\. {re.escape(question)} (About )?\d questions? left( \(at most 2\))?\.$")
    )
    while page.locator("#pairs-title").inner_text() == "Which one is better?":
        page.keyboard.press("=")
    page.keyboard.press("ArrowDown")
    expect(page.locator("#announcer")).to_have_text(
        re.compile(r"^They are alike\. \d answers settled it\. This is the order they make: look it over, change what")
    )


def test_keys_belong_to_what_has_the_focus(page: Page, base_url: str) -> None:
    open_pairs(page, base_url, successes=4, failures=0)
    pair = on_show(page)
    page.locator("#pairs [data-part=range]").focus()
    page.keyboard.press("ArrowRight")
    page.locator("#pairs [data-part=speed]").focus()
    page.keyboard.press("ArrowDown")
    assert on_show(page) == pair
    page.locator("#pairs [data-act=play]").focus()
    page.keyboard.press("ArrowRight")
    assert on_show(page) != pair


def test_both_attempts_are_played_in_step(page: Page, base_url: str) -> None:
    open_pairs(page, base_url, successes=2, failures=0)
    step = page.locator("#pairs [data-part=range]")
    step.fill("3")
    states = page.evaluate(
        "() => [...document.querySelectorAll('#pairs irl-board')].map((board) => board.view.paths[0].states.length)"
    )
    assert states == [4, 4]
    page.locator("#pairs [data-part=speed]").select_option("8")
    page.locator("#pairs-title").focus()
    page.keyboard.press(" ")
    longest = step.get_attribute("max")
    expect(page.locator("#pairs [data-part=step]")).to_have_text(f"step {longest} of {longest}")


def test_nothing_stirs_by_itself_where_motion_is_not_wanted(browser: Browser, base_url: str) -> None:
    context = browser.new_context(base_url=base_url, reduced_motion="reduce")
    page = context.new_page()
    with watched(page, base_url):
        open_pairs(page, base_url, successes=2, failures=0)
        expect(page.locator("#pairs [data-part=play-word]")).to_have_text("Play both")
        assert page.locator("#pairs [data-part=range]").input_value() == "0"
    context.close()


def test_two_cards_side_by_side_show_what_swapping_them_would_change(page: Page, base_url: str) -> None:
    world_id = played_before(page, base_url, successes=3)
    page.goto(f"/worlds/{world_id}/rank")
    expect(page.locator("#list-success .card")).to_have_count(3)
    (first,), (second,), (third,) = order_shown(page, "success")
    page.locator("#list-success .card").nth(0).focus()
    page.keyboard.press("c")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("c")
    dialog = page.locator("#compare")
    expect(dialog).to_be_visible()
    expect(dialog.locator("#compare-swap-list")).to_have_text(
        re.compile(r"Left\s*place 1, θ 0\.50 → place 3, θ 0\.17\s*Right\s*place 3, θ 0\.17 → place 1, θ 0\.50")
    )
    dialog.locator("#compare-swap").hover()
    would = "() => [...document.querySelectorAll('#list-success .card')].map((card) => card.dataset.would ?? '')"
    assert page.evaluate(would) == ["0.166667", "", "0.500000"]
    dialog.locator("#compare-swap").click()
    assert order_shown(page, "success") == [[third], [second], [first]]
    expect(dialog.locator("[data-announcer]")).to_have_text("Swapped. Left: place 3, θ 0.17. Right: place 1, θ 0.50.")
    page.keyboard.press("ArrowLeft")
    expect(dialog.locator("[data-announcer]")).to_have_text(
        "The left one is better. Left: place 1, θ 0.50. Right: place 2, θ 0.33."
    )
    page.keyboard.press("=")
    assert order_shown(page, "success") == [[third, first], [second]]
    expect(dialog.locator("#compare-swap-none")).to_be_visible()
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    for _ in range(3):
        page.keyboard.press("z")
    assert order_shown(page, "success") == [[first], [second], [third]]


def test_axe_finds_nothing_where_pairs_are_looked_at(page: Page, base_url: str) -> None:
    open_pairs(page, base_url, successes=3, failures=0)
    check_axe_in_both_schemes(page, "asking")
    answer_all(page, order_shown(page, "success"), by_key)
    check_axe_in_both_schemes(page, "settled")
    page.locator("#list-success .card").nth(0).locator('[data-act="compare"]').click()
    page.locator("#list-success .card").nth(1).focus()
    page.keyboard.press("c")
    expect(page.locator("#compare")).to_be_visible()
    check_axe_in_both_schemes(page, "side by side")


def check_axe_in_both_schemes(page: Page, where: str) -> None:
    for scheme in SCHEMES:
        page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        check_axe(page, f"{where}, {scheme}")


@pytest.fixture(scope="module")
def discreet(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    """A server that hides the totals, and asks about pairs only."""
    live = LiveServer(tmp_path_factory.mktemp("pairs"), {"IRLFR_SHOW_TOTALS": "false", "IRLFR_RANK_BY": "pairwise"})
    live.start()
    yield live
    live.stop()


def test_hidden_totals_stay_hidden_and_the_only_way_is_asked_at_once(browser: Browser, discreet: LiveServer) -> None:
    context = browser.new_context(base_url=discreet.address)
    page = context.new_page()
    with watched(page, discreet.address):
        world_id = world_with(page, discreet.address, successes=3)
        page.goto(f"/worlds/{world_id}/rank")
        expect(page.locator("#pairs-asking")).to_be_visible()
        expect(page.locator("#confirm")).to_be_hidden()
        expect(page.locator("#pairs [data-part=words-a]")).to_have_text(re.compile(r"^Success in \d+ steps$"))
        assert not re.search(r"[+−]\d", page.locator("#rank").inner_text())
    context.close()
