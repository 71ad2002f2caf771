"""Learning again at once: previews, what-ifs, influence, uncertainty. One companion serves the whole file."""

import math
import os
import shutil
import threading
import time
import uuid
from pathlib import Path

import pytest

from app.kit import companion
from app.learning import worker
from app.main import create_app
from app.retraining import findings, schemas, service
from app.retraining.computing import TooSlow
from app.retraining.findings import affordable, check_pace
from irl_core.influence import influence
from irl_core.uncertainty import bootstrap
from tests.companion import wait_for_companion
from tests.conftest import make_settings, open_client
from tests.factories import attempt, best_path, losing_path, make_ranking, make_world, post_demonstration

QUICK = {"iterations": 30}
LEARNERS = ("irlfr", "birlfr", "trex")


@pytest.fixture(scope="module")
def client(tmp_path_factory, migrated_database):
    settings = make_settings(tmp_path_factory.mktemp("retraining"))
    shutil.copy(migrated_database, settings.database_path)
    app = create_app(settings)
    with pytest.MonkeyPatch.context() as patch, open_client(app) as opened:
        patch.setattr(companion, "PATIENCE_S", 300.0)  # a machine may be slow
        wait_for_companion(app)
        yield opened


@pytest.fixture
def other_client(client):
    return open_client(client.app)


@pytest.fixture(scope="module")
def played(client):
    """A world, three successes and three failures in it that reached the goal, each in order, and a run from them."""
    world = make_world(client)
    orders = play(client, world)
    return world, orders, run(client, world, orders)


def play(client, world, *, n_successes=3, n_failures=3):
    """Attempts that waste more and more steps at the start; ids by outcome, best success and worst failure first."""
    successes = [attempt_of(client, world, [0] * n + best_path(world)) for n in range(n_successes)]
    failures = [attempt_of(client, world, [0] * n + losing_path(world)) for n in reversed(range(n_failures))]
    return {"success": successes, "failure": failures}


def attempt_of(client, world, actions, **changes):
    body = attempt(world, actions=actions, step_ms=[100.0] * len(actions), **{"ending": "goal"} | changes)
    response = post_demonstration(client, world, body)
    assert response.status_code == 201, response.text
    return response.json()["id"]


def run(client, world, orders, *, learners=LEARNERS, seed=service.SEED):
    """A run of these orders, to its end."""
    for outcome, ids in orders.items():
        make_ranking(client, world, outcome, ids)
    body = {"learners": list(learners), "settings": QUICK, "seed": seed}
    asked = client.post(f"/api/v1/worlds/{world['id']}/runs", json=body)
    assert asked.status_code == 202, asked.text
    worker.learn_now(client.app.state.database, asked.json()["id"])
    done = client.get(f"/api/v1/runs/{asked.json()['id']}").json()
    assert done["status"] == "done"
    return done


def groups(orders):
    return {outcome: [[one] for one in ids] for outcome, ids in orders.items()}


def preview(client, world, orders, **told):
    return client.post(f"/api/v1/worlds/{world['id']}/previews", json={"orders": orders, "settings": QUICK} | told)


def what_if(client, run, change, *, learner="irlfr", **params):
    body = {"learner": learner, "change": change}
    return client.post(f"/api/v1/runs/{run['id']}/what-ifs", json=body, params=params)


def ask(client, run, what, *, learner="irlfr", **params):
    return client.get(f"/api/v1/runs/{run['id']}/{what}", params={"learner": learner} | params)


def refused(answer, status, code, *words):
    assert (answer.status_code, answer.json()["error"]["code"]) == (status, code), answer.text
    assert all(word in answer.json()["error"]["message"] for word in words), answer.text


