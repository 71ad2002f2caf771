"""How much better, and good and bad stretches: said by mouse, finger and keyboard, stored as given, taken back."""

import csv
import io
import json
from itertools import pairwise
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser import ranking, walk
from tests.browser.test_pages import check_axe
from tests.browser.ways import expect_said, press, tab_to


def test_gaps_are_stored_as_given_each_with_the_means_by_which_it_was_said(page: Page, base_url: str) -> None:
    world_id = open_way(page, base_url, "magnitude", successes=4, failures=2, confirms=True)
    order = ranking.order_shown(page, "success")
    sliders = page.locator("#list-success .gap-input")
    sliders.nth(0).focus()
    hold(page, "ArrowRight", times=20)
    expect_said(page, "Said: 70. 1 of 3 gaps said.")
    press_at(page, sliders.nth(1), 0.0)
    expect_said(page, "Said: 1. 2 of 3 gaps said.")
    press_at(page, sliders.nth(1), 1.0)
    sliders.nth(2).focus()
    press(page, "End")
    expect_said(page, "Said: 100. 3 of 3 gaps said.")
    sliders.first.locator("xpath=..").get_by_role("button").click()
    expect_said(page, "Taken back. 2 of 3 gaps said.")
    confirm(page)

    pairs = [(above[0], below[0]) for above, below in pairwise(order)]
    said = [one for one in events(page, world_id) if one["type"] == "gap"]
    gaps = [(one["above"], one["below"], one["value"], one["means"]) for one in said]
    assert gaps == [
        (*pairs[0], 70, "key"),
        (*pairs[1], 1, "mouse"),
        (*pairs[1], 100, "mouse"),
        (*pairs[2], 100, "key"),
        (*pairs[0], None, "button"),
    ]
    stored = given(page, base_url, world_id, "success")
    assert stored["way"] == "magnitude"
    assert stored["order"] == order
    assert stored["given"] == [{"above": above, "below": below, "value": value} for above, below, value, _ in gaps[2:4]]


def test_a_slider_says_nothing_until_it_is_used_and_what_it_says_can_be_taken_back(page: Page, base_url: str) -> None:
    open_way(page, base_url, "magnitude", successes=2, failures=3)
    slider = page.get_by_role("slider", name="How much better is place 1 than place 2?")
    worse = page.get_by_role("slider", name="How much worse is place 2 than place 3?")
    expect(worse).to_have_attribute("aria-valuetext", "not said yet")
    expect_unsaid(page, slider)
    slider.focus()
    expect_unsaid(page, slider)
    press(page, "Enter")
    expect(slider).to_have_attribute("aria-valuetext", "50 of 100")
    expect(page.locator("#gaps-count-success")).to_have_text("1 of 1 gap said")
    press(page, "Delete")
    expect_unsaid(page, slider)
    press(page, "z")
    expect(slider).to_have_attribute("aria-valuetext", "50 of 100")
    press(page, "z")
    expect_unsaid(page, slider)
    press_at(page, slider, 0.5)  # right where the thumb waits, so that nothing changes
    expect(slider).to_have_attribute("aria-valuetext", "50 of 100")


def test_a_gap_goes_out_of_sight_with_its_neighbours_and_comes_back_with_them(page: Page, base_url: str) -> None:
    open_way(page, base_url, "magnitude", successes=3)
    counted = page.locator("#gaps-count-success")
    first = ranking.order_shown(page, "success")[0][0]
    page.locator("#list-success .gap-input").nth(0).focus()
    press(page, "ArrowRight")
    expect(counted).to_have_text("1 of 2 gaps said")
    card = page.locator(f'.card[data-demonstration-id="{first}"]')
    card.locator('[data-act="down"]').click()
    expect(counted).to_have_text("0 of 2 gaps said")
    expect(page.locator('#list-success .gap[data-said="true"]')).to_have_count(0)
    card.locator('[data-act="up"]').click()
    expect(counted).to_have_text("1 of 2 gaps said")
    expect(page.locator("#list-success .gap-value").first).to_have_text("51")
    card.locator('[data-act="down"]').click()
    card.locator('[data-act="tie"]').click()
    expect(counted).to_have_text("0 of 1 gap said")


