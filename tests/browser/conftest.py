"""The browser, the server, and a page that fails its test on anything amiss."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Self
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Error, Page, Request

from tests.live_server import ROOT, LiveServer

CHROMIUM_FLAGS = [
    "--no-sandbox",  # CI is root in a container
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
WATCH_FOR_VIOLATIONS = """
  window.addEventListener("securitypolicyviolation", (event) =>
    console.error(`CSP: ${event.violatedDirective} blocked ${event.blockedURI} at ${event.sourceFile}`));
"""


def find_chromium() -> str | None:
    """Return what dev.py found, or what is on PATH; None leaves the choice to playwright."""
    names = ("chromium", "chromium-browser", "google-chrome")
    return os.environ.get("E2E_CHROMIUM") or next(filter(None, map(shutil.which, names)), None)


@pytest.fixture(scope="session")
def browser_type_launch_args() -> dict[str, Any]:
    return {"executable_path": find_chromium(), "args": CHROMIUM_FLAGS, "headless": True}


@pytest.fixture(scope="session")
def browser(launch_browser: Any) -> Iterator[Browser]:
    """The browser. Where there is none a person's tests are skipped and CI's fail."""
    try:
        browser = launch_browser()
    except Error as error:
        reason = f"Chromium cannot be started ({str(error).splitlines()[0]}); `python3 dev.py test` looks for one."
        if os.environ.get("CI") or os.environ.get("E2E_REQUIRED"):
            pytest.fail(reason)
        pytest.skip(reason)
    yield browser
    browser.close()


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    """One real server for all walks; every test is a visitor of its own."""
    live = LiveServer(tmp_path_factory.mktemp("server"))
    live.start()
    yield live
    live.stop()


@pytest.fixture(scope="session")
def discreet(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    """A server whose study hides the totals."""
    live = LiveServer(tmp_path_factory.mktemp("discreet"), {"IRLFR_SHOW_TOTALS": "false"})
    live.start()
    yield live
    live.stop()


@pytest.fixture(scope="session")
def base_url(server: LiveServer) -> str:
    """Lets `page.goto("/")` find the server."""
    return server.address


@pytest.fixture
def page(context: BrowserContext, base_url: str) -> Iterator[Page]:
    """A page whose test fails on a console warning or error, a script error, a CSP violation, or a foreign request."""
    page = context.new_page()
    with watched(page, base_url):
        yield page


class watched:  # noqa: N801 - used as a verb: `with watched(page, address):`
    """Fails at its end if a page misbehaved in between."""

    def __init__(self, page: Page, address: str) -> None:
        self._page, self._origin = page, urlsplit(address).netloc
        self.faults: list[str] = []
        page.add_init_script(WATCH_FOR_VIOLATIONS)
        page.on("console", self._hear)
        page.on("pageerror", lambda error: self.faults.append(f"script error: {error}"))
        page.on("request", self._see)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is None:
            assert not self.faults, "\n".join(self.faults)

    def _hear(self, message: ConsoleMessage) -> None:
        if message.type in {"warning", "error"}:
            self.faults.append(f"console {message.type}: {message.text} ({message.location.get('url')})")

    def _see(self, request: Request) -> None:
        parts = urlsplit(request.url)
        if parts.scheme not in {"data", "blob"} and parts.netloc != self._origin:
            self.faults.append(f"left the origin: {request.url}")


@pytest.fixture
def phone(browser: Browser, base_url: str) -> Iterator[Page]:
    """A phone's page, watched alike."""
    context = browser.new_context(
        base_url=base_url, viewport={"width": 360, "height": 740}, has_touch=True, is_mobile=True, device_scale_factor=2
    )
    page = context.new_page()
    with watched(page, base_url):
        yield page
    context.close()


@pytest.fixture
def visitor(browser: Browser, base_url: str) -> Iterator[BrowserContext]:
    """A new visitor with any number of tabs."""
    with scripts_watched(browser.new_context(base_url=base_url, reduced_motion="reduce")) as context:
        yield context


@contextmanager
def scripts_watched(context: BrowserContext) -> Iterator[BrowserContext]:
    """Fails at its end if a script did; the browser itself reports refusals on its console, so that is let be."""
    faults: list[str] = []
    context.add_init_script(WATCH_FOR_VIOLATIONS)
    context.on("weberror", lambda error: faults.append(str(error.error)))
    context.on("console", lambda message: faults.append(message.text) if message.text.startswith("CSP") else None)
    yield context
    context.close()
    assert not faults, "\n".join(faults)


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    """A server that these tests may stop; the port and the database stay."""
    live = LiveServer(tmp_path_factory.mktemp("home"))
    live.start()
    yield live
    live.stop()


@pytest.fixture
def away(browser: Browser, home: LiveServer) -> Iterator[BrowserContext]:
    """A new visitor of `home`, not watched."""
    context = browser.new_context(base_url=home.address)
    yield context
    context.close()


@pytest.fixture(scope="session")
def screenshots(pytestconfig: pytest.Config) -> Path | None:
    """Where screenshots go: docs/screenshots, if asked for by --screenshots."""
    if not pytestconfig.getoption("--screenshots"):
        return None
    folder = ROOT / "docs" / "screenshots"
    folder.mkdir(parents=True, exist_ok=True)
    return folder
