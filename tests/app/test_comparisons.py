"""Comparisons through the API and on their page, recomputed by code that shares nothing with them."""

from sqlalchemy import select, update

from app.learning import worker
from app.models import Run, RunResult
from tests import recomputed
from tests.app.test_learning import ask, database, played  # noqa: F401 - fixtures
from tests.app.test_pages import island
from tests.factories import make_demonstration, make_world


def learned(client, database, world, **body):  # noqa: F811
    run_id = ask(client, world, **body).json()["id"]
    worker.learn_now(database, run_id)
    return run_id


def differences(client, world, run_id):
    """Where the stored comparison says something else than loops over what else is stored."""
    run = client.get(f"/api/v1/runs/{run_id}").json()
    ours = recomputed.comparison(
        client.get(f"/api/v1/worlds/{world['id']}").json(),
        client.get(f"/api/v1/worlds/{world['id']}/demonstrations").json(),
        run["learners"],
        client.get(f"/api/v1/runs/{run_id}/rollouts").json(),
        seed=run["seed"],
    )
    return recomputed.differences(client.get(f"/api/v1/runs/{run_id}/comparison").json(), ours)


def test_every_figure_is_what_independent_code_makes_of_the_stored_policies(client, played, database):  # noqa: F811
    run_id = learned(client, database, played, learners=["irlfr", "bc"])
    assert differences(client, played, run_id) == []
    comparison = client.get(f"/api/v1/runs/{run_id}/comparison").json()
    assert island(client.get(f"/runs/{run_id}/comparison"))["comparison"] == comparison


def test_one_attempt_alone_is_compared(client, database):  # noqa: F811
    world = make_world(client)
    only = make_demonstration(client, world)
    run_id = learned(client, database, world, learners=["meirl", "birlfr"])
    assert differences(client, world, run_id) == []
    comparison = client.get(f"/api/v1/runs/{run_id}/comparison").json()
    assert comparison["human"] == {"best": only["id"], "mean": only["id"]}
    human = next(one for one in comparison["entries"] if one["who"] == "human")
    assert (human["episodes"], human["interval_low"], human["standard_error"]) == (1, None, 0.0)


def test_identical_attempts_all_tied_are_compared_without_a_spread(client, database):  # noqa: F811
    world = make_world(client)
    ids = [make_demonstration(client, world)["id"] for _ in range(3)]
    order = {"order": [ids], "confirmed": True}
    assert client.put(f"/api/v1/worlds/{world['id']}/rankings/success", json=order).status_code == 200
    run_id = learned(client, database, world, learners=["meirl", "irlr"])
    assert differences(client, world, run_id) == []
    comparison = client.get(f"/api/v1/runs/{run_id}/comparison").json()
    assert comparison["human"] == {"best": ids[0], "mean": ids[0]}
    human = next(one for one in comparison["entries"] if one["who"] == "human")
    assert human["interval_low"] == human["interval_high"] == human["mean_return"]


def test_a_learner_that_diverged_is_compared_by_its_last_finite_weights(client, played, database):  # noqa: F811
    wild = {"iterations": 30, "learning_rate": 10.0, "inference": "path_infinite"}
    run_id = learned(client, database, played, learners=["meirl", "bc"], settings=wild)
    assert client.get(f"/api/v1/runs/{run_id}").json()["learners"]["meirl"]["outcome"] == "diverged"
    assert differences(client, played, run_id) == []


def test_a_comparison_of_an_earlier_version_still_shows(client, played, database):  # noqa: F811
    """It lacks what is measured since: null in the API and in the page data."""
    run_id = learned(client, database, played, learners=["meirl", "irlr"])
    with database.read() as session:
        kept = session.scalars(select(Run.comparison).where(Run.id == run_id)).one()
        assert session.scalars(select(RunResult.learner).where(RunResult.run_id == run_id)).all()
    newer = ("interval_low", "interval_high", "success_rate", "mean_steps")
    entries = [{key: value for key, value in one.items() if key not in newer} for one in kept["entries"]]
    old = {"seed": kept["seed"], "horizon": kept["horizon"], "entries": entries}
    database.write(lambda session: session.execute(update(Run).where(Run.id == run_id).values(comparison=old)))
    comparison = client.get(f"/api/v1/runs/{run_id}/comparison").json()
    assert [comparison[key] for key in ("human", "value_lost", "value_lost_scale", "tests")] == [None] * 4
    assert all(one[key] is None for one in comparison["entries"] for key in newer)
    page = client.get(f"/runs/{run_id}/comparison")
    assert page.status_code == 200
    assert island(page)["comparison"] == comparison