class TestPreviews:
    def test_a_preview_is_what_a_worker_comes_to_from_the_same(self, client, played):
        world, orders, run = played
        for learner in LEARNERS:
            shown = preview(client, world, groups(orders), learner=learner).json()
            assert schemas.LearnedOut.model_validate(shown).compute_ms > 0
            came_to = run["learners"][learner]
            for name in ("outcome", "sentence", "iterations", "reward", "policy", "visitation"):
                assert shown[name] == came_to[name], (learner, name)

    def test_the_order_decides_what_is_learned_and_nothing_is_stored(self, client, played):
        world, orders, run = played
        before = client.get(f"/api/v1/worlds/{world['id']}/rankings").json()
        turned = {outcome: ids[::-1] for outcome, ids in orders.items()}
        shown = preview(client, world, groups(turned)).json()
        assert (shown["learner"], shown["title"]) == ("irlfr", "IRLFR")
        assert shown["policy"] != run["learners"]["irlfr"]["policy"]
        assert client.get(f"/api/v1/worlds/{world['id']}/rankings").json() == before
        assert len(client.get(f"/api/v1/worlds/{world['id']}/runs").json()) == 1

    def test_all_ties_are_learned_from_as_no_order_is(self, client, played):
        world, orders, _ = played
        tied = {outcome: [ids] for outcome, ids in orders.items()}
        ranked = preview(client, world, tied, learner="irlr").json()
        unranked = preview(client, world, {}, learner="meirl").json()
        assert flat(ranked["reward"]) == pytest.approx(flat(unranked["reward"]))

    def test_who_learns_depends_on_what_there_is(self, client, played):
        world, orders, _ = played
        shown = groups(orders)
        assert preview(client, world, {"success": shown["success"]}).json()["learner"] == "irlr"
        assert preview(client, world, {"failure": shown["failure"]}).json()["learner"] == "irlf"
        assert preview(client, world, {"success": [], "failure": []}).json()["learner"] == "irlf"

    def test_from_failures_alone_somebody_learns_and_from_nothing_nobody(self, client):
        world = make_world(client, step_limit=90)
        refused(preview(client, world, {}), 422, "missing_demonstrations", "nothing to learn from yet")
        attempt_of(client, world, [1], ending="gave_up")
        refused(preview(client, world, {}), 422, "missing_demonstrations", "reached the goal")
        refused(preview(client, world, {}, learner="birlfr"), 422, "missing_demonstrations", "unfinished_failures")
        lost = attempt_of(client, world, losing_path(world))
        refused(
            preview(client, world, {}, learner="irlr"), 422, "missing_demonstrations", "IRLR needs at least one success"
        )
        order = {"failure": [[lost], [one["id"] for one in played_in(client, world) if one["id"] != lost]]}
        assert preview(client, world, order).json()["learner"] == "birlfr"
        won = attempt_of(client, world, best_path(world))
        one_each = preview(client, world, order | {"success": [[won]]}).json()
        assert (one_each["learner"], len(one_each["policy"])) == ("irlfr", 49)

    def test_attempts_all_alike_teach_the_same_whatever_their_order(self, client):
        world = make_world(client, step_limit=91)
        alike = [attempt_of(client, world, best_path(world)) for _ in range(3)]
        there = preview(client, world, {"success": [[one] for one in alike]}).json()
        back = preview(client, world, {"success": [[one] for one in reversed(alike)]}).json()
        assert flat(there["reward"]) == pytest.approx(flat(back["reward"]))

    def test_an_order_is_checked_as_when_it_is_confirmed(self, client, other_client, played):
        world, orders, _ = played
        first, *others = orders["success"]
        foreign = attempt_of(other_client, world, best_path(world))
        for order, reason in (
            ([[first], [first], others], "in it twice"),
            ([others], "missing"),
            ([[first, foreign], others], "not yours"),
            ([[first, str(uuid.uuid4())], others], "not yours"),
            ([[first, orders["failure"][0]], others], "of the other outcome"),
        ):
            refused(preview(client, world, {"success": order}), 422, "invalid", reason)

    def test_a_discarded_attempt_is_not_learned_from(self, client):
        world = make_world(client, step_limit=92)
        kept, gone = (attempt_of(client, world, [0] * n + best_path(world)) for n in range(2))
        both = preview(client, world, {"success": [[kept], [gone]]}).json()
        client.put(f"/api/v1/demonstrations/{gone}/discard")
        refused(preview(client, world, {"success": [[kept], [gone]]}), 422, "invalid", "discarded")
        assert preview(client, world, {"success": [[kept]]}).json()["reward"] != both["reward"]

    def test_what_cannot_be_learned_with_is_said(self, client, played):
        world = played[0]
        refused(preview(client, world, {}, learner="nobody"), 422, "invalid", "no such learner", "irlfr")
        refused(preview(client, world, {}, settings={"learning_rate": -1}), 422, "invalid", "learning_rate")
        refused(preview(client, world, {}, settings={"lerning_rate": 1}), 422, "invalid", "no setting")
        assert preview(client, world, {}, settings={"iterations": math.e}).status_code == 422
        assert client.post("/api/v1/worlds/no-world/previews", json={"orders": {}}).status_code == 422

    def test_settings_that_diverge_show_the_last_numbers_there_were(self, client, played):
        world = played[0]
        wild = {"learning_rate": 10, "inference": "path_infinite", "iterations": 30}
        shown = preview(client, world, {}, learner="meirl", settings=wild).json()
        assert shown["outcome"] == "diverged"
        assert all(math.isfinite(one) for row in (*shown["reward"], *shown["policy"]) for one in row)

    def test_what_would_take_too_long_is_given_up_early(self, client):
        world = make_world(client, rows=30, cols=30, seed=1)
        attempt_of(client, world, best_path(world))
        endless = {"iterations": 100_000}
        refused(preview(client, world, {}, settings=endless), 422, "too_slow", "Press Learn")

    def test_a_study_may_keep_it_from_its_participants(self, settings):
        with open_client(create_app(settings.model_copy(update={"show_policy": False}))) as client:
            refused(preview(client, make_world(client), {}), 403, "not_shown", "not shown in this study")


