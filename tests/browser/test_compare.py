"""The Compare page: every number on it, the stage with its keys, and what others see by a link."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests import recomputed
from tests.browser import walk
from tests.browser.conftest import watched

Json = dict[str, Any]


@dataclass
class Compared:
    """A run that is done, whose it is, and what independent code makes of its policies."""

    run_id: str
    key: str
    cookies: list[Any]
    world: Json
    run: Json
    rollouts: Json
    ours: Json

    def entry(self, who: str) -> Json:
        found: Json = next(one for one in self.ours["entries"] if one["who"] == who)
        return found


@pytest.fixture(scope="module")
def compared(browser: Browser, base_url: str) -> Iterator[Compared]:
    """One run of all default learners for all tests here."""
    context = browser.new_context(base_url=base_url)
    page = context.new_page()
    with watched(page, base_url):
        world_id, run_id = walk.prepared(page, base_url, seed=5)
    client = walk.ContextClient(page, base_url)
    world, run = client.get(f"/worlds/{world_id}"), client.get(f"/runs/{run_id}")
    rollouts = client.get(f"/runs/{run_id}/rollouts")
    ours = recomputed.comparison(
        world, client.get(f"/worlds/{world_id}/demonstrations"), run["learners"], rollouts, seed=run["seed"]
    )
    assert recomputed.differences(client.get(f"/runs/{run_id}/comparison"), ours) == []
    key = client.post(f"/runs/{run_id}/shares", {})["key"]
    yield Compared(run_id, key, context.cookies(), world, run, rollouts, ours)
    context.close()


@pytest.fixture
def own(page: Page, compared: Compared) -> Page:
    """The page, opened by who played."""
    page.context.add_cookies(compared.cookies)
    page.goto(f"/runs/{compared.run_id}/comparison")
    expect(page.locator("compare-page")).not_to_have_attribute("data-step", "0")
    return page


def test_every_number_on_the_page_is_what_independent_code_makes_of_the_stored_policies(
    own: Page, compared: Compared
) -> None:
    check_sentences(own, compared)
    check_table(own, compared)
    check_boards(own, compared)
    check_losses(own, compared)
    check_tests(own, compared)
    check_plot(own, compared)
    check_beliefs(own, compared)


def check_sentences(page: Page, compared: Compared) -> None:
    learners = [one for one in compared.ours["entries"] if one["who"] in compared.run["learners"]]
    human, optimum, best = compared.entry("human"), compared.entry("optimal"), learners[0]
    earned = [fig(best["mean_return"]), *([fig(best["standard_error"])] if best["standard_error"] else [])]
    assert numbers(page, "sentence") == [*earned, fig(human["mean_return"]), fig(optimum["expected_return"])]
    totals = [one["total"] for one in compared.rollouts["human"]]
    assert numbers(page, "background") == [str(len(totals)), fig(max(totals))]
    posterior, reward = (compared.run["learners"]["birlfr"][part] for part in ("posterior", "reward"))
    row, col = divmod(compared.world["goal"], compared.world["cols"])
    unit = compared.world["rewards"][row][col] / reward[row][col]
    low, high = fig(unit * posterior["return_low"]), fig(unit * posterior["return_high"])
    assert numbers(page, "intervals") == [low, high, fig(100 * posterior["level"], 0), str(posterior["n_draws"])]


def check_table(page: Page, compared: Compared) -> None:
    rows = page.locator('[data-part="rows"] tr')
    expect(rows).to_have_count(len(compared.ours["entries"]))
    for row, entry in zip(rows.all(), compared.ours["entries"], strict=True):
        told = {cell.get_attribute("data-figure"): cell.text_content() for cell in row.locator("td").all()}
        error = f" ± {fig(entry['standard_error'])}" if entry["standard_error"] else ""
        assert row.get_attribute("data-who") == entry["who"]
        assert told == {
            "place": str(entry["place"]),
            "mean": fig(entry["mean_return"]) + error,
            "interval": f"{fig(entry['interval_low'])} to {fig(entry['interval_high'])}",
            "expected": fig(entry["expected_return"], 2),
            "share": percent(entry["share_of_optimum"]),
            "greedy": fig(entry["greedy_return"], 2),
            "success": percent(entry["success_rate"]),
            "steps": fig(entry["mean_steps"]),
            "episodes": str(entry["episodes"]),
        }


def check_boards(page: Page, compared: Compared) -> None:
    """At the end of two episodes: totals, steps, flags; and what each board stands for."""
    best, mean = compared.ours["human"]["best"], compared.ours["human"]["mean"]
    ids = [one["id"] for one in walk.page_data(page)["demonstrations"]]
    for number in (1, 8):
        page.locator('select[name="episode"]').select_option(str(number - 1))
        page.locator('[data-part="range"]').press("End")
        expect(page.locator("compare-page")).to_have_attribute("data-episode", str(number))
        for panel in page.locator(".compare-stage .agent-panel").all():
            who, role = panel.get_attribute("data-who") or "", panel.get_attribute("data-role")
            index = ids.index(best if role == "human-best" else mean) if who == "human" else number - 1
            episode = compared.rollouts[who][index]
            steps = len(episode["states"]) - 1
            arrived = "⚑ goal" if episode["reached_goal"] else "stopped"
            expect(panel.locator('[data-part="total"]')).to_have_text(fig(episode["total"]))
            expect(panel.locator('[data-part="line"]')).to_have_text(f"step {steps} of {steps}")
            expect(panel.locator('[data-part="flag"]')).to_have_text(arrived)
            if who != "human":
                entry = compared.entry(who)
                error = f" ± {fig(entry['standard_error'])}" if entry["standard_error"] else ""
                standing = f"{fig(entry['mean_return'])}{error} over 50 episodes"
                expect(panel.locator('[data-part="note"]')).to_have_text(standing)
    middling = page.locator('[data-role="human-mean"] [data-part="note"]')
    mean_return = fig(compared.entry("human")["mean_return"])
    expect(middling).to_have_text(f"{ids.index(mean) + 1} of {len(ids)}, nearest the mean {mean_return}")


def check_losses(page: Page, compared: Compared) -> None:
    """Where it goes wrong: the layer's scale, the worst square of each learner, and one square of all."""
    page.locator('input[name="ground"][value="lost"]').check(force=True)
    expect(page.locator("compare-page")).to_have_attribute("data-ground", "lost")
    lost, scale = compared.ours["value_lost"], compared.ours["value_lost_scale"]
    beyond = " or more" if max(map(max, lost.values())) > scale + 0.05 else ""
    expect(page.locator('[data-part="loss-all"]')).to_have_text(fig(scale) + beyond)
    for name, values in lost.items():
        panel, most = page.locator(f'.compare-stage [data-who="{name}"]'), max(values)
        row, col = divmod(values.index(most), compared.world["cols"])
        shown = panel.locator("irl-board").evaluate(
            "board => ({values: [...board.view.values], scale: board.view.scale})"
        )
        expect(panel.locator('[data-part="note"]')).to_have_text(
            f"Worst at row {row + 1}, column {col + 1}: {fig(-most)}"
        )
        assert shown["values"] == pytest.approx([-value for value in values], abs=1e-9)
        assert shown["scale"] == pytest.approx([-scale, scale], abs=1e-9)
    titles = {one["name"]: one["title"] for one in walk.page_data(page)["learners"]}
    page.locator("body").press("Shift+ArrowRight")
    told = ", ".join(f"{titles[name]} {fig(values[0])}" for name, values in lost.items())
    expect(page.locator('[data-part="square-words"]')).to_contain_text(f"Lost from here on: {told}.")
    expect(page.locator("#announcer")).to_contain_text("Row 1, column 1")


