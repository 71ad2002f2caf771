"""Results over many worlds: one's own, and everybody's in worlds that pool them."""

import csv
import io
import json
from contextlib import closing

import pytest

from app.db import Database
from app.learning import worker
from app.results.words import votes_needed
from app.visitors import COOKIE
from irl_core import LEARNERS
from tests.app.test_learning import ask, played  # noqa: F401 - a fixture
from tests.app.test_pages import island
from tests.factories import make_world
from tests.finished import finish_run, visitor_of

PAPER = {"human": -1.0, "meirl": 2.0, "irlr": 4.0, "irlf": 3.0, "irlfr": 5.0}


@pytest.fixture
def worlds(client):
    return [make_world(client, seed=seed)["id"] for seed in range(5, 9)]


@pytest.fixture
def pooled(client):
    return make_world(client, pooled=True)["id"]


@pytest.fixture
def me(client, worlds):
    return visitor_of(client.cookies[COOKIE])


@pytest.fixture
def finish(settings):
    def finish(world_id, whose=None, *, minutes=0, **scores):
        return finish_run(settings.database_path, world_id, scores, visitor_id=whose, minutes=minutes)

    return finish


def results(client, *world_ids):
    response = client.get("/api/v1/results", params={"world": list(world_ids)})
    assert response.status_code == 200, response.text
    return response.json()


def counts(found):
    return {one["who"]: [place["count"] for place in one["places"]] for one in found["standings"]}


def test_the_latest_finished_comparison_of_each_world_counts(client, worlds, me, finish):
    first, second, third, _ = worlds
    finish(first, me, minutes=1, **PAPER | {"irlfr": 0.0})
    newest = finish(first, me, minutes=2, **PAPER)
    finish(second, me, minutes=3, **PAPER | {"meirl": 6.0})
    finish(third, me, minutes=4, human=3.0, meirl=3.0)
    found = results(client)
    assert (found["scope"], found["unit"], found["n_comparisons"], found["n_units"]) == ("own", "world", 3, 3)
    assert counts(found) == {
        "meirl": [2, 0, 0, 1],
        "irlfr": [1, 1],
        "irlr": [0, 1, 1],
        "irlf": [0, 0, 1, 1],
        "human": [1, 0, 0, 0, 2],
    }
    assert [one["world_id"] for one in found["worlds"]] == [third, second, first], "the newest first"
    assert found["worlds"][2]["run_id"] == newest
    assert [(one["place"], one["who"]) for one in found["worlds"][0]["entries"]] == [(1, "human"), (1, "meirl")]
    assert found["headline"] == "MEIRL came first most often: in 2 of 3 worlds."
    assert "Not every comparison had the same learners" in found["remarks"][0]


def test_a_run_that_was_really_learned_counts_as_its_comparison_says(client, played, settings):  # noqa: F811
    run = ask(client, played, learners=["meirl", "irlr"]).json()
    with closing(Database(settings)) as database:
        worker.learn_now(database, run["id"])
    comparison = client.get(f"/api/v1/runs/{run['id']}/comparison").json()
    compared = {one["who"]: one for one in comparison["entries"]}
    [world] = results(client)["worlds"]
    assert {one["who"] for one in world["entries"]} == set(compared) - {"optimal"}
    assert world["optimum"] == compared["optimal"]["expected_return"]
    for entry in world["entries"]:
        told = compared[entry["who"]]
        assert entry["mean_return"] == told["mean_return"]
        assert entry["share_of_optimum"] == pytest.approx(told["share_of_optimum"])
        assert entry["expected_return"] == (
            told["expected_return"] if told["expected_return"] is not None else told["mean_return"]
        )


def test_a_pair_counts_only_where_both_were_there(client, worlds, me, finish):
    for k, world in enumerate(worlds):
        finish(world, me, minutes=k, human=0.0, irlr=4.0, **({"irlfr": 5.0 - k} if k < 3 else {}))
    duels = {(one["a"], one["b"]): one for one in results(client)["duels"]}
    pair = duels["irlr", "irlfr"]
    assert [pair[name] for name in ("n_comparisons", "wins", "losses", "ties")] == [3, 1, 1, 1]
    assert [pair[name] for name in ("votes_for", "votes_against", "p_value")] == [1, 1, 1.0]
    assert duels["human", "irlr"]["p_value"] == 2 / 2**4
    assert duels["human", "irlr"]["p_adjusted"] == 3 * 2 / 2**4


def test_table_one_is_written_out_as_in_the_paper(client, worlds, me, finish):
    for k, world in enumerate(worlds):
        finish(world, me, minutes=k, **PAPER | {"birlfr": 9.0}, **({} if k else {"model_free": 1.0}))
    table = results(client)["table_one"]
    assert table["n_comparisons"] == 4
    sentences = {row["who"]: row["sentence"] for row in table["rows"]}
    assert sentences["human"] == (
        "In 4 of 4 worlds all four learners earned more than you (95 % interval: 51 to 100 %)."
    )
    assert sentences["irlfr"] == (
        "IRLFR placed first in 4 of 4 worlds (95 % interval: 51 to 100 %), second in none, third in none and fourth in"
        " none. It earned more than MEIRL in 4, IRLR in 4 and IRLF in 4."
    )


