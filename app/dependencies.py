"""What a route asks for by type: the open database of this process."""

from typing import Annotated

from fastapi import Depends, Request

from app.db import Database


async def get_database(request: Request) -> Database:
    """Return the database that the lifespan opened; `async`, so that it costs no hop to a thread."""
    database: Database = request.app.state.database
    return database


DatabaseFromApp = Annotated[Database, Depends(get_database)]
