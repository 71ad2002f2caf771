"""What the learn page shows, and what a study keeps from it."""

import pytest

from app.main import create_app
from tests.conftest import make_settings, open_client
from tests.factories import make_world


@pytest.mark.parametrize("show_totals", [True, False])
def test_the_true_reward_stands_beside_the_learned_ones_only_where_totals_are_shown(settings, show_totals):
    told = make_settings(settings.data_dir, show_totals=show_totals)
    with open_client(create_app(told)) as client:
        page = client.get(f"/worlds/{make_world(client)['id']}/learn").text
    assert ("True reward" in page) is show_totals
