"""Run the Python of a page, block after block in one namespace, and compare what is printed with what the page shows.

    python tests/run_docs.py docs/tutorial.md            # says which block prints something else, and what
    python tests/run_docs.py docs/tutorial.md --write    # puts what is printed now into the page

A ```text block right below a ```python block is its output. Figures may differ by one unit in their last place, since
another processor or library may round the other way; below ```text varies only the number of lines counts. Needs
nothing but irl_core, so that it also runs where only the wheel is installed.
"""

import contextlib
import io
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

BLOCK = re.compile(
    r"^```python\n(?P<code>.*?)^```\n(?:\n```text(?P<how>[^\n]*)\n(?P<shown>.*?)^```\n)?", re.MULTILINE | re.DOTALL
)
NUMBER = re.compile(r"[-−+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


@dataclass(frozen=True)
class Block:
    """One block: its line in the page, its code, the output shown (None: none) and whether that may vary."""

    line: int
    code: str
    shown: str | None
    varies: bool


def blocks_of(text: str) -> list[Block]:
    return [
        Block(
            line=text.count("\n", 0, found.start("code")) + 1,
            code=found["code"],
            shown=found["shown"],
            varies=(found["how"] or "").strip() == "varies",
        )
        for found in BLOCK.finditer(text)
    ]


def run(text: str, name: str) -> Iterator[tuple[Block, str]]:
    """Each block with what it printed."""
    namespace: dict[str, Any] = {"__name__": "__main__"}
    for block in blocks_of(text):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            # As many lines ahead as the page has, so that a traceback names the page's own line.
            exec(compile("\n" * (block.line - 1) + block.code, name, "exec"), namespace)
        yield block, printed.getvalue()


def is_as_shown(block: Block, printed: str) -> bool:
    if block.shown is None:
        return not printed
    if block.varies:
        return len(block.shown.splitlines()) == len(printed.splitlines())
    if NUMBER.sub("0", squeezed(block.shown)) != NUMBER.sub("0", squeezed(printed)):
        return False
    pairs = zip(NUMBER.findall(block.shown), NUMBER.findall(printed), strict=True)
    return all(are_near(shown, found) for shown, found in pairs)


def squeezed(text: str) -> str:
    """Without the spaces that align columns: a figure of another length shifts them."""
    return "\n".join(" ".join(line.split()) for line in text.strip().splitlines())


def are_near(shown: str, found: str) -> bool:
    """Equal, or apart by one unit in the last place shown; whole numbers are equal or wrong."""
    if shown == found or "." not in shown:
        return shown == found
    mantissa, _, exponent = shown.replace("−", "-").partition("e")
    unit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return abs(float(shown.replace("−", "-")) - float(found.replace("−", "-"))) <= 1.001 * unit


def rewritten(text: str, printed: list[str]) -> str:
    """The page with what was printed below each block that shows an output."""
    outputs = iter(printed)

    def replaced(found: re.Match[str]) -> str:
        output = next(outputs)
        if found["shown"] is None:
            return found[0]
        how = found["how"]
        return f"```python\n{found['code']}```\n\n```text{how}\n{output.rstrip()}\n```\n"

    return BLOCK.sub(replaced, text)


def main(path: Path, *, write: bool) -> int:
    text = path.read_text(encoding="utf-8")
    ran = list(run(text, str(path)))
    if write:
        path.write_text(rewritten(text, [printed for _, printed in ran]), encoding="utf-8")
        return 0
    wrong = [(block, printed) for block, printed in ran if not is_as_shown(block, printed)]
    for block, printed in wrong:
        print(f"{path}:{block.line} shows\n{block.shown}\nbut prints\n{printed}")
    print(f"{path.name}: {len(ran)} blocks ran, {len(wrong)} print something else")
    return 1 if wrong or not ran else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), write="--write" in sys.argv[2:]))
