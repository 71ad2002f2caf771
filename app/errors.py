"""What can go wrong, as one tree. Each error has its status, a code for programs and a sentence for people.

    AppError                     the root; raised only through its children
    ├── NotFound            404  nothing there, or nothing there for you
    ├── Conflict            409  the id is taken by other content, or the thing is past that point
    ├── Unprocessable       422  the request is well-formed but cannot be done; `fields` says where
    │   └── ImpossibleWorld      an address asks for a world that cannot be; `mend_at` is where it can be mended
    ├── Forbidden           403  a request another site made in the visitor's name
    ├── NotShown            403  this study keeps it from the participants
    ├── TooLarge            413  the body is over the limit
    ├── NotJson             415  the body is not declared as JSON
    └── Unavailable         503  the database is busy or full; trying again later does no harm

Errors of the science (`irl_core.IrlError`) are answered like `Unprocessable`; `error_handlers.py` turns all of them
into `{"error": {"code", "message", "fields"}}` or, for people, into a page with the same sentence.
"""

import json
from collections.abc import Mapping
from typing import ClassVar


class AppError(Exception):
    """An expected refusal: raised anywhere below a route, answered in one place."""

    status: ClassVar[int] = 400
    code: ClassVar[str] = "bad_request"
    headers: ClassVar[Mapping[str, str]] = {}

    def __init__(self, message: str, *, fields: Mapping[str, str] | None = None, code: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.fields = dict(fields or {})
        self.error_code = code or self.code


class NotFound(AppError):
    """There is no such thing, or it belongs to somebody else: the answer is the same, so that ids tell nothing."""

    status = 404
    code = "not_found"


class Conflict(AppError):
    """What is stored already speaks against it."""

    status = 409
    code = "conflict"


class Unprocessable(AppError):
    """Understood, but impossible."""

    status = 422
    code = "invalid"


class ImpossibleWorld(Unprocessable):
    """The world of an address cannot be."""

    def __init__(self, message: str, *, fields: Mapping[str, str], mend_at: str) -> None:
        super().__init__(message, fields=fields)
        self.mend_at = mend_at


class Forbidden(AppError):
    """Sent by another site's page."""

    status = 403
    code = "cross_site"


class NotShown(AppError):
    """It is theirs, but whoever runs the study keeps it from them."""

    status = 403
    code = "not_shown"


class TooLarge(AppError):
    """The body is over the limit."""

    status = 413
    code = "too_large"


class NotJson(AppError):
    """The body has another media type than application/json."""

    status = 415
    code = "not_json"


class Unavailable(AppError):
    """The database cannot take it now; nothing was stored."""

    status = 503
    code = "unavailable"
    headers: ClassVar[Mapping[str, str]] = {"Retry-After": "2"}


def error_json(code: str, message: str, fields: Mapping[str, str] | None = None) -> bytes:
    """The one error shape, as bytes. ASCII only, so that not even a lone surrogate can break it."""
    return json.dumps({"error": {"code": code, "message": message, "fields": dict(fields or {})}}).encode()
