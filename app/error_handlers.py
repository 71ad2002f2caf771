"""Turns whatever was raised into one answer: the error shape for programs, a page with the same sentence for people."""

import logging
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from sqlalchemy.exc import OperationalError
from sqlalchemy.exc import TimeoutError as PoolTimeout
from starlette.exceptions import HTTPException
from starlette.responses import HTMLResponse, Response

from app.errors import AppError, ImpossibleWorld, Unavailable, Unprocessable, error_json
from app.kit.writer import WriterIsBusy
from irl_core import IrlError

logger = logging.getLogger(__name__)

JSON_PATHS = ("/api/", "/openapi.json", "/healthz", "/readyz")
MOST_FIELDS_NAMED = 20


@dataclass(frozen=True, slots=True)
class ErrorPage:
    """What a person sees in place of the page they asked for."""

    status: int = field(metadata={"help": "The HTTP status."})
    title: str = field(metadata={"help": "Two or three words."})
    message: str = field(metadata={"help": "What was wrong and what would be right, in a sentence."})
    mend_at: str | None = field(default=None, metadata={"help": "The page where what was wrong can be mended."})
    path: None = field(default=None, metadata={"help": "Nowhere on the path from Play to Compare."})


def add_error_handlers(app: FastAPI) -> None:
    """Teach the app to answer every expected error. The unexpected ones are `security.UnexpectedErrors`'."""

    @app.exception_handler(AppError)
    def refuse(request: Request, error: AppError) -> Response:
        return answer(
            request,
            status=error.status,
            code=error.error_code,
            message=error.message,
            fields=error.fields,
            headers=error.headers,
            mend_at=error.mend_at if isinstance(error, ImpossibleWorld) else None,
        )

    @app.exception_handler(IrlError)
    def refuse_by_science(request: Request, error: IrlError) -> Response:
        name = getattr(error, "field", None)
        return refuse(request, Unprocessable(str(error), fields={name: str(error)} if name else None))

    @app.exception_handler(RequestValidationError)
    def refuse_input(request: Request, error: RequestValidationError) -> Response:
        return refuse(request, invalid_input(error.errors()))

    @app.exception_handler(HTTPException)
    def refuse_by_framework(request: Request, error: HTTPException) -> Response:
        status = HTTPStatus(error.status_code)
        code = status.phrase.lower().replace(" ", "_").replace("-", "_")
        sentence = _FRAMEWORK_SENTENCES.get(status, f"{status.phrase}.")
        return answer(request, status=status, code=code, message=sentence, fields={}, headers=error.headers)

    @app.exception_handler(OperationalError)
    @app.exception_handler(PoolTimeout)
    @app.exception_handler(WriterIsBusy)
    def come_back_later(request: Request, error: Exception) -> Response:
        logger.warning("The database could not take %s %s: %s", request.method, request.url.path, error)
        return refuse(request, Unavailable("The server cannot store anything just now; please try again in a moment."))


def apologise(request: Request) -> Response:
    """Answer for an error that nobody foresaw."""
    message = "Something went wrong on our side. What was saved is safe; please try again."
    return answer(request, status=500, code="internal", message=message, fields={})


_FRAMEWORK_SENTENCES = {
    HTTPStatus.NOT_FOUND: "There is nothing at this address.",
    HTTPStatus.METHOD_NOT_ALLOWED: "This address does not answer to that method.",
    HTTPStatus.BAD_REQUEST: "The request could not be read.",
}


_TITLES = {
    HTTPStatus.NOT_FOUND: "Nothing here",
    HTTPStatus.UNPROCESSABLE_ENTITY: "That cannot be",
    HTTPStatus.INTERNAL_SERVER_ERROR: "Our mistake",
    HTTPStatus.SERVICE_UNAVAILABLE: "One moment, please",
}


def answer(
    request: Request,
    *,
    status: int,
    code: str,
    message: str,
    fields: Mapping[str, str],
    headers: Mapping[str, str] | None = None,
    mend_at: str | None = None,
) -> Response:
    """One error, in the form in which the asker can read it."""
    if request.url.path.startswith(JSON_PATHS):
        body = error_json(code, message, fields)
        return Response(body, status, dict(headers or {}), media_type="application/json")
    title = _TITLES.get(HTTPStatus(status), HTTPStatus(status).phrase)
    page = ErrorPage(status=int(status), title=title, message=message, mend_at=mend_at)
    response = _render(request, page)
    response.headers.update(headers or {})
    return response


def _render(request: Request, page: ErrorPage) -> HTMLResponse:
    try:
        return request.app.state.pages.render(request, "error.html", page, status=page.status)  # type: ignore[no-any-return]
    except Exception:
        logger.exception("The error page itself failed")
        plain = f"<!doctype html><title>{escape(page.title)}</title><h1>{escape(page.title)}</h1>"
        return HTMLResponse(f'{plain}<p>{escape(page.message)}</p><p><a href="/">Play a world</a></p>', page.status)


def invalid_input(errors: Sequence[Mapping[str, Any]]) -> Unprocessable:
    """What pydantic found, as sentences by field. What was sent is never repeated."""
    fields = {_place(error["loc"]): _sentence(error) for error in errors[:MOST_FIELDS_NAMED]}
    first = "; ".join(f"{place}: {sentence}" for place, sentence in list(fields.items())[:3])
    return Unprocessable(f"The request cannot be used: {first}.", fields=fields)


def _place(location: Sequence[str | int]) -> str:
    """`actions.3`. A name the client made up is repeated only if it looks like a name."""
    parts = [_name(part) for part in location if part not in {"body", "query", "path", "header"}]
    return ".".join(parts) or "body"


def _name(part: str | int) -> str:
    if isinstance(part, int) or re.fullmatch(r"[A-Za-z_][A-Za-z0-9_-]{0,39}", part):
        return str(part)
    return "(a name we do not know)"


def _sentence(error: Mapping[str, Any]) -> str:
    kind = error["type"]
    if kind in _SENTENCES:
        return _SENTENCES[kind].format_map(error.get("ctx", {}))
    if kind.startswith("uuid"):
        return "must be a UUID"
    message = str(error["msg"]).removeprefix("Value error, ").removeprefix("Input ")
    return message[:1].lower() + message[1:]


_SENTENCES = {
    "missing": "is missing",
    "extra_forbidden": "is not a field of this request",
    "json_invalid": "is not valid JSON",
    "int_type": "must be a whole number",
    "int_from_float": "must be a whole number",
    "int_parsing": "must be a whole number",
    "int_parsing_size": "must be a whole number of reasonable size",
    "float_type": "must be a number",
    "float_parsing": "must be a number",
    "finite_number": "must be a finite number",
    "bool_type": "must be true or false",
    "string_type": "must be text",
    "string_unicode": "must be valid Unicode text",
    "list_type": "must be a list",
    "tuple_type": "must be a list",
    "greater_than_equal": "must be at least {ge:.16g}",
    "less_than_equal": "must be at most {le:.16g}",
    "too_short": "must have at least {min_length} entries",
    "too_long": "must have at most {max_length} entries",
    "dict_type": "must be an object",
    "model_type": "must be an object",
    "model_attributes_type": "must be an object",
}
