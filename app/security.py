"""What surrounds every request: headers, the body's size and form, other sites. Pure ASGI: streams pass.

Outermost first: SecurityHeaders → VisitorCookie (visitors.py) → CrossSiteGuard → JsonBodies → UnexpectedErrors.
"""

import json
import logging
import secrets
from collections.abc import Callable, Sequence
from typing import Any, NoReturn
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.errors import AppError, Forbidden, NotJson, TooLarge, Unprocessable, error_json

logger = logging.getLogger(__name__)

SAFE_METHODS = frozenset({"GET", "HEAD", "OPTIONS"})
API_PREFIX = "/api/"

CONTENT_SECURITY_POLICY = (
    "default-src 'none'; "
    "script-src 'nonce-{nonce}' 'self'; "
    "style-src 'self' 'nonce-{nonce}'; "
    "img-src 'self' data: blob:; "
    "connect-src 'self'; "
    "font-src 'self'; "
    "manifest-src 'self'; "
    "base-uri 'none'; "
    "form-action 'self'; "
    "frame-ancestors 'none'"
)
FIXED_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "strict-origin-when-cross-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=(), payment=(), usb=()",
}
ONE_YEAR_S = 31_536_000


class SecurityHeaders:
    """Gives each response its headers and each request a nonce (`request.state.csp_nonce`) for inline scripts."""

    def __init__(self, app: ASGIApp, *, https: bool) -> None:
        self.app = app
        self.fixed = {**FIXED_HEADERS, **({"Strict-Transport-Security": f"max-age={ONE_YEAR_S}"} if https else {})}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        nonce = secrets.token_urlsafe(16)
        scope.setdefault("state", {})["csp_nonce"] = nonce

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers.update(self.fixed)
                headers["Content-Security-Policy"] = CONTENT_SECURITY_POLICY.format(nonce=nonce)
                _forbid_storing_what_is_personal(scope, headers)
            await send(message)

        await self.app(scope, receive, send_with_headers)


def _forbid_storing_what_is_personal(scope: Scope, headers: MutableHeaders) -> None:
    """Answers depend on the visitor's cookie; only static files may be kept by caches."""
    if not scope["path"].startswith("/static/"):
        headers.setdefault("Cache-Control", "no-store")


class CrossSiteGuard:
    """Refuses unsafe requests that another site's page made in the visitor's name.

    Browsers send Sec-Fetch-Site, which cannot be forged by a page; older ones only Origin, which must then name our
    own host. Programs send neither and are let through: they hold no visitor's cookie but their own.
    """

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http" and scope["method"] not in SAFE_METHODS and _is_cross_site(Headers(scope=scope)):
            await _refuse(send, Forbidden("This request came from another site's page, so it was not carried out."))
            return
        await self.app(scope, receive, send)


def _is_cross_site(headers: Headers) -> bool:
    fetch_site = headers.get("sec-fetch-site")
    if fetch_site is not None:
        return fetch_site not in {"same-origin", "none"}
    origin = headers.get("origin")
    return origin is not None and _host(origin) != headers.get("host", "").lower()


def _host(origin: str) -> str | None:
    try:
        return urlsplit(origin).netloc.lower() or None
    except ValueError:
        return None