def test_the_scale_shows_the_distances_that_were_said(page: Page, base_url: str) -> None:
    open_way(page, base_url, "magnitude", successes=3)
    sliders = page.locator("#list-success .gap-input")
    scale = page.locator("#gaps-scale-success")
    expect(scale).to_have_attribute(
        "aria-label", "Distances as you said them: place 1, not said to place 2, not said to place 3"
    )
    for i, key in enumerate(["End", "Enter"]):
        sliders.nth(i).focus()
        press(page, key)
    expect(scale).to_have_attribute("aria-label", "Distances as you said them: place 1, 100 to place 2, 50 to place 3")
    long, short = [one.bounding_box() for one in scale.locator(".scale-span").all()]
    assert long is not None
    assert short is not None
    assert long["width"] == pytest.approx(2 * short["width"], abs=1.5)


def test_a_finger_says_a_gap_by_a_tap_and_nothing_by_scrolling_past(phone: Page, base_url: str) -> None:
    world_id = open_way(phone, base_url, "magnitude", successes=3, confirms=True)
    sliders = phone.locator("#list-success .gap-input")
    sliders.nth(1).scroll_into_view_if_needed()
    before = phone.evaluate("scrollY")
    x, y = point_in(sliders.nth(1), 0.8)
    drag_finger(phone, [(x, y), *((x, y - 15 * part) for part in range(1, 9))])
    phone.wait_for_function("before => scrollY > before", arg=before)
    expect(phone.locator("#gaps-count-success")).to_have_text("0 of 2 gaps said")
    expect(phone.locator('#list-success .gap[data-said="true"]')).to_have_count(0)
    sliders.nth(0).scroll_into_view_if_needed()
    phone.touchscreen.tap(*point_in(sliders.nth(0), 1.0))
    expect(phone.locator("#gaps-count-success")).to_have_text("1 of 2 gaps said")
    confirm(phone)
    said = [(one["value"], one["means"]) for one in events(phone, world_id) if one["type"] == "gap"]
    assert said == [(100, "touch")]


def test_stretches_are_marked_ordered_and_confirmed_by_keyboard_alone(page: Page, base_url: str) -> None:
    world_id = open_way(page, base_url, "lists", successes=3, failures=1, confirms=True)
    tab_to(page, page.locator('#ways input[value="lists"]'))
    press(page, "ArrowRight", "ArrowRight", "ArrowRight")
    tab_to(page, page.get_by_role("button", name="The next attempt"))
    press(page, "Enter")
    words = page.locator("#stretches-words").text_content()
    expect_said(page, f"Attempt 2 of 4: {words}.")
    assert (words or "").endswith("nothing marked yet")
    tab_to(page, page.locator(".step").first)
    n_steps = page.locator(".step").count()
    expect(page.locator("#stretches-run")).to_have_text("Step 1 chosen")
    press(page, "ArrowRight", "Shift+ArrowRight", "Shift+ArrowRight", "g")
    expect_said(page, f"Steps 2 to 4: a good stretch. Score +{3 / n_steps:.2f}.")
    press(page, "End", "b")
    expect_said(page, f"Step {n_steps}: a bad stretch. Score +{2 / n_steps:.2f}.")
    press(page, "b")
    expect_said(page, f"Step {n_steps}: a bad stretch, as before. Score +{2 / n_steps:.2f}.")
    press(page, "Delete")
    expect_said(page, f"Step {n_steps}: neither good nor bad. Score +{3 / n_steps:.2f}.")
    marked = page.locator('.attempt[aria-current="true"]').get_attribute("data-demonstration-id")
    expect(page.locator(".attempt").first).to_have_attribute("data-demonstration-id", marked or "")
    tab_to(page, page.get_by_role("button", name="Use this order for your successes"))
    press(page, "Enter")
    expect_said(page, "Your successes stand in this order now. Look it over in the lists below, then confirm it.")
    expect(page.locator("#stretches-used-success")).to_have_text("Your list stands in this order.")
    order = ranking.order_shown(page, "success")
    assert (order[0], len(order[1])) == ([marked], 2)
    page.locator("#confirm").focus()
    press(page, "Enter")
    answer_untouched(page)
    stored = given(page, base_url, world_id, "success")
    assert (stored["way"], stored["order"]) == ("segments", order)
    assert stored["given"] == {marked: [{"from": 2, "to": 4, "kind": "good"}]}
    log = [(one["type"], one["means"]) for one in events(page, world_id)]
    assert [one for one in log if one[0] in {"stretch", "set"}] == [*[("stretch", "key")] * 3, ("set", "button")]


