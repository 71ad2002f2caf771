"""The pages about the library run as they are shown, name everything there is, and nothing that is not."""

import importlib
import inspect
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import irl_core
from tests import run_docs

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
PAGES = ("tutorial.md", "api.md", "which-learner.md", "numerics.md", "settings.md")
API = (DOCS / "api.md").read_text(encoding="utf-8")

SUBMODULES = (
    "demonstrators",
    "environment",
    "experiment",
    "features",
    "influence",
    "maxent",
    "mdp.toy_text",
    "preferences",
    "simulators",
    "uncertainty",
)
HELPERS_OF_TYPES = {"HasStates", "HasTable"}  # what type checkers are told of an argument

ENTRY = re.compile(r"\*\*`(\w+)(\([^`]*\))?`\*\*")


@pytest.mark.parametrize("doc", ["tutorial.md", "api.md"])
def test_the_page_runs_and_prints_what_it_shows(doc: str, capsys: pytest.CaptureFixture[str]) -> None:
    code = run_docs.main(DOCS / doc, write=False)
    assert code == 0, capsys.readouterr().out


@pytest.mark.parametrize("shown", ["ends 1\n", "ends 0.50 in 3\n", "ends −0.50 in 4\n", "ends 0.53 in 4\n", ""])
def test_a_page_that_shows_something_else_is_found_out(shown: str) -> None:
    block = run_docs.Block(line=1, code="", shown=shown, varies=False)
    assert not run_docs.is_as_shown(block, "ends 0.50 in 4\n")


@pytest.mark.parametrize("shown", ["ends 0.50 in 4\n", "ends  0.51 in 4\n"])
def test_the_last_place_of_a_figure_may_differ_by_one(shown: str) -> None:
    assert run_docs.is_as_shown(run_docs.Block(line=1, code="", shown=shown, varies=False), "ends 0.50 in 4\n")


@pytest.mark.parametrize("doc", PAGES)
def test_every_link_of_a_page_leads_somewhere(doc: str) -> None:
    links = re.findall(r"\]\(([^)#]+)[^)]*\)", (DOCS / doc).read_text(encoding="utf-8"))
    assert not [link for link in links if "://" not in link and not (DOCS / link).exists()]


def test_the_front_door_is_documented_name_by_name() -> None:
    front = {name for module, name, _ in entries() if module is irl_core}
    assert front == set(irl_core.__all__)


@pytest.mark.parametrize("name", SUBMODULES)
def test_every_public_name_of_a_submodule_is_documented(name: str) -> None:
    module = importlib.import_module(f"irl_core.{name}")
    documented = {one for home, one, _ in entries() if home is module} | set(irl_core.__all__)
    public = getattr(module, "__all__", None) or [
        one
        for one, thing in vars(module).items()
        if not one.startswith("_") and getattr(thing, "__module__", None) == module.__name__ and callable(thing)
    ]
    assert not set(public) - documented - HELPERS_OF_TYPES


def test_every_documented_name_exists() -> None:
    assert not [f"{module.__name__}.{name}" for module, name, _ in entries() if not hasattr(module, name)]
    used = set(re.findall(r"\birl\.([A-Za-z_]+)", API))
    assert not used - set(irl_core.__all__)


def test_every_function_shows_the_signature_it_has() -> None:
    for module, name, shown in entries():
        thing = getattr(module, name)
        if shown or inspect.isfunction(thing):
            assert shown == signature(thing), f"{module.__name__}.{name}{signature(thing)} in docs/api.md"


def test_every_learner_is_on_the_page_that_helps_to_choose() -> None:
    text = (DOCS / "which-learner.md").read_text(encoding="utf-8")
    assert not [name for name in irl_core.LEARNERS if f"`{name}`" not in text]


def entries() -> Iterator[tuple[Any, str, str]]:
    """Each name in bold: the module that its section is about, the name, and its signature if one is shown."""
    module: Any = irl_core
    for line in API.splitlines():
        if heading := re.match(r"## (irl_core\.[\w.]+)$", line):
            module = importlib.import_module(heading[1])
        for name, shown in ENTRY.findall(line):
            yield module, name, shown


def signature(thing: Callable[..., Any]) -> str:
    """As the page writes it: names and defaults; a default that is a function is an ellipsis."""
    shown: list[str] = []
    for one in inspect.signature(thing).parameters.values():
        if one.kind is one.KEYWORD_ONLY and "*" not in shown:
            shown.append("*")
        default = "…" if callable(one.default) else repr(one.default).replace("'", '"')
        shown.append(one.name if one.default is one.empty else f"{one.name}={default}")
    return f"({', '.join(shown)})"