def check_tests(page: Page, compared: Compared) -> None:
    """Every pair both ways round in the table, and the best learner's pairs in sentences."""
    page.locator('[data-part="test-pairs"] summary').click()
    best = next(one["who"] for one in compared.ours["entries"] if one["who"] in compared.run["learners"])
    told = page.locator('[data-part="test-sentences"] li').all_text_contents()
    of_best = []
    for test in compared.ours["tests"]:
        d, low, high, p = (test[part] for part in ("mean_difference", "low", "high", "p_adjusted"))
        p_told = "p < 0.001" if p < 0.001 else f"p = {fig(p, 3 if p < 0.1 else 2)}"
        for a, b, sign in ((test["a"], test["b"], 1), (test["b"], test["a"], -1)):
            ends = (low, high) if sign == 1 else (-high, -low)
            brackets = f"[{fig(ends[0])}, {fig(ends[1])}]"
            cell = page.locator(f'[data-part="test-rows"] [data-a="{a}"][data-b="{b}"]')
            plus = "+" if fig(sign * d) != fig(0.0) and sign * d > 0 else ""
            expect(cell).to_have_text(f"{plus}{fig(sign * d)} {brackets}, {p_told}")
            expect(cell.locator("strong")).to_have_count(1 if p < 0.05 else 0)
            if a == best:
                of_best.append((fig(abs(d)), brackets, p_told))
    assert len(told) == len(of_best)
    assert all(any(all(part in text for part in parts) for text in told) for parts in of_best)


