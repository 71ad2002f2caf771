"""Which of two: the order that answers about pairs come to.

Of each pair asked about, one is said to belong above the other, or both to be alike. Let W_ij count how often i was put
above j, and E_ij = E_ji how often they were called alike. The answers state a relation, "above or beside": i → j where
W_ij + E_ij > 0, and whatever follows along chains of it.

1. *What does not contradict itself stays as it was said.* The strongly connected components of the relation are ordered
   by it. One that no "above" was said within is a tie; one with an "above" within contradicts itself. Where nothing
   says which of two components comes first, the stronger does (and of equals, the one given first).
2. *Strength* is Bradley and Terry's: P(i above j) = 1 / (1 + exp(x_j − x_i)), an "alike" half an answer each way, and
   before any answer x ~ N(0, 2²) independently, so that the posterior

       Σ_ij (W_ij + E_ij / 2) log P(i above j) − Σ_i x_i² / 8

   is strictly concave; its one mode is found by Newton's method.
3. *A component that contradicts itself* is a tie if all in it are equally strong: that a beats b, b beats c and c beats
   a says nothing but that they are alike. Else it is ordered by strength; then one after another is put where it
   contradicts the fewest answers, until no single move helps (a local optimum of Kemeny's criterion: the answers put
   the wrong way round). Neighbours tie where they were called alike as often as apart, or are equally strong and as
   often above as below.

So answers without a contradiction give exactly the order that was meant. The browser's twin,
`static/js/rankings/comparison-order.js`, also chooses the pairs to ask about.

Sources: R. A. Bradley and M. E. Terry, "Rank analysis of incomplete block designs" (Biometrika 39, 1952), the model of
two in R. D. Luce's and R. L. Plackett's of many; J. G. Kemeny, "Mathematics without numbers" (Daedalus 88, 1959).
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypedDict

import numpy as np

from irl_core.arrays import Matrix, Vector
from irl_core.checks import shown
from irl_core.errors import InvalidRanking
from irl_core.types import check_groups
from irl_core.world_checks import is_list

PRIOR_SD = 2.0
RESOLUTION = 1e-6
"""Strengths nearer than this are the same."""
MOST_ROUNDS = 50
LONGEST_STEP = 3.0


class Answer(TypedDict):
    """What was said of two; "a": `a` belongs above `b`. As rankings in demonstration files write it."""

    a: str
    b: str
    said: Literal["a", "b", "alike"]


@dataclass(frozen=True, slots=True)
class _Evidence:
    wins: Matrix
    alike: Matrix
    above: Matrix
    """1 where i stands above j or beside it, by some chain of answers."""


def order_from_comparisons(ids: Iterable[str], answers: Iterable[Answer]) -> tuple[tuple[str, ...], ...]:
    """Groups in display order of all `ids`, each of which stands alone in the order given where nothing was said.

    Answers of ids that are not among them are left aside. Raises InvalidRanking (doubled ids, an answer that is none).
    """
    names = [group[0] for group in check_groups([[id_] for id_ in ids])]
    evidence = _evidence_of(names, _checked(answers))
    strength = [math.floor(x / RESOLUTION + 0.5) for x in _strengths(evidence)]
    groups: list[list[int]] = []
    for component in _components(evidence, strength):
        is_at_odds = evidence.wins[np.ix_(component, component)].any()
        if not is_at_odds or len({strength[i] for i in component}) == 1:
            groups.append(component)
        else:
            line = _least_contradicted(evidence.wins, _by_strength(component, strength))
            groups += _tied(evidence, strength, line)
    return tuple(tuple(names[i] for i in group) for group in groups)


def _checked(answers: Iterable[Answer]) -> list[Answer]:
    if not is_list(answers):
        raise InvalidRanking("Answers are a list of {a, b, said}.", field="answers")
    return [_checked_answer(answer) for answer in answers]


def _checked_answer(answer: object) -> Answer:
    if not isinstance(answer, Mapping) or answer.get("said") not in ("a", "b", "alike"):
        raise InvalidRanking('An answer is {a, b, said}, and said is "a", "b" or "alike".', field="answers")
    a, b = answer.get("a"), answer.get("b")
    if not isinstance(a, str) or not isinstance(b, str) or a == b:
        raise InvalidRanking(f"An answer is about two ids, not {shown(a)} and {shown(b)}.", field="answers")
    return {"a": a, "b": b, "said": answer["said"]}


def _evidence_of(names: Sequence[str], answers: Iterable[Answer]) -> _Evidence:
    number = {name: i for i, name in enumerate(names)}
    wins: Matrix = np.zeros((len(names), len(names)))
    alike: Matrix = np.zeros_like(wins)
    for answer in answers:
        i, j = number.get(answer["a"]), number.get(answer["b"])
        if i is None or j is None:
            continue
        if answer["said"] == "alike":
            alike[i, j] += 1
            alike[j, i] += 1
        else:
            wins[(i, j) if answer["said"] == "a" else (j, i)] += 1
    return _Evidence(wins, alike, _closure(wins + alike > 0))


def _closure(relation: np.ndarray[tuple[int, int], np.dtype[np.bool_]]) -> Matrix:
    """Whatever follows along chains (Warshall)."""
    closed = relation.copy()
    for k in range(len(closed)):
        closed |= np.outer(closed[:, k], closed[k])
    return closed.astype(np.float64)


def _strengths(evidence: _Evidence) -> Vector:
    """The mode of the posterior, shape (n,)."""
    wins = evidence.wins + evidence.alike / 2
    count = wins + wins.T
    x: Vector = np.zeros(len(wins))
    for _ in range(MOST_ROUNDS):
        chance = 1 / (1 + np.exp(x[None, :] - x[:, None]))
        slope = (wins - count * chance).sum(axis=1) - x / PRIOR_SD**2
        weight = count * chance * (1 - chance)
        curvature = np.diag(weight.sum(axis=1) + 1 / PRIOR_SD**2) - weight
        step = np.linalg.solve(curvature, slope)
        largest = float(np.abs(step).max(initial=0.0))
        if largest < 1e-9:
            break
        x = x + step * min(1.0, LONGEST_STEP / largest)
    return x


def _components(evidence: _Evidence, strength: Sequence[int]) -> list[list[int]]:
    """Numbers that stand above each other, together; each component below what stands above it."""
    above = evidence.above
    left = _by_strength(range(len(strength)), strength)
    components = []
    while left:
        first = next(i for i in left if all(not above[j, i] or above[i, j] for j in left))
        component = sorted(j for j in left if j == first or (above[first, j] and above[j, first]))
        components.append(component)
        left = [j for j in left if j not in component]
    return components


def _by_strength(numbers: Iterable[int], strength: Sequence[int]) -> list[int]:
    return sorted(numbers, key=lambda i: (-strength[i], i))


def _least_contradicted(wins: Matrix, order: Sequence[int]) -> list[int]:
    line, has_moved = list(order), True
    while has_moved:
        has_moved = False
        for place in range(len(line)):
            to = _best_place(wins, line, place)
            if to != place:
                line.insert(to, line.pop(place))
                has_moved = True
    return line


def _best_place(wins: Matrix, line: Sequence[int], place: int) -> int:
    """Where the most contradictions end, the nearest such place; where it stands if none do."""
    one, best, fewest = line[place], place, 0.0
    for step, end in ((-1, -1), (1, len(line))):
        more = 0.0
        for to in range(place + step, end, step):
            more -= step * (wins[line[to], one] - wins[one, line[to]])
            if more < fewest:
                best, fewest = to, more
    return best


def _tied(evidence: _Evidence, strength: Sequence[int], line: Sequence[int]) -> list[list[int]]:
    groups: list[list[int]] = []
    for i in line:
        if groups and _is_tie(evidence, strength, groups[-1][-1], i):
            groups[-1].append(i)
        else:
            groups.append([i])
    return [sorted(group) for group in groups]


def _is_tie(evidence: _Evidence, strength: Sequence[int], i: int, j: int) -> bool:
    alike, above, below = evidence.alike[i, j], evidence.wins[i, j], evidence.wins[j, i]
    is_open = strength[i] == strength[j] and above == below
    return bool(is_open or (alike > 0 and alike >= above + below))
