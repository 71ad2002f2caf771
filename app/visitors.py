"""Who is asking: a browser, known by a signed cookie that says nothing but a random id.

The cookie comes with the first request that creates something and succeeds, never with a GET: who only looks around is
not marked. A forged or broken cookie counts as none.
"""

import uuid
from hashlib import sha256
from http.cookies import SimpleCookie
from typing import Annotated

from fastapi import Depends, Request
from itsdangerous import BadData, URLSafeSerializer
from sqlalchemy import insert
from sqlalchemy.orm import Session
from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.kit import clock
from app.models import Visitor as VisitorRow

COOKIE = "irlfr_visitor"
REMEMBER = insert(VisitorRow.metadata.tables["visitor"]).prefix_with("OR IGNORE")
COOKIE_AGE_S = 365 * 24 * 3600


async def find_visitor(request: Request) -> str | None:
    """The id of the visitor whose cookie this is, or None."""
    cookie = request.cookies.get(COOKIE)
    if cookie is None:
        return None
    try:
        visitor_id = _serializer(request.app.state.settings.signing_key).loads(cookie)
    except (BadData, ValueError):
        return None
    return visitor_id if isinstance(visitor_id, str) else None


VisitorOrNone = Annotated[str | None, Depends(find_visitor)]


async def find_or_make_visitor(request: Request, visitor_id: VisitorOrNone) -> str:
    """The visitor's id; a new one goes out as a cookie if the request succeeds (`VisitorCookie`).

    Whoever stores something calls `remember` in the same transaction, so that no row is left by what was refused.
    """
    if visitor_id is None:
        visitor_id = str(uuid.uuid4())
        request.state.new_visitor = visitor_id
    return visitor_id


Visitor = Annotated[str, Depends(find_or_make_visitor)]


def remember(session: Session, visitor_id: str) -> None:
    """See that the visitor has a row, for what is stored next to point to."""
    row = {"id": visitor_id, "created_at": clock.now()}
    session.connection().execute(REMEMBER, row)


class VisitorCookie:
    """Middleware that hands a new visitor their cookie with a successful answer, of whatever class the answer is."""

    def __init__(self, app: ASGIApp, *, signing_key: str, https: bool) -> None:
        self.app = app
        self.serializer = _serializer(signing_key)
        self.https = https

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on and watch for the start of its answer."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return

        async def send_with_cookie(message: Message) -> None:
            if message["type"] == "http.response.start" and message["status"] < 400:
                visitor_id = scope.get("state", {}).get("new_visitor")
                if visitor_id is not None:
                    MutableHeaders(scope=message).append("Set-Cookie", self._cookie(visitor_id))
            await send(message)

        await self.app(scope, receive, send_with_cookie)

    def _cookie(self, visitor_id: str) -> str:
        cookie = SimpleCookie({COOKIE: self.serializer.dumps(visitor_id)})
        flags = {"path": "/", "max-age": COOKIE_AGE_S, "httponly": True, "samesite": "Lax", "secure": self.https}
        for flag, value in flags.items():
            cookie[COOKIE][flag] = value
        return cookie[COOKIE].OutputString()


def _serializer(signing_key: str) -> URLSafeSerializer:
    return URLSafeSerializer(signing_key, salt="visitor", signer_kwargs={"digest_method": sha256})
