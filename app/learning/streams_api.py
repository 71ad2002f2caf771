"""Watching runs: as streams of events, and the record of all frames for the time line."""

import gzip
import json
from collections.abc import AsyncIterator
from typing import Annotated
from uuid import UUID

from anyio import to_thread
from fastapi import APIRouter, Header, Query, Request, Response
from fastapi.responses import StreamingResponse
from sqlalchemy.orm import Session

from app.db import Database
from app.dependencies import DatabaseFromApp
from app.learning import queries
from app.learning.dependencies import MOST_RUNS, RunFromPath, RunsFromQuery, WatcherFromApp
from app.learning.schemas import FramesOut
from app.learning.stream import every_event, many_runs
from app.models import Run, RunEvent

router = APIRouter(prefix="/api/v1", tags=["runs"])

STREAM_HEADERS = {"Cache-Control": "no-cache, no-transform", "X-Accel-Buffering": "no"}
N_AT_ONCE = 50
MOST_CHARACTERS = 30_000_000
"""Frames of large worlds are large: an answer that holds so much is given, and the next `after` brings the rest."""


@router.get("/runs/{run_id}/events", summary="Follow a run", response_class=StreamingResponse)
async def follow(
    run: RunFromPath,
    database: DatabaseFromApp,
    watcher: WatcherFromApp,
    last_event_id: Annotated[int, Header(ge=0, le=2**62, description="Resume after this event.")] = 0,
) -> Response:
    """Stream a run as Server-Sent Events: `frame`, `learner`, and last `done` or `failed`; `id` counts from 1.

    A browser that already has the last event gets 204, which ends its reconnecting.
    """
    if await to_thread.run_sync(_have_ended, database, [run], [last_event_id]):
        return Response(status_code=204)
    return _as_stream(every_event(watcher, run.id, last_event_id))


@router.get("/events", summary="Follow several runs", response_class=StreamingResponse)
async def follow_many(
    runs: RunsFromQuery,
    database: DatabaseFromApp,
    watcher: WatcherFromApp,
    frames: Annotated[
        list[UUID], Query(max_length=MOST_RUNS, description="Those whose frames are wanted; of the others, `progress`.")
    ] = [],  # noqa: B006 - read only
    last_event_id: Annotated[
        str, Header(max_length=500, description="The numbers of the last events seen, in the order of `run`: 12.0.5")
    ] = "",
) -> Response:
    """Stream all runs of a page by one connection.

    Of each run first a `snapshot`; then `frame` (at most 30 a second of each learner, always its first and its last) or
    `progress`, `learner`, `queue`, and last `done` or `failed`; each names its run. The stream ends when all runs have
    ended; a browser that comes back then gets 204, which ends its reconnecting.
    """
    run_ids = [run.id for run in runs]
    seen = _numbers(last_event_id, len(runs))
    if seen is not None and await to_thread.run_sync(_have_ended, database, runs, seen):
        return Response(status_code=204)
    return _as_stream(many_runs(watcher, run_ids, with_frames=map(str, frames), seen=seen))


@router.get("/runs/{run_id}/frames", summary="Look at a run's frames", response_model=FramesOut)
def list_frames(
    request: Request,
    run: RunFromPath,
    database: DatabaseFromApp,
    after: Annotated[int, Query(ge=0, le=2**62, description="Only those after this event.")] = 0,
) -> Response:
    """List every frame of a run, oldest first: what a time line shows. Very long records come in several answers."""
    with database.read() as session:
        frames = _frames(session, run.id, after)
        newest = queries.last_event_numbers(session, [run.id]).get(run.id, 0)
        last = frames[-1].number if len(frames) else max(after, newest)
    listed = ",".join(f'{{"number":{frame.number},{frame.data[1:]}' for frame in frames)
    return _json(request, f'{{"run_id":{json.dumps(run.id)},"frames":[{listed}],"last":{last}}}')


def _frames(session: Session, run_id: str, after: int) -> list[RunEvent]:
    """The next frames of a run, as many as one answer holds."""
    found: list[RunEvent] = []
    n_characters = 0
    while n_characters < MOST_CHARACTERS and (
        more := queries.events_after(
            session, run_id, found[-1].number if found else after, limit=N_AT_ONCE, kind="frame"
        )
    ):
        found.extend(more)
        n_characters += sum(len(frame.data) for frame in more)
    return found


def _have_ended(database: Database, runs: list[Run], seen: list[int]) -> bool:
    """Tell whether all these runs have ended and everything of them was seen."""
    if not all(run.status in queries.ENDED for run in runs):
        return False
    with database.read() as session:
        newest = queries.last_event_numbers(session, [run.id for run in runs])
    return all(number >= newest.get(run.id, 0) for run, number in zip(runs, seen, strict=True))


def _numbers(event_id: str, n_runs: int) -> list[int] | None:
    """Read the id of an event; one that is not of these runs counts as none."""
    parts = event_id.split(".")
    if len(parts) != n_runs or not all(part.isascii() and part.isdigit() and len(part) < 19 for part in parts):
        return None
    return list(map(int, parts))


def _as_stream(messages: AsyncIterator[bytes]) -> StreamingResponse:
    return StreamingResponse(messages, media_type="text/event-stream", headers=STREAM_HEADERS)


def _json(request: Request, text: str) -> Response:
    """Answer with JSON, compressed where the client takes it."""
    body, headers = text.encode(), {"Vary": "Accept-Encoding"}
    if "gzip" in request.headers.get("accept-encoding", ""):
        body, headers = gzip.compress(body, compresslevel=4), headers | {"Content-Encoding": "gzip"}
    return Response(body, media_type="application/json", headers=headers)
