"""What to cite for a run: the paper, this software, and the methods of exactly the learners that took part.

`WORKS` holds each work once; `METHODS` says which works a learner stands on. What is not known for sure (who wrote the
paper, and when and where it appeared) is said to be unknown rather than guessed.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

PAPER = "irlfr"
SOFTWARE = "irlfr-software"


@dataclass(frozen=True, slots=True)
class Work:
    """Something that was published: BibTeX's kind and fields, authors as "Surname, Given names"."""

    kind: str
    title: str
    authors: tuple[str, ...] = ()
    year: int | None = None
    fields: tuple[tuple[str, str], ...] = ()
    note: str = ""

    @property
    def short(self) -> str:
        """As a caption names it: "Ziebart et al. 2008"."""
        names = [author.partition(",")[0].strip("{}") for author in self.authors]
        if not names:
            return self.title.partition(":")[0]
        others = {1: "", 2: f" and {names[-1]}"}.get(len(names), " et al.")
        return f"{names[0]}{others}{f' {self.year}' if self.year else ''}"

    @property
    def text(self) -> str:
        """As a list of references has it."""
        when = f" ({self.year}). " if self.year else ". "
        by = f"{_listed([_initialled(author) for author in self.authors])}{when}" if self.authors else ""
        details = {name: value.replace("--", "–") for name, value in self.fields}
        venue = details.get("booktitle") or details.get("journal") or details.get("school") or ""
        number = f" {details['volume']}" if "journal" in details and "volume" in details else ""
        issue = f" ({details['number']})" if number and "number" in details else ""
        pages = f", {details['pages']}" if "pages" in details else ""
        where = f" {venue}{number}{issue}{pages}." if venue else ""
        note = f" {self.note}" if self.note else ""
        return f"{by}{self.title}.{where}{note}"

    def bibtex(self, key: str) -> str:
        """As BibTeX reads it; capitals of the title stay."""
        fields = {
            "author": " and ".join(self.authors),
            "title": f"{{{self.title}}}",
            "year": str(self.year or ""),
            **dict(self.fields),
            "note": self.note,
        }
        lines = [f"  {name} = {{{value}}}," for name, value in fields.items() if value]
        return "\n".join([f"@{self.kind}{{{key},", *lines, "}"])


def citations_of(
    learners: Sequence[str], settings: Mapping[str, object], *, versions: Mapping[str, str] | None = None
) -> list[dict[str, Any]]:
    """Return what to cite for these learners, the paper and the software first.

    Each has `key`, `short` (for a caption), `text`, `bibtex` and `learners`, those that stand on it.
    """
    used: dict[str, list[str]] = {}
    for learner in learners:
        for key in _methods(learner, settings):
            used.setdefault(key, []).append(learner)
    works = {PAPER: WORKS[PAPER], SOFTWARE: _software((versions or {}).get("irlfr"))}
    works |= {key: WORKS[key] for key in sorted(used) if key != PAPER}
    return [
        {"key": key, "short": work.short, "text": work.text, "bibtex": work.bibtex(key), "learners": used.get(key, [])}
        for key, work in works.items()
    ]


def _methods(learner: str, settings: Mapping[str, object]) -> tuple[str, ...]:
    known = METHODS.get(learner, ())
    is_causal = settings.get("inference") == "causal" and learner in {"meirl", "irlr", "irlf", "irlfr"}
    return (*known, "ziebart2010") if is_causal else known


def _software(version: str | None) -> Work:
    of = f", version {version}" if version else ""
    return Work("software", f"IRLFR{of}", authors=("{The IRLFR authors}",), note="Computer program, MIT licence.")


def _initialled(author: str) -> str:
    """Shorten "Ziebart, Brian D." to "Ziebart, B. D."; a group in braces keeps its name."""
    surname, _, given = author.strip("{}").partition(", ")
    initials = " ".join(f"{name[0]}." for name in given.replace("-", " ").split())
    return f"{surname}, {initials}" if initials else surname


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


