"""Headers, cookies, requests of other sites."""

import re
import shutil

import pytest

from app.visitors import COOKIE
from tests.conftest import make_settings, open_client
from tests.factories import make_demonstration, make_world


@pytest.mark.parametrize("url", ["/healthz", "/docs", "/nowhere", "/api/v1/worlds/x", "/openapi.json"])
def test_every_answer_has_its_headers(client, url):
    headers = client.get(url).headers
    policy = headers["content-security-policy"]
    assert policy.startswith("default-src 'none'; script-src 'nonce-")
    for part in ("'unsafe-inline'", "'unsafe-eval'", "http:", "*"):
        assert part not in policy
    assert "frame-ancestors 'none'" in policy
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["cross-origin-opener-policy"] == "same-origin"
    assert headers["cross-origin-resource-policy"] == "same-origin"
    assert "referrer-policy" in headers
    assert "permissions-policy" in headers
    assert headers["cache-control"] == "no-store"
    assert "strict-transport-security" not in headers


def test_each_answer_has_a_nonce_of_its_own_and_its_scripts_carry_it(client):
    pages = [client.get("/docs") for _ in range(2)]
    nonces = [page.headers["content-security-policy"].split("'nonce-")[1].split("'")[0] for page in pages]
    assert nonces[0] != nonces[1]
    for page, nonce in zip(pages, nonces, strict=True):
        scripts = re.findall(r"<script\b[^>]*>", page.text)
        assert scripts
        assert all(f'nonce="{nonce}"' in script for script in scripts)


def test_https_is_remembered_and_cookies_are_secure(tmp_path, migrated_database):
    from app.main import create_app

    settings = make_settings(tmp_path, https=True)
    shutil.copy(migrated_database, settings.database_path)
    with open_client(create_app(settings)) as client:
        response = client.post("/api/v1/worlds", json={})
    assert "max-age=31536000" in response.headers["strict-transport-security"]
    assert "Secure" in response.headers["set-cookie"]


def test_looking_leaves_no_cookie_and_creating_does(client):
    for url in ("/docs", "/healthz", "/", "/api/v1/worlds/00000000-0000-0000-0000-000000000000"):
        assert "set-cookie" not in client.get(url).headers
    assert "set-cookie" not in client.post("/api/v1/worlds", json={"rows": 1}).headers
    cookie = client.post("/api/v1/worlds", json={}).headers["set-cookie"]
    assert cookie.startswith(f"{COOKIE}=")
    for flag in ("HttpOnly", "SameSite=Lax", "Path=/", "Max-Age=31536000"):
        assert flag in cookie
    assert "Secure" not in cookie
    assert "set-cookie" not in client.post("/api/v1/worlds", json={}).headers


@pytest.mark.parametrize("change", ["", "x", "{}", "a.b", "é", "IjEi.x"])
def test_a_forged_cookie_counts_as_none(client, app, change):
    world = make_world(client)
    make_demonstration(client, world)
    real = client.cookies[COOKIE]
    url = f"/api/v1/worlds/{world['id']}/demonstrations"
    assert len(open_client(app).get(url, headers={"Cookie": f"{COOKIE}={real}"}).json()) == 1
    forged = change or real.swapcase()
    assert open_client(app).get(url, headers={b"Cookie": f"{COOKIE}={forged}".encode()}).json() == []


CROSS_SITE = [
    {"Origin": "https://evil.example"},
    {"Origin": "null"},
    {"Origin": "http://testserver.evil.example"},
    {"Origin": "http://testserver:81"},
    {"Sec-Fetch-Site": "cross-site"},
    {"Sec-Fetch-Site": "same-site"},
    {"Sec-Fetch-Site": "cross-site", "Origin": "http://testserver"},
]


@pytest.mark.parametrize("headers", CROSS_SITE)
def test_what_another_site_sends_is_not_carried_out(client, headers):
    response = client.post("/api/v1/worlds", json={}, headers=headers)
    assert response.status_code == 403
    assert response.json()["error"]["code"] == "cross_site"
    assert client.get("/docs", headers=headers).status_code == 200


@pytest.mark.parametrize("headers", [{}, {"Origin": "http://testserver"}, {"Sec-Fetch-Site": "same-origin"}])
def test_our_own_pages_and_programs_may(client, headers):
    assert client.post("/api/v1/worlds", json={}, headers=headers).status_code == 201


def test_files_with_a_version_are_kept_and_the_others_asked_for_again(client):
    for query, kept in (("", "no-cache"), ("?v=1", "public, max-age=31536000, immutable")):
        response = client.get(f"/static/css/base.css{query}")
        assert response.status_code == 200
        assert response.headers["cache-control"] == kept