class TestWhatIfs:
    def test_without_an_attempt_it_comes_to_what_a_run_without_it_comes_to(self, client):
        world = make_world(client, step_limit=93)
        orders = play(client, world)
        first = run(client, world, orders, seed=11)
        gone = orders["success"].pop(0)
        found = what_if(client, first, {"drop": gone}).json()
        client.put(f"/api/v1/demonstrations/{gone}/discard")
        second = run(client, world, orders, seed=11)
        for name in ("outcome", "sentence", "iterations", "reward", "policy", "visitation"):
            assert found["result"][name] == second["learners"]["irlfr"][name], name
        before, now = (returns(client, one, "irlfr") for one in (first, second))
        assert (found["before"], {name: found[name] for name in now}) == (before, now)
        assert found["difference"]["return_change"] == now["expected_return"] - before["expected_return"]

    def test_swapped_ranks_are_learned_as_if_they_had_been_confirmed_so(self, client, played):
        world, orders, run = played
        a, b, c = orders["success"]
        found = what_if(client, run, {"swap": [a, c]}).json()
        shown = preview(client, world, groups(orders | {"success": [c, b, a]})).json()
        assert found["change"] == {"swap": [a, c]}
        assert found["result"]["reward"] == shown["reward"]
        old, new = run["learners"]["irlfr"]["reward"], found["result"]["reward"]
        assert found["difference"]["reward"] == [x - y for x, y in zip(flat(new), flat(old), strict=True)]
        assert schemas.WhatIfOut.model_validate(found).compute_ms > 0

    def test_a_success_called_a_failure_turns_squares(self, client, played):
        _, orders, run = played
        found = what_if(client, run, {"relabel": orders["success"][0]}).json()
        assert found["difference"]["policy_change"] > 0
        assert found["difference"]["turned"] == sorted(set(found["difference"]["turned"]))

    def test_what_cannot_be_is_refused_with_the_reason(self, client, played):
        _, orders, run = played
        first, bad = orders["success"][0], orders["failure"][0]
        refused(what_if(client, run, {}), 422, "invalid", "one change")
        refused(what_if(client, run, {"drop": first, "relabel": first}), 422, "invalid", "one change")
        refused(what_if(client, run, {"drop": str(uuid.uuid4())}), 422, "invalid", "not one of this run's")
        refused(what_if(client, run, {"swap": [first, bad]}), 422, "invalid", "must stand in one order")
        refused(what_if(client, run, {"swap": [first, first]}), 422, "invalid", "not one twice")
        refused(what_if(client, run, {"drop": first}, learner="bc"), 422, "invalid", "not one of this run's")
        assert what_if(client, run, {"drop": "x"}).status_code == 422

    def test_without_the_only_success_a_sentence_says_what_is_missing(self, client, monkeypatch):
        monkeypatch.setattr(findings, "N_DRAWS", (3,))
        world = make_world(client, step_limit=94)
        orders = play(client, world, n_successes=1, n_failures=1)
        single = run(client, world, orders, learners=["irlfr"])
        answer = what_if(client, single, {"drop": orders["success"][0]})
        refused(answer, 422, "missing_demonstrations", "IRLFR needs at least one success")
        first, second = ask(client, single, "influence").json()["influences"]
        assert "needs at least one success" in first["sentence"]
        assert "needs at least one failure" in second["sentence"]
        assert first["policy_change"] is first["turned"] is None
        assert "cannot be said" in ask(client, single, "uncertainty").json()["sentence"]

    def test_what_never_arrived_cannot_be_called_a_success(self, client):
        world = make_world(client, step_limit=95)
        orders = play(client, world, n_failures=1)
        lost = attempt_of(client, world, [1], ending="gave_up")
        tried = run(client, world, orders | {"failure": [*orders["failure"], lost]}, learners=["meirl"])
        refused(what_if(client, tried, {"relabel": lost}, learner="meirl"), 422, "invalid", "never reached the goal")

    def test_a_learner_that_has_not_finished_has_nothing_to_compare_with(self, client, played):
        world, _, _ = played
        body = {"learners": ["meirl"], "settings": QUICK}
        queued = client.post(f"/api/v1/worlds/{world['id']}/runs", json=body).json()
        refused(what_if(client, queued, {"drop": played[1]["success"][0]}, learner="meirl"), 409, "no_result", "MEIRL")
        refused(ask(client, queued, "influence", learner="meirl"), 409, "no_result")