def test_a_single_world_is_told_without_counting_to_one(client, worlds, me, finish):
    finish(worlds[0], me, **PAPER)
    found = results(client)
    assert found["headline"].endswith(" in your only world so far.")
    said = {row["who"]: row["sentence"] for row in found["table_one"]["rows"]}
    assert said["irlfr"] == "IRLFR placed first. It earned more than MEIRL, IRLR and IRLF."
    assert "none of the others" in " ".join(said.values())
    assert not any(" 1 " in one or " of " in one for one in [found["headline"], said["human"], said["irlfr"]])


def test_few_worlds_are_called_few_and_get_no_interval(client, worlds, me, finish):
    for world, few in zip(worlds, ("One world says little", "Two worlds say little"), strict=False):
        finish(world, me, **PAPER)
        found = results(client)
        assert found["remarks"][0] == f"{few}: an interval needs at least three."
        assert all(place["low"] is None for one in found["standings"] for place in one["places"])
        assert all(one["share_of_optimum"]["method"] is None for one in found["standings"])
        assert "interval:" not in json.dumps(found["table_one"])


def test_what_it_takes_to_tell_a_pair_apart_is_said(client, worlds, me, finish):
    """Ten pairs: 10 · 2 / 2ⁿ falls below 0.05 at n = 9."""
    assert [votes_needed(n) for n in (1, 10, 15)] == [6, 9, 10]
    for world in worlds:
        finish(world, me, **PAPER)
    [remark] = results(client)["remarks"]
    assert remark.startswith("None of this is beyond chance yet: to tell a pair apart takes 9 worlds that all say")


def test_pairs_beyond_chance_are_named(client, me, finish):
    for seed in range(20, 27):
        finish(make_world(client, seed=seed)["id"], me, human=1.0, irlfr=2.0)
    assert results(client)["remarks"] == ["IRLFR over you: that is more than chance would give (sign test, p < 0.05)."]


def test_nobody_sees_anothers_results(client, other_client, worlds, me, finish):
    finish(worlds[0], me, **PAPER)
    for one in (other_client, client):
        is_mine = one is client
        assert results(one)["n_comparisons"] == (1 if is_mine else 0)
        assert (worlds[0] in one.get("/results").text) == is_mine
    assert "Play a world" in other_client.get("/results").text, "an empty page leads to play"


def test_a_class_is_shown_without_ids_from_three_people_on(client, other_client, pooled, finish):
    people = [f"00000000-0000-4000-8000-00000000000{k}" for k in range(3)]
    runs = []
    for k, who in enumerate(people):
        found = results(other_client, pooled)
        assert (found["standings"], found["n_comparisons"]) == ([], 0)
        assert found["worlds"][0]["n_people_missing"] == 3 - k
        assert f"<strong>{3 - k} more to go</strong>" in other_client.get(f"/results?world={pooled}").text
        runs += [finish(pooled, who, minutes=minutes, **PAPER) for minutes in (1, 2)]
    found = results(other_client, pooled)
    assert (found["scope"], found["unit"], found["n_comparisons"], found["n_units"]) == ("pooled", "person", 3, 3)
    assert counts(found)["irlfr"] == [3]
    assert found["table_one"]["rows"][0]["title"] == "The players"
    assert found["table_one"]["rows"][0]["sentence"].startswith("In 3 of 3 comparisons all four learners earned more")
    shown = [json.dumps(found), other_client.get(f"/results?world={pooled}").text]
    shown.append(other_client.get(f"/api/v1/results.csv?world={pooled}").text)
    assert not [one for text in shown for one in (*people, *runs) if one in text]


def test_a_world_with_fewer_people_stays_out_of_the_pool_of_others(client, pooled, finish):
    """Else the difference of two pools would be what one person did."""
    other = make_world(client, seed=6, pooled=True)["id"]
    for k in range(3):
        finish(pooled, f"person {k}", **PAPER)
    finish(other, "person 0", **PAPER | {"meirl": 9.0})
    found = results(client, pooled, other, pooled)
    assert [(one["n_comparisons"], one["n_people_missing"]) for one in found["worlds"]] == [(3, 0), (1, 2)]
    assert found["n_comparisons"] == 3
    assert counts(found)["meirl"] == [0, 0, 0, 3]