WORKS: Mapping[str, Work] = {
    PAPER: Work(
        "misc",
        "IRLFR: inverse reinforcement learning from failed and ranked demonstrations",
        note="The paper whose algorithms these are. The copy they were built from names no authors, year or venue.",
    ),
    "boularias2011": Work(
        "inproceedings",
        "Relative Entropy Inverse Reinforcement Learning",
        ("Boularias, Abdeslam", "Kober, Jens", "Peters, Jan"),
        2011,
        (
            ("booktitle", "Proceedings of the 14th International Conference on Artificial Intelligence and Statistics"),
            ("pages", "182--189"),
        ),
    ),
    "bradley1952": Work(
        "article",
        "Rank Analysis of Incomplete Block Designs: I. The Method of Paired Comparisons",
        ("Bradley, Ralph Allan", "Terry, Milton E."),
        1952,
        (("journal", "Biometrika"), ("volume", "39"), ("number", "3/4"), ("pages", "324--345")),
    ),
    "brown2019": Work(
        "inproceedings",
        "Extrapolating Beyond Suboptimal Demonstrations via Inverse Reinforcement Learning from Observations",
        ("Brown, Daniel S.", "Goo, Wonjoon", "Nagarajan, Prabhat", "Niekum, Scott"),
        2019,
        (("booktitle", "Proceedings of the 36th International Conference on Machine Learning"), ("pages", "783--792")),
    ),
    "burchfiel2016": Work(
        "inproceedings",
        "Distance Minimization for Reward Learning from Scored Trajectories",
        ("Burchfiel, Benjamin", "Tomasi, Carlo", "Parr, Ronald"),
        2016,
        (("booktitle", "Proceedings of the 30th AAAI Conference on Artificial Intelligence"),),
    ),
    "elasri2016": Work(
        "inproceedings",
        "Score-based Inverse Reinforcement Learning",
        ("El Asri, Layla", "Piot, Bilal", "Geist, Matthieu", "Laroche, Romain", "Pietquin, Olivier"),
        2016,
        (
            (
                "booktitle",
                "Proceedings of the 15th International Conference on Autonomous Agents and Multiagent Systems",
            ),
        ),
    ),
    "finn2016": Work(
        "inproceedings",
        "Guided Cost Learning: Deep Inverse Optimal Control via Policy Optimization",
        ("Finn, Chelsea", "Levine, Sergey", "Abbeel, Pieter"),
        2016,
        (("booktitle", "Proceedings of the 33rd International Conference on Machine Learning"), ("pages", "49--58")),
    ),
    "miller2019": Work(
        "article",
        "Robust Bayesian Inference via Coarsening",
        ("Miller, Jeffrey W.", "Dunson, David B."),
        2019,
        (
            ("journal", "Journal of the American Statistical Association"),
            ("volume", "114"),
            ("number", "527"),
            ("pages", "1113--1125"),
        ),
    ),
    "pomerleau1991": Work(
        "article",
        "Efficient Training of Artificial Neural Networks for Autonomous Navigation",
        ("Pomerleau, Dean A.",),
        1991,
        (("journal", "Neural Computation"), ("volume", "3"), ("number", "1"), ("pages", "88--97")),
    ),
    "ramachandran2007": Work(
        "inproceedings",
        "Bayesian Inverse Reinforcement Learning",
        ("Ramachandran, Deepak", "Amir, Eyal"),
        2007,
        (
            ("booktitle", "Proceedings of the 20th International Joint Conference on Artificial Intelligence"),
            ("pages", "2586--2591"),
        ),
    ),
    "shiarlis2016": Work(
        "inproceedings",
        "Inverse Reinforcement Learning from Failure",
        ("Shiarlis, Kyriacos", "Messias, Joao", "Whiteson, Shimon"),
        2016,
        (
            (
                "booktitle",
                "Proceedings of the 15th International Conference on Autonomous Agents and Multiagent Systems",
            ),
            ("pages", "1060--1068"),
        ),
    ),
    "ziebart2008": Work(
        "inproceedings",
        "Maximum Entropy Inverse Reinforcement Learning",
        ("Ziebart, Brian D.", "Maas, Andrew", "Bagnell, J. Andrew", "Dey, Anind K."),
        2008,
        (
            ("booktitle", "Proceedings of the 23rd AAAI Conference on Artificial Intelligence"),
            ("pages", "1433--1438"),
        ),
    ),
    "ziebart2010": Work(
        "phdthesis",
        "Modeling Purposeful Adaptive Behavior with the Principle of Maximum Causal Entropy",
        ("Ziebart, Brian D.",),
        2010,
        (("school", "Carnegie Mellon University"),),
    ),
}

METHODS: Mapping[str, tuple[str, ...]] = {
    "meirl": ("ziebart2008",),
    "irlr": (PAPER, "ziebart2008"),
    "irlf": ("shiarlis2016", "ziebart2008"),
    "irlfr": (PAPER, "shiarlis2016", "ziebart2008"),
    "birlfr": (PAPER, "bradley1952", "miller2019", "ramachandran2007", "ziebart2008"),
    "model_free": (PAPER, "boularias2011", "finn2016", "shiarlis2016", "ziebart2008"),
    "trex": ("bradley1952", "brown2019"),
    "bc": ("pomerleau1991",),
    "score_irl": ("burchfiel2016", "elasri2016"),
    "random": (),
}
