"""The companion, ready to answer: on a fresh machine it compiles first, which takes longer than anybody waits."""

import os

from fastapi import FastAPI

from app.kit.companion import Companion


def wait_for_companion(app: FastAPI) -> None:
    """Start the companion of an app, and wait until it answers."""
    companion: Companion = app.state.companion
    companion.submit(companion.line("a test", "wait"), os.getpid, ()).result()
