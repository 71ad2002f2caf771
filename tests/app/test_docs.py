"""The reference describes every call, and the server says how it is."""

from sqlalchemy import insert

from app.kit.clock import now
from app.models import Worker


def test_the_schema_is_openapi_3_1_and_every_error_has_our_shape(client):
    schema = client.get("/openapi.json").json()
    assert schema["openapi"].startswith("3.1")
    for path, operations in schema["paths"].items():
        assert path.startswith("/api/v1/")
        for operation in operations.values():
            assert operation["summary"]
            assert operation["description"]
            shown = operation["responses"]["422"]["content"]["application/json"]["schema"]["$ref"]
            assert shown.endswith("/ErrorOut")


def test_the_page_shows_every_call_and_every_field_of_a_body(client):
    page, schema = client.get("/docs").text, client.get("/openapi.json").json()
    for path, operations in schema["paths"].items():
        for method in operations:
            assert f"{method.upper()} {path}" in page
    for body in ("WorldIn", "DemonstrationIn", "RankingIn", "RunIn", "PreviewIn", "WhatIfIn"):
        for name in schema["components"]["schemas"][body]["properties"]:
            assert f"<code>{name}</code>" in page


def test_alive_and_ready(client):
    assert client.get("/healthz").status_code == 200
    waiting = client.get("/readyz")
    assert waiting.status_code == 503
    assert "irlfr worker" in waiting.json()["missing"]["worker"]
    client.app.state.database.write(
        lambda session: session.execute(insert(Worker), {"name": "w", "pid": 1, "seen_at": now()}) and None
    )
    assert client.get("/readyz").status_code == 200