class TestFindings:
    def test_the_influence_is_the_one_that_irl_core_finds(self, client, played):
        _, orders, run = played
        problem, _ = stored(client, run, "irlfr")
        found = ask(client, run, "influence").json()
        assert found["influences"] == [one.to_json() for one in influence("irlfr", problem)]
        assert {one["id"] for one in found["influences"]} == {one for ids in orders.values() for one in ids}
        assert schemas.InfluenceOut.model_validate(found).learner == "irlfr"

    def test_the_bootstrap_is_the_one_that_irl_core_makes(self, client, played, monkeypatch):
        run = played[2]
        monkeypatch.setattr(findings, "N_DRAWS", (12,))
        problem, _ = stored(client, run, "irlfr")
        found = ask(client, run, "uncertainty").json()
        twin = bootstrap("irlfr", problem, n_draws=12).to_json()
        assert {name: found[name] for name in twin} == twin
        assert (found["method"], found["seed"]) == ("bootstrap", run["seed"])

    def test_a_bayesian_learner_tells_its_posterior(self, client, played):
        world, _, run = played
        found, posterior = (
            ask(client, run, "uncertainty", learner="birlfr").json(),
            run["learners"]["birlfr"]["posterior"],
        )
        assert (found["method"], found["policy_agreement"]) == ("posterior", posterior["policy_agreement"])
        assert found["return_low"] == posterior["return_low"] * world["rewards"][-1][-1]

    def test_what_was_found_out_once_is_at_hand_for_everybody_who_may_see_it(self, client, other_client, played):
        run = played[2]
        first = ask(client, run, "influence").json()
        assert ask(other_client, run, "influence").status_code == 404
        key = client.post(f"/api/v1/runs/{run['id']}/shares").json()["key"]
        assert ask(other_client, run, "influence", key=key).json() == first
        assert what_if(other_client, run, {"drop": first["influences"][0]["id"]}, key=key).status_code == 200
        client.delete(f"/api/v1/runs/{run['id']}/shares/{key}")
        assert ask(other_client, run, "influence", key=key).status_code == 404

    def test_how_many_draws_are_taken_depends_on_what_one_takes(self):
        assert [affordable(ms) for ms in (0.1, 5.0, 5.1, 10.0, 20.0, 33.0, 500.0)] == [200, 200, 100, 100, 50, 30, 30]
        check_pace(2000.0, n_done=1, n_all=20)  # a slow beginning says nothing yet
        check_pace(3000.0, n_done=3, n_all=20)
        with pytest.raises(TooSlow):
            check_pace(3001.0, n_done=3, n_all=20)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="a call that waits for as long as the test likes needs a FIFO")
