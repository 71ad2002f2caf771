"""The reference page of the API, made from the OpenAPI schema: nothing in it is written twice."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from fastapi import APIRouter, Request
from pydantic import BaseModel, Field
from starlette.responses import Response

from app.pages import render

router = APIRouter(include_in_schema=False)


class ErrorBody(BaseModel):
    """What went wrong."""

    code: str = Field(description="For programs.")
    message: str = Field(description="A sentence for people.")
    fields: dict[str, str] = Field(description="What was wrong in which field; empty if no field is to blame.")


class ErrorOut(BaseModel):
    """The one shape of every error."""

    error: ErrorBody


ERRORS: dict[int | str, dict[str, Any]] = {
    403: {"model": ErrorOut, "description": "Another site's page sent this."},
    404: {"model": ErrorOut, "description": "There is nothing here, or it belongs to somebody else."},
    409: {"model": ErrorOut, "description": "What is stored already speaks against it."},
    413: {"model": ErrorOut, "description": "The body is too large."},
    415: {"model": ErrorOut, "description": "The body is not declared as application/json."},
    422: {"model": ErrorOut, "description": "Not valid JSON, or impossible; `fields` says where."},
    503: {"model": ErrorOut, "description": "The database is busy or full: nothing was stored, try again later."},
}
"""What any call may answer; given to every router of the API."""


@dataclass(frozen=True, slots=True)
class Call:
    """One call of the API."""

    method: str
    url: str
    summary: str
    description: str
    parameters: list[dict[str, Any]]
    fields: list[dict[str, str]]
    example: str
    answers: list[dict[str, Any]]
    errors: list[dict[str, Any]]


@dataclass(frozen=True, slots=True)
class DocsPage:
    """Where a programmer reads what the API can do."""

    groups: dict[str, list[Call]] = field(metadata={"help": "The calls by room."})
    path: None = field(default=None, metadata={"help": "Nowhere on the path from Play to Compare."})


@router.get("/docs", response_model=None)
def show_docs(request: Request) -> Response:
    """Show every call with its body, answers and errors."""
    return render(request, "docs.html", DocsPage(groups=calls_by_group(request.app.openapi())))


def calls_by_group(schema: Mapping[str, Any]) -> dict[str, list[Call]]:
    """Read the calls out of the OpenAPI schema, in its order."""
    groups: dict[str, list[Call]] = {}
    for url, operations in schema["paths"].items():
        for method, operation in operations.items():
            group = operation.get("tags", ["other"])[0]
            groups.setdefault(group, []).append(_call(schema, method, url, operation))
    return groups


def _call(schema: Mapping[str, Any], method: str, url: str, operation: Mapping[str, Any]) -> Call:
    body = _resolve(schema, _json_schema(operation.get("requestBody", {})))
    answers = [_answer(schema, status, told) for status, told in operation["responses"].items()]
    return Call(
        method=method.upper(),
        url=url,
        summary=operation["summary"],
        description=operation.get("description", ""),
        parameters=[
            {"name": one["name"], "in": one["in"], "type": _type(one.get("schema", {}))}
            for one in operation.get("parameters", [])
        ],
        fields=list(_fields(body)),
        example=_example(method, url, body),
        answers=[one for one in answers if one["status"] < "4"],
        errors=[one for one in answers if one["status"] >= "4"],
    )


def _json_schema(message: Mapping[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = message.get("content", {}).get("application/json", {}).get("schema", {})
    return found


def _resolve(schema: Mapping[str, Any], part: Mapping[str, Any]) -> dict[str, Any]:
    """Follow a reference to the place where the type is described; of "this or nothing" take this."""
    for one in part.get("anyOf", []):
        if one.get("type") != "null":
            return _resolve(schema, one)
    if "$ref" in part:
        named: dict[str, Any] = schema["components"]["schemas"][part["$ref"].rpartition("/")[2]]
        return named
    return dict(part)


def _fields(described: Mapping[str, Any]) -> Iterator[dict[str, str]]:
    required = described.get("required", [])
    for name, one in described.get("properties", {}).items():
        default = "required" if name in required else f"default {json.dumps(one.get('default'))}"
        yield {"name": name, "type": _type(one), "default": default, "help": one.get("description", "")}


def _type(part: Mapping[str, Any]) -> str:
    """A type in a few words: `integer 2…100`, `list of list of string`."""
    if "anyOf" in part:
        return " or ".join(_type(one) for one in part["anyOf"])
    if "$ref" in part:
        return str(part["$ref"].rpartition("/")[2])
    if "enum" in part:
        return " or ".join(json.dumps(one) for one in part["enum"])
    if part.get("type") == "array":
        return f"list of {_type(part.get('items', {}))}"
    name = str(part.get("format") or part.get("type", "anything"))
    low, high = part.get("minimum"), part.get("maximum")
    return name if low is None and high is None else f"{name} {_bound(low)}…{_bound(high)}"


def _bound(value: float | None) -> str:
    return "" if value is None else f"{value:g}" if abs(value) < 1e15 else "2⁵³ − 1"


def _answer(schema: Mapping[str, Any], status: str, told: Mapping[str, Any]) -> dict[str, Any]:
    part = _json_schema(told)
    is_list = part.get("type") == "array"
    fields = list(_fields(_resolve(schema, part["items"] if is_list else part)))
    return {"status": status, "description": told.get("description", ""), "fields": fields, "is_list": is_list}


def _example(method: str, url: str, body: Mapping[str, Any]) -> str:
    """A command that can be pasted into a shell once the ids are filled in."""
    place = url.replace("{", "$").replace("}", "").replace("$outcome", "success")
    command = f'curl -b cookies -c cookies -X {method.upper()} "$IRLFR{place}"'
    if not body.get("properties"):
        return command
    sent = json.dumps((body.get("examples") or [{}])[0])
    return f"{command} \\\n  -H 'Content-Type: application/json' -d '{sent}'"