def check_plot(page: Page, compared: Compared) -> None:
    """The marks lie where the axis says that their figures are."""
    svg = page.locator(".dot-plot")
    ticks = [(float(t.get_attribute("x") or 0), value_of(t)) for t in svg.locator("text.dot-plot-tick").all()
             if re.fullmatch(r"−?[\d.]+", t.text_content() or "")]  # fmt: skip
    (x0, v0), (x1, v1) = ticks[0], ticks[-1]

    def x(value: float) -> float:
        return x0 + (value - v0) / (v1 - v0) * (x1 - x0)

    for entry in compared.ours["entries"]:
        row = svg.locator(f'[data-who="{entry["who"]}"]')
        if entry["expected_return"] is not None:
            assert path_start(row.locator(".dot-plot-expected")) == pytest.approx(x(entry["expected_return"]), abs=0.5)
        if entry["interval_high"] - entry["interval_low"] > 1e-9:
            d = row.locator(".dot-plot-interval").get_attribute("d") or ""
            low, high = (float(part) for part in re.findall(r"M([\d.]+),", d)[:2])
            edges = [x(entry["interval_low"]), x(entry["interval_high"])]
            inside = [(told, edge) for told, edge in zip((low, high), edges, strict=True) if x(-99) < told]
            assert all(math.isclose(told, edge, abs_tol=0.5) for told, edge in inside)


def check_beliefs(page: Page, compared: Compared) -> None:
    for name, result in compared.run["learners"].items():
        largest = max(abs(value) for row in result["reward"] for value in row)
        belief = page.locator(f'.belief[data-who="{name}"]')
        expect(belief.locator('[data-part="lowest"]')).to_have_text(fig(-largest))
        expect(belief.locator('[data-part="highest"]')).to_have_text(f"+{fig(largest)}")


def test_the_stage_is_played_by_keys_and_leaves_those_of_controls_alone(own: Page) -> None:
    place, body = own.locator("compare-page"), own.locator("body")
    expect(place).to_have_attribute("data-playing", "false")
    own.locator('[data-action="start"]').click()
    own.locator('[data-action="start"]').blur()
    expect(place).to_have_attribute("data-step", "0")
    body.press("ArrowRight")
    body.press("ArrowRight")
    body.press("ArrowLeft")
    expect(place).to_have_attribute("data-step", "1")
    body.press(".")
    expect(place).to_have_attribute("data-episode", "2")
    expect(own.locator('select[name="episode"]')).to_have_value("1")
    body.press("Space")
    expect(place).to_have_attribute("data-playing", "true")
    expect(place).not_to_have_attribute("data-step", "0")
    body.press("Space")
    expect(place).to_have_attribute("data-playing", "false")
    own.locator('select[name="episode"]').focus()
    own.keyboard.press("ArrowUp")
    expect(place).to_have_attribute("data-episode", "1")
    own.locator('[data-action="start"]').focus()
    own.keyboard.press("Space")
    expect(place).to_have_attribute("data-step", "0")
    expect(place).to_have_attribute("data-playing", "false")
    own.locator('[data-role="human-best"] irl-board').hover()
    expect(own.locator('[data-part="square-words"]')).to_contain_text("Row 4, column 4")
    assert (
        own.locator(".compare-stage irl-board").evaluate_all("boards => new Set(boards.map(b => b.cursor)).size") == 1
    )


def test_a_link_shows_others_the_same_of_the_player(phone: Page, compared: Compared) -> None:
    """On a phone, where the rows of the table are cards; the run is somebody else's, so nobody is called you."""
    phone.goto(f"/runs/{compared.run_id}/comparison?key={compared.key}")
    expect(phone.locator('.compare-stage [data-role="human-best"] [data-part="title"]')).to_have_text(
        "The player's best attempt"
    )
    expect(phone.locator('[data-part="sentence"]')).to_contain_text("the player")
    expect(phone.locator('[data-part="background"]')).to_contain_text("The player's figure")
    expect(phone.locator('[data-who="human"] th')).to_have_text("The player")
    assert fig(compared.entry("human")["mean_return"]) in (phone.locator('[data-part="rows"]').text_content() or "")
    assert phone.evaluate("document.documentElement.scrollWidth <= innerWidth")
    shown = phone.locator("compare-page").inner_text()
    assert not re.search(r"\b(you|your|yours)\b", shown.partition("Why does it")[0], re.IGNORECASE)


def fig(value: float | None, decimals: int = 1) -> str:
    """As people read it: half goes up, a true minus, a dash for nothing."""
    if value is None:
        return "–"
    text = str(Decimal(abs(value)).quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP))
    return f"−{text}" if value < 0 and float(text) else text


def percent(share: float) -> str:
    return "below 0" if share < 0 else f"{fig(100 * share, 0)} %"


def numbers(page: Page, part: str) -> list[str]:
    text = page.locator(f'[data-part="{part}"]').text_content() or ""
    return re.findall(r"−?\d+(?:\.\d+)?", text.replace("of 5 learners", ""))


def value_of(tick: Locator) -> float:
    return float((tick.text_content() or "").replace("−", "-"))


def path_start(path: Locator) -> float:
    return float((path.get_attribute("d") or "M0").removeprefix("M").partition(",")[0])