def test_a_newer_preview_replaces_the_one_that_waits_and_a_death_is_told_once(client, played, tmp_path):
    world, orders, run = played
    beside, answers = client.app.state.companion, {}
    os.mkfifo(tmp_path / "never")
    preview(client, world, groups(orders))
    held = beside.submit(beside.line("somebody else", "read"), Path.read_text, (tmp_path / "never",))

    def ask_soon(name, learner):
        def wait():
            answers[name] = preview(client, world, groups(orders), learner=learner)

        asking = threading.Thread(target=wait)
        asking.start()
        return asking

    older = ask_soon("older", "irlfr")
    while not any("preview" in calls for calls in beside._waiting.values()):
        time.sleep(0.001)
    newer = ask_soon("newer", "trex")
    older.join()
    refused(answers["older"], 409, "superseded", "newer")
    beside._process.kill()
    with pytest.raises(Exception, match="exit code"):
        held.result()
    newer.join()
    assert answers["newer"].json()["reward"] == run["learners"]["trex"]["reward"]


def test_all_who_look_on_by_a_link_have_one_turn_together_and_leave_each_other_alone(client, played, monkeypatch):
    run, beside, lines = played[2], client.app.state.companion, []
    begin = beside.line

    def line(who, kind):
        lines.append((who, kind))
        return begin(who, kind)

    monkeypatch.setattr(beside, "line", line)
    key = client.post(f"/api/v1/runs/{run['id']}/shares").json()["key"]
    looking_on, with_a_cookie = open_client(client.app), open_client(client.app)
    attempt_of(with_a_cookie, played[0], best_path(played[0]))
    for asking in (client, looking_on, with_a_cookie):
        assert what_if(asking, run, {"drop": played[1]["success"][0]}, key=key).status_code == 200
    (owner, _), (first, one), (second, other) = lines
    assert first == second != owner
    assert one != other


@pytest.mark.parametrize("address", ["/worlds/{world}/rank", "/runs/{run}/comparison"])
def test_a_page_that_will_ask_wakes_the_companion(client, played, address, monkeypatch):
    woken = []
    monkeypatch.setattr(client.app.state.companion, "wake", lambda: woken.append(address))
    assert client.get(address.format(world=played[0]["id"], run=played[2]["id"])).status_code == 200
    assert woken == [address]


def flat(rows):
    return [one for row in rows for one in row]


def played_in(client, world):
    return client.get(f"/api/v1/worlds/{world['id']}/demonstrations").json()


def returns(client, run, who):
    entries = client.get(f"/api/v1/runs/{run['id']}/comparison").json()["entries"]
    (entry,) = (one for one in entries if one["who"] == who)
    return {name: entry[name] for name in ("expected_return", "greedy_return")}


def stored(client, run, learner):
    """What a run learned from, and what a learner came to, as the service reads it."""
    from app.models import Run

    database = client.app.state.database
    with database.read() as session:
        row = session.get_one(Run, run["id"])
    return service.learned_by(database, row, learner)
