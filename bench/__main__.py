"""`python -m bench [part …]`: measure, print a table, write bench.json; `python3 dev.py bench` sets up before."""

import json
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

for _library in ("OMP", "OPENBLAS", "MKL"):
    os.environ[f"{_library}_NUM_THREADS"] = "1"  # before NumPy is imported: one thread on both sides

from bench import core, experiment, learn, play, rank, web  # noqa: E402
from bench.measure import Figure  # noqa: E402

PARTS: dict[str, Callable[[], Iterator[Figure]]] = {
    "core": core.measure,
    "play": play.measure,
    "rank": rank.measure,
    "learn": learn.measure,
    "web": web.measure,
    "experiment": experiment.measure,
}


def main(asked: list[str]) -> int:
    unknown = [name for name in asked if name not in PARTS]
    if unknown:
        print(f"There is no benchmark {unknown[0]!r}; there are: {', '.join(PARTS)}.", file=sys.stderr)
        return 2
    report: dict[str, list[Figure]] = {}
    for name in asked or PARTS:
        print(f"\n{name}", flush=True)
        report[name] = []
        for figure in PARTS[name]():
            report[name].append(figure)
            print_figure(figure)
    text = json.dumps({name: [figure.to_json() for figure in figures] for name, figures in report.items()}, indent=1)
    Path("bench.json").write_text(text + "\n", encoding="utf-8")
    print("\nbench.json written; a missed target is a finding, not a failure of this command")
    return 0


def print_figure(figure: Figure) -> None:
    verdict = {True: "met", False: "MISSED", None: "not measured"}[figure.met]
    value = "" if figure.value is None else f"{figure.value:.3g} {figure.unit}"
    spread = f"[{min(figure.runs):.3g} … {max(figure.runs):.3g}]" if len(figure.runs) > 1 else ""
    goal = f"goal {figure.goal}" if figure.goal else ""
    measured = f"{figure.name:68} {value:>12} {spread:>17}  must {figure.target:>9} {verdict:6} {goal:>9}"
    print(f"  {measured}  {figure.reference}", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
