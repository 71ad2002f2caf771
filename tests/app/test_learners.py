"""What the pages are told of the learners, however many there are; and what serving pages must not load."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from app.db import Database
from app.learning import worker
from irl_core import DEFAULT_LEARNERS, LEARNERS, Settings
from tests.app.test_learning import ask, played  # noqa: F401 - a fixture
from tests.app.test_pages import island
from tests.factories import make_demonstration, make_world

ROOT = Path(__file__).resolve().parents[2]

SERVES_PAGES = """
import sys
from pathlib import Path
from app.main import create_app
from tests.companion import wait_for_companion
from tests.conftest import make_settings, open_client
from tests.factories import make_demonstration
with open_client(create_app(make_settings(Path(sys.argv[1])))) as client:
    world = client.post("/api/v1/worlds", json={"seed": 5}).json()
    pages = ["/", f"/worlds/{world['id']}", f"/worlds/{world['id']}/rank", f"/worlds/{world['id']}/learn", "/docs"]
    assert [client.get(page).status_code for page in pages] == [200] * len(pages)
    make_demonstration(client, world)
    assert client.post(f"/api/v1/worlds/{world['id']}/runs", json={"learners": ["meirl"]}).status_code == 202
    wait_for_companion(client.app)
    assert client.post(f"/api/v1/worlds/{world['id']}/previews", json={"orders": {}}).status_code == 200
print(sorted({"numba", "scipy", "matplotlib", "gymnasium"} & set(sys.modules)))
"""


def test_the_learn_page_tells_of_every_learner_who_is_preselected_and_what_is_missing(client):
    world = make_world(client)
    learners = island(client.get(f"/worlds/{world['id']}/learn"))["learners"]
    assert [one["name"] for one in learners] == list(LEARNERS)
    assert [one["name"] for one in learners if one["preselected"]] == list(DEFAULT_LEARNERS)
    for one in learners:
        learner = LEARNERS[one["name"]]
        facts = ("title", "summary", "family", "uses_ranking", "uses_failures", "uses_scores", "takes_anything")
        assert {fact: one[fact] for fact in facts} == {fact: getattr(learner, fact) for fact in facts}
        assert one["seeks_visits"] is (one["family"] == "paper" or one["name"] == "model_free")
        assert one["missing"].startswith(learner.title)


def test_the_learn_page_tells_what_each_setting_is_for_and_whether_it_is_whole(client):
    world = make_world(client)
    settings = {one["name"]: one for one in island(client.get(f"/worlds/{world['id']}/learn"))["settings"]}
    assert list(settings) == [one["name"] for one in Settings.describe()]
    assert all(one["group"] for one in settings.values())
    assert settings["iterations"]["whole"]
    assert not settings["learning_rate"]["whole"]


def test_a_world_too_large_for_a_learner_is_said_before_a_run_is_asked_for(client):
    world = make_world(client, rows=21, cols=21)
    make_demonstration(client, world)
    page = island(client.get(f"/worlds/{world['id']}/learn"))
    missing = {one["name"]: one["missing"] for one in page["learners"]}
    assert missing["meirl"] is None
    assert "up to 400" in missing["birlfr"]
    refused = ask(client, world, learners=["meirl", "birlfr"])
    assert refused.status_code == 422
    message = refused.json()["error"]["message"]
    assert message.startswith(missing["birlfr"])
    assert "these can learn: MEIRL, IRLR" in message


def test_the_comparison_page_tells_of_the_learners_of_its_run_alone(client, played, settings):  # noqa: F811
    run_id = ask(client, played, learners=["irlf", "meirl"]).json()["id"]
    database = Database(settings)
    worker.learn_now(database, run_id)
    database.close()
    data = island(client.get(f"/runs/{run_id}/comparison"))
    assert {one["name"]: one["uses_failures"] for one in data["learners"]} == {"irlf": True, "meirl": False}
    assert {entry["who"] for entry in data["comparison"]["entries"]} == {"human", "irlf", "meirl", "optimal"}


@pytest.mark.parametrize("name", LEARNERS)
def test_every_learner_has_a_hue_and_a_shape_of_its_own(name):
    known = re.findall(r"^  (\w+): \{ title: ", (ROOT / "static/js/board/colours.js").read_text("utf-8"), re.MULTILINE)
    assert name in known


def test_serving_pages_asking_for_a_run_and_previewing_load_no_compiler(settings):
    done = subprocess.run(
        [sys.executable, "-c", SERVES_PAGES, str(settings.data_dir)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=False,
    )
    assert done.stdout.strip() == "[]", done.stderr[-2000:]
