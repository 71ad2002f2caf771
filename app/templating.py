"""Pages from templates: the Jinja environment, where static files lie, and what every template can call.

- `asset("css/base.css")`: the URL of a static file, with its version, so that browsers may keep it
- `import_map()`: the names of our own and the third-party modules, for `<script type="importmap">`
- `value | page_data`: JSON that is safe inside `<script type="application/json">`
- `csp_nonce`: allows an inline script of this one answer
"""

import dataclasses
import hashlib
import json
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

from fastapi import Request
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from starlette.responses import HTMLResponse

PACKAGE = Path(__file__).parent


class MissingAssets(RuntimeError):
    """The browser's third-party packages have not been brought in."""

    def __init__(self, manifest: Path) -> None:
        super().__init__(
            f"The browser's packages are missing: there is no readable {manifest.name} in {manifest.parent}. "
            "Bring them in with: python3 dev.py run"
        )


def find_folder(name: str) -> Path:
    """`templates` or `static`: inside the package in an installed wheel, beside it in a checkout."""
    inside = PACKAGE / name
    return inside if inside.is_dir() else PACKAGE.parent / name


class Pages:
    """Renders pages. One for each app, opened at its start."""

    def __init__(self, *, allow_missing_assets: bool = False) -> None:
        self.static = find_folder("static")
        self.vendor = _read_vendor_manifest(self.static, allow_missing=allow_missing_assets)
        self.environment = Environment(
            loader=FileSystemLoader(find_folder("templates")), autoescape=True, undefined=StrictUndefined,
            trim_blocks=True, lstrip_blocks=True,
        )  # fmt: skip
        self.environment.filters["page_data"] = page_data
        self.environment.globals.update(asset=self.asset, import_map=lambda: self.import_map)

    def render(self, request: Request, template: str, page: Any, *, status: int = 200) -> HTMLResponse:  # noqa: ANN401
        """Render a page from its context, a dataclass: its fields are the template's variables, `page` is the whole."""
        context = {field.name: getattr(page, field.name) for field in dataclasses.fields(page)}
        html = self.environment.get_template(template).render(
            context, page=page, request=request, csp_nonce=request.state.csp_nonce
        )
        return HTMLResponse(html, status)

    def asset(self, path: str) -> str:
        """Return the URL of a static file, with its version; a module keeps the one URL by which others import it."""
        return f"/static/{path}" if path.endswith(".js") else f"/static/{path}?v={_version(self.static / path)}"

    @cached_property
    def import_map(self) -> Markup:
        """`#js/…` for our own modules, and each third-party package by its name, checked by its hash."""
        packages = self.vendor["packages"]
        entries = {name: f"/static/vendor/{package['entry']}" for name, package in packages.items()}
        integrity = {entries[name]: package["integrity"] for name, package in packages.items()}
        return page_data({"imports": {"#js/": "/static/js/", **entries}, "integrity": integrity})


def page_data(value: Any) -> Markup:  # noqa: ANN401 - anything that JSON can say
    """Serialise for a script island: no `</script>`, no `<!--`, no line separator of JavaScript can appear."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)  # noqa: S704 - made safe in the line above


@lru_cache(maxsize=1024)
def _version(path: Path) -> str:
    """Twelve characters that change when the file does; a missing file has none and shows as 404 in the browser."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:12] if path.is_file() else "missing"


def _read_vendor_manifest(static: Path, *, allow_missing: bool) -> dict[str, Any]:
    path = static / "vendor" / "manifest.json"
    try:
        manifest: dict[str, Any] = json.loads(path.read_text("utf-8"))
        for package in manifest["packages"].values():
            if not (path.parent / package["entry"]).is_file():
                raise MissingAssets(path)
    except (OSError, ValueError, KeyError, TypeError):
        if allow_missing:
            return {"packages": {}}
        raise MissingAssets(path) from None
    return manifest