def test_mouse_finger_and_buttons_choose_the_same_steps_and_scrolling_chooses_none(
    page: Page, phone: Page, base_url: str
) -> None:
    for one in (page, phone):
        open_way(one, base_url, "segments", failures=2)
        one.locator("#stretches-strip").scroll_into_view_if_needed()
    steps = page.locator(".step")
    page.mouse.move(*point_in(steps.nth(1), 0.5))
    page.mouse.down()
    page.mouse.move(*point_in(steps.nth(2), 0.5), steps=3)
    page.mouse.up()
    expect_chosen(page, "Steps 2 to 3 chosen")
    fingers = phone.locator(".step")
    x, y = point_in(fingers.nth(2), 0.5)
    drag_finger(phone, [(x, y), *((x, y - 15 * part) for part in range(1, 9))])
    expect(phone.locator('.step[aria-selected="true"]')).to_have_count(0)
    drag_finger(phone, [point_in(fingers.nth(1), 0.5), point_in(fingers.nth(1), 0.9), point_in(fingers.nth(2), 0.5)])
    expect_chosen(phone, "Steps 2 to 3 chosen")
    phone.touchscreen.tap(*point_in(fingers.nth(2), 0.5))
    expect_chosen(phone, "Step 3 chosen")
    phone.get_by_role("button", name="From here").click()
    expect_chosen(phone, "Step 3 chosen. Go to the last step, then “To here”.")
    phone.touchscreen.tap(*point_in(fingers.nth(0), 0.5))
    phone.get_by_role("button", name="To here").click()
    expect_chosen(phone, "Steps 1 to 3 chosen")
    phone.get_by_role("button", name="Bad stretch").click()
    expect(phone.locator('.step[data-kind="bad"]')).to_have_count(3)
    expect(phone.locator("#stretches-board")).to_have_attribute(
        "aria-label", "The path of this attempt: steps 1 to 3 bad"
    )


def test_the_chosen_steps_are_played_again_and_undo_takes_their_mark_back(page: Page, base_url: str) -> None:
    open_way(page, base_url, "segments", failures=3)
    states = walk.page_data(page)["demonstrations"][0]["states"]
    page.locator(".step").first.focus()
    press(page, "Shift+ArrowRight", "p")
    word = page.locator("#stretches-play-word")
    expect(word).to_have_text("Stop")
    expect(page.locator("#stretches-board .agent")).to_have_attribute("data-state", str(states[2]))
    expect(word).to_have_text("Play it")

    said = page.locator('.attempt[aria-current="true"] .attempt-said')
    page.locator(".step").first.click()
    page.get_by_role("button", name="Bad stretch").click()
    expect(said).to_contain_text("1 bad stretch · −")
    expect(page.locator(".attempt-place")).to_have_text(["1.", "2=", "2="])
    page.locator("#undo").click()
    expect(said).to_have_text("nothing marked yet")
    expect(page.locator(".attempt-place")).to_have_text(["1=", "1=", "1="])
    page.locator("#stretches-use-failure").focus()
    press(page, "Enter")
    expect_said(page, "Nothing is marked here yet: all would tie.")
    page.locator("#redo").click()
    expect(said).to_contain_text("1 bad stretch")


def test_the_order_that_followed_can_still_be_changed_by_hand(page: Page, base_url: str) -> None:
    world_id = open_way(page, base_url, "segments", failures=3, confirms=True)
    page.locator(".step").first.click()
    page.get_by_role("button", name="Bad stretch").click()
    page.locator("#stretches-use-failure").click()
    first = ranking.order_shown(page, "failure")[0][0]
    page.locator(f'.card[data-demonstration-id="{first}"] [data-act="down"]').click()
    expect(page.locator("#stretches-used-failure")).to_have_text("Your list stands in another order.")
    order = ranking.order_shown(page, "failure")
    assert order[-1] == [first]
    confirm(page)
    assert given(page, base_url, world_id, "failure")["order"] == order