def test_a_learner_that_fewer_than_three_people_had_is_left_out_of_the_pool(client, pooled, finish):
    """Its figures, and how the players did against it, would be those of one person."""
    for k in range(4):
        others = {"trex": 9.0} if k == 0 else {"bc": 1.0} if k < 3 else {}
        finish(pooled, f"person {k}", **PAPER | others)
    found = results(client, pooled)
    assert {one["who"] for one in found["standings"]} == set(PAPER)
    assert {name for one in found["duels"] for name in (one["a"], one["b"])} == set(PAPER)
    assert counts(found)["irlfr"] == [4], "places are among those who are shown"
    assert (
        "Left out, since fewer than three people had them learn: T-REX (linear) and Behavioural cloning."
        in found["remarks"]
    )


def test_a_person_with_several_worlds_votes_once(client, pooled, finish):
    other = make_world(client, seed=6, pooled=True)["id"]
    for k in range(4):
        for world in (pooled, other):
            finish(world, f"person {k}", human=1.0, irlfr=2.0)
    found = results(client, pooled, other)
    [duel] = found["duels"]
    assert (duel["n_comparisons"], duel["losses"], duel["votes_against"], duel["p_value"]) == (8, 8, 4, 2 / 2**4)


def test_a_world_that_pools_nothing_is_refused_in_a_sentence(client, worlds, pooled):
    for address in ("/api/v1/results", "/api/v1/results.csv", "/results"):
        answer = client.get(address, params={"world": [pooled, worlds[0]]})
        assert answer.status_code == 422
        assert "pools no results: who played it was not told" in answer.text
    assert client.get("/api/v1/results", params={"world": worlds[0]}).json()["error"]["code"] == "not_pooled"
    assert client.get("/results", params={"world": "00000000-0000-4000-8000-000000000000"}).status_code == 404
    assert client.get("/api/v1/results", params={"world": "me"}).status_code == 422
    assert client.get("/api/v1/results", params={"world": [pooled] * 21}).status_code == 422


def test_a_pooled_world_says_so_where_it_is_played_and_leads_to_its_result(client, worlds, pooled):
    assert f'pooled, without names: <a href="/results?world={pooled}">' in client.get(f"/worlds/{pooled}").text
    assert "pooled, without names." in client.get("/?seed=6&pooled=1").text, "nobody has played it, so it has no result"
    assert "pooled" not in client.get(f"/worlds/{worlds[0]}").text.split('id="page-data"')[0]


def test_the_tables_hold_every_figure(client, worlds, me, finish):
    for k, world in enumerate(worlds):
        finish(world, me, minutes=k, **PAPER)
    found = results(client)
    rows = list(csv.DictReader(io.StringIO(client.get("/api/v1/results.csv").text)))
    [share] = [row for row in rows if (row["figure"], row["who"]) == ("share_of_optimum", "irlfr")]
    told = next(one for one in found["standings"] if one["who"] == "irlfr")["share_of_optimum"]
    assert [float(share[name]) for name in ("value", "low", "high")] == [
        told[name] for name in ("value", "low", "high")
    ]
    wins = {(row["who"], row["other"]): int(row["count"]) for row in rows if row["figure"] == "wins"}
    assert (wins["irlfr", "human"], wins["human", "irlfr"], len(wins)) == (4, 0, 20)
    assert {row["figure"] for row in rows} == {"place", "share_of_optimum", "wins", "table_one"}
    answer = client.get("/api/v1/results/comparisons.csv")
    assert answer.headers["content-disposition"] == 'attachment; filename="irlfr-own-comparisons.csv"'
    entries = list(csv.DictReader(io.StringIO(answer.text)))
    assert len(entries) == 4 * len(PAPER)
    assert {row["optimum"] for row in entries} == {"10.0"}


def test_learners_of_other_versions_and_worlds_without_success_do_no_harm(client, worlds, me, finish):
    for k, world in enumerate(worlds):
        finish(world, me, minutes=k, human=-3.0, **{"=cmd": -1.0, "irlfr": -2.0})
    found = results(client)
    assert [one["title"] for one in found["standings"]] == ["=cmd", "IRLFR", "You"]
    assert "'=cmd" in client.get("/api/v1/results.csv").text, "no text begins a formula in a spreadsheet"
    assert client.get("/results").status_code == 200
    assert "=cmd" not in LEARNERS


def test_the_page_shows_what_the_api_says(client, worlds, me, finish):
    finish(worlds[0], me, **PAPER)
    page = client.get("/results")
    data = island(page)
    assert data["results"] == results(client)
    assert data["worlds"][worlds[0]]["rewards"]
    assert f"/runs/{data['results']['worlds'][0]['run_id']}/comparison" in page.text


def test_more_worlds_than_are_drawn_are_listed(client, me, finish):
    for seed in range(40, 67):
        finish(make_world(client, rows=2, cols=2, seed=seed)["id"], me, minutes=seed, human=0.0, irlfr=1.0)
    page = client.get("/results").text
    assert "3 older ones" in page
    assert page.count('/comparison"') == 27
    assert page.count("<irl-board") == 24