class JsonBodies:
    """Lets a body of the API through only if it is small enough, declared as JSON and strictly JSON.

    Strict means what Python's parser forgives: NaN and Infinity, a name given twice, integers of thousands of digits,
    nesting without end, text that is no Unicode. Checked here, once for every route there is or will be.
    """

    def __init__(self, app: ASGIApp, *, max_body_bytes: int) -> None:
        self.app = app
        self.max_body_bytes = max_body_bytes

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or scope["method"] in SAFE_METHODS:
            await self.app(scope, receive, send)
            return
        try:
            body = await self._read(Headers(scope=scope), receive)
            if body and scope["path"].startswith(API_PREFIX):
                _check_is_declared_json(Headers(scope=scope))
                check_is_strict_json(body)
        except AppError as error:
            await _refuse(send, error)
            return
        except _Disconnected:
            return
        await self.app(scope, _replay(body, receive), send)

    async def _read(self, headers: Headers, receive: Receive) -> bytes:
        """The whole body, counted as it comes: a declared length may be missing or a lie."""
        declared = headers.get("content-length", "")
        if declared.isdecimal() and int(declared[:20]) > self.max_body_bytes:
            raise self._too_large()
        chunks, n_bytes, more = [], 0, True
        while more:
            message = await receive()
            if message["type"] == "http.disconnect":
                raise _Disconnected
            chunk = message.get("body", b"")
            chunks.append(chunk)
            n_bytes += len(chunk)
            if n_bytes > self.max_body_bytes:
                raise self._too_large()
            more = message.get("more_body", False)
        return b"".join(chunks)

    def _too_large(self) -> TooLarge:
        return TooLarge(f"The body is larger than {self.max_body_bytes:,} bytes, the most this server accepts.")


class _Disconnected(Exception):
    """The client left before its body was complete."""


def _check_is_declared_json(headers: Headers) -> None:
    media_type = headers.get("content-type", "").partition(";")[0].strip().lower()
    if media_type != "application/json":
        raise NotJson("The body must be JSON, declared as Content-Type: application/json.")


def check_is_strict_json(body: bytes) -> None:
    """Raise Unprocessable with a sentence about the first thing that is not JSON; nothing of the body is repeated."""
    try:
        text = body.decode("utf-8")
        json.loads(text, parse_constant=_refuse_constant, object_pairs_hook=_refuse_doubled_names)
    except UnicodeDecodeError as error:
        raise _not_json(f"it is not UTF-8 at byte {error.start}") from None
    except json.JSONDecodeError as error:
        raise _not_json(f"{error.msg.partition(':')[0].lower()} at line {error.lineno}, column {error.colno}") from None
    except RecursionError:
        raise _not_json("it is nested too deeply") from None
    except ValueError:  # Python's limit on the digits of an integer
        raise _not_json("a number has too many digits") from None


def _refuse_constant(name: str) -> NoReturn:
    raise _not_json(f"{name} is not a number in JSON")


def _refuse_doubled_names(pairs: Sequence[tuple[str, Any]]) -> dict[str, Any]:
    names = dict(pairs)
    if len(names) != len(pairs):
        raise _not_json("an object gives the same name twice")
    return names


def _not_json(reason: str) -> Unprocessable:
    return Unprocessable(f"The body is not valid JSON: {reason}.", fields={"body": reason}, code="invalid_json")


def _replay(body: bytes, receive: Receive) -> Receive:
    """A receive that hands out the body that was read, then waits on the connection as before."""
    messages: list[Message] = [{"type": "http.request", "body": body, "more_body": False}]

    async def replay() -> Message:
        return messages.pop() if messages else await receive()

    return replay


class UnexpectedErrors:
    """The last net: an error nobody foresaw is logged and answered in our shape, with our headers around it."""

    def __init__(self, app: ASGIApp, *, apologise: Callable[[Request], ASGIApp]) -> None:
        self.app = app
        self.apologise = apologise

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        started = False

        async def watch(message: Message) -> None:
            nonlocal started
            started = started or message["type"] == "http.response.start"
            await send(message)

        try:
            await self.app(scope, receive, watch)
        except Exception:
            if scope["type"] != "http" or started:
                raise
            logger.exception("Unexpected error in %s %s", scope["method"], scope["path"])
            await self.apologise(Request(scope))(scope, receive, send)


async def _refuse(send: Send, error: AppError) -> None:
    body = error_json(error.error_code, error.message, error.fields)
    headers = [(b"content-type", b"application/json"), (b"content-length", str(len(body)).encode())]
    await send({"type": "http.response.start", "status": error.status, "headers": headers})
    await send({"type": "http.response.body", "body": body})
