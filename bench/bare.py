"""The bare server of the web benchmark: each request is one row through the same writer, and nothing else."""

import sys
from pathlib import Path

import sqlalchemy as sa
import uvicorn
from anyio import to_thread
from sqlalchemy.orm import Session
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse
from starlette.routing import Route

from app.config import Settings
from app.db import Database
from app.main import N_THREADS

TABLE = "CREATE TABLE bare (id INTEGER PRIMARY KEY, body TEXT NOT NULL)"
ROW = sa.text("INSERT INTO bare (body) VALUES (:body)")


def make_table(session: Session) -> None:
    session.execute(sa.text(TABLE))


def main(port: int, folder: Path) -> None:
    database = Database(Settings(database_url=f"sqlite:///{folder / 'bare.sqlite3'}"))
    database.write(make_table)

    def insert(_request: Request) -> JSONResponse:
        def store(session: Session) -> None:
            session.execute(ROW, {"body": "x" * 500})

        database.write(store)
        return JSONResponse({}, status_code=201)

    async def ready(_request: Request) -> JSONResponse:
        to_thread.current_default_thread_limiter().total_tokens = N_THREADS
        return JSONResponse({})

    app = Starlette(routes=[Route("/bare", insert, methods=["POST"]), Route("/readyz", ready)])
    uvicorn.run(app, host="127.0.0.1", port=port, log_level="warning")


if __name__ == "__main__":
    main(int(sys.argv[1]), Path(sys.argv[2]))