def test_a_long_attempt_can_be_gone_through_and_one_of_a_single_step_too(page: Page, base_url: str) -> None:
    client = walk.ContextClient(page, base_url)
    world = client.post("/worlds", {"seed": 5})
    long = ([1, 3] * 48)[: world["horizon"] - 1]
    for n, actions in enumerate([[1], long]):
        body = {
            "id": f"00000000-0000-4000-8000-0000000000{n:02}",
            "actions": actions,
            "step_ms": [100.0] * len(actions),
            "ending": "gave_up",
        }
        client.post(f"/worlds/{world['id']}/demonstrations", body)
    page.goto(f"/worlds/{world['id']}/rank")
    choose_way(page, "segments")
    page.locator(".step").focus()
    press(page, "ArrowRight", "Shift+ArrowLeft", "g")
    expect_said(page, "Step 1: a good stretch. Score +1.00.")
    page.get_by_role("button", name="The next attempt").click()
    page.locator(".step").first.focus()
    press(page, "Control+a", "b")
    expect_said(page, f"Steps 1 to {len(long)}: a bad stretch. Score −1.00.")
    press(page, "Home", "PageDown", "ArrowDown")
    expect(page.locator(".step:focus")).to_be_in_viewport()
    assert int(page.locator(".step:focus").get_attribute("data-step") or 0) > 20


def test_axe_finds_nothing_in_either_way(page: Page, base_url: str) -> None:
    open_way(page, base_url, "magnitude", successes=3, failures=2)
    press_at(page, page.locator("#list-success .gap-input").first, 0.3)
    check_axe(page, "magnitude")
    choose_way(page, "segments")
    page.locator(".step").first.click()
    page.get_by_role("button", name="Good stretch").click()
    page.locator(".step").nth(2).click()
    page.get_by_role("button", name="Bad stretch").click()
    check_axe(page, "segments")
    page.emulate_media(color_scheme="dark")
    check_axe(page, "segments, dark")
    choose_way(page, "magnitude")
    check_axe(page, "magnitude, dark")


def open_way(
    page: Page, base_url: str, way: str, *, successes: int = 0, failures: int = 0, confirms: bool = False
) -> str:
    world = ranking.world_with if confirms else ranking.played_before
    world_id = world(page, base_url, successes=successes, failures=failures)
    page.goto(f"/worlds/{world_id}/rank")
    choose_way(page, way)
    return world_id


def choose_way(page: Page, way: str) -> None:
    expect(page.locator("#list-success .card, #list-failure .card").first).to_be_attached()
    page.locator(f'#ways input[value="{way}"]').check(force=True)
    expect(page.locator("#rank")).to_have_attribute("data-way", way)


def press_at(page: Page, slider: Locator, share: float) -> None:
    slider.scroll_into_view_if_needed()
    page.mouse.click(*point_in(slider, share))


def point_in(one: Locator, share: float) -> tuple[float, float]:
    """So far along it, in its middle line."""
    box = one.bounding_box()
    assert box is not None
    return box["x"] + 1 + (box["width"] - 2) * share, box["y"] + box["height"] / 2


def hold(page: Page, key: str, *, times: int) -> None:
    """As a key repeats that is held down."""
    for _ in range(times):
        page.keyboard.down(key)
    page.keyboard.up(key)


def drag_finger(page: Page, points: list[tuple[float, float]]) -> None:
    finger = page.context.new_cdp_session(page)
    for n, (x, y) in enumerate(points):
        kind = "touchMove" if n else "touchStart"
        finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]})
    page.wait_for_timeout(120)  # a finger lifted in full motion is a fling, which swallows the next touch
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    finger.detach()


def expect_unsaid(page: Page, slider: Locator) -> None:
    expect(slider).to_have_attribute("aria-valuetext", "not said yet")
    expect(slider.locator("xpath=..")).to_contain_text("not said yet")
    expect(page.locator("#gaps-count-success")).to_have_text("0 of 1 gap said")


def expect_chosen(page: Page, words: str) -> None:
    expect(page.locator("#stretches-run")).to_have_text(words)


def confirm(page: Page) -> None:
    page.locator("#confirm").click()
    answer_untouched(page)


def answer_untouched(page: Page) -> None:
    """A list that nobody touched asks whether it is meant."""
    expect(page.locator('#untouched[open], #rank[data-confirmed="true"]').first).to_be_visible()
    if page.locator("#untouched").is_visible():
        page.get_by_role("button", name="Yes, this is my order").click()
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "true")


def given(page: Page, base_url: str, world_id: str, outcome: str) -> walk.Json:
    """The ranking that counts, as the server has it."""
    found: walk.Json = walk.ContextClient(page, base_url).get(f"/worlds/{world_id}/rankings")[outcome]
    return found


def events(page: Page, world_id: str) -> list[dict[str, Any]]:
    """The log as the person can take it away."""
    table = page.request.get(f"/api/v1/worlds/{world_id}/ranking-events.csv").text()
    return [json.loads(row["event"]) for row in csv.DictReader(io.StringIO(table))]
