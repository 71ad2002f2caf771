"""Any discrete model: transitions row by row, as a compressed sparse row (CSR) matrix.

States 0 … S − 1, actions 0 … A − 1, all actions in every state. Row s·A + a is T(· | s, a): its entries are
`indices[indptr[row] : indptr[row + 1]]`, the states it may lead to, and `probabilities` beside them, which sum to 1.
A terminal state ends the episode: its rows are empty. A model without any has episodes of N steps, all of them; then
only `causal` inference applies, the path distributions being over paths that arrive.

`pays` is what the model itself pays, and nothing that a learner sees: one number for each state and action, shape
(S, A), or one for each entry, as `indices`. `start` is a state, or S probabilities. `horizon` is N, the longest path in
steps; unless given it is min(2·S, 200), never less than twice the shortest way to a terminal state.

Refused, beside numbers that make no distribution: a terminal state that no start reaches, a horizon shorter than the
shortest way, and a trap: states that can be reached and never left, from which no path arrives.
"""

from collections.abc import Iterable
from dataclasses import KW_ONLY, dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from irl_core.array_checks import MAX_HORIZON, float_array
from irl_core.arrays import BoolVector, IntVector, Matrix, Vector, read_only
from irl_core.checks import Refused, is_integer, shown
from irl_core.errors import InvalidModel
from irl_core.mdp.grid import start_distribution

if TYPE_CHECKING:
    from scipy.sparse import csr_array

_SUM_TOLERANCE: Final = 1e-9
_USUAL_HORIZON: Final = 200


@dataclass(frozen=True, eq=False)
class SparseMdp:
    """A discrete Markov decision process in CSR; see the module. Raises InvalidModel.

    After construction `pays` is what each state and action pays on average, (S, A), `entry_pays` what each entry does.
    """

    indptr: IntVector
    indices: IntVector
    probabilities: Vector
    n_states: int
    n_actions: int
    pays: Matrix
    terminal: BoolVector
    start: int | Vector
    _: KW_ONLY
    horizon: int = 0
    entry_pays: Vector = field(init=False)

    def __post_init__(self) -> None:
        for name in ("n_states", "n_actions"):
            given = getattr(self, name)
            if not is_integer(given) or int(given) < 1:
                raise InvalidModel(f"{name} must be a whole number of at least 1, not {shown(given)}.", field=name)
            self._set(name, int(given))
        self._set("terminal", _terminal(self.terminal, n_states=self.n_states))
        self._set("indptr", _whole_numbers("indptr", self.indptr))
        self._set("indices", _whole_numbers("indices", self.indices))
        self._set("probabilities", _numbers("probabilities", self.probabilities))
        self._check_entries()
        self._check_sums()
        self._settle_pays()
        for array in (self.indptr, self.indices, self.probabilities, self.terminal, self.pays, self.entry_pays):
            read_only(array)
        self._settle_horizon()

    @cached_property
    def starts(self) -> Vector:
        """Where an episode starts, a distribution of shape (S,)."""
        return start_distribution(self.start, n_states=self.n_states, not_at=np.flatnonzero(self.terminal).tolist())

    @property
    def start_states(self) -> IntVector:
        """Where an episode can start, ascending."""
        return np.flatnonzero(self.starts)

    @cached_property
    def rows(self) -> IntVector:
        """The row s·A + a that each entry stands in, shape of `indices`."""
        return np.repeat(np.arange(self.n_states * self.n_actions), np.diff(self.indptr))

    @cached_property
    def transitions(self) -> "csr_array[Any, tuple[int, int]]":
        """T as a SciPy matrix, shape (S·A, S)."""
        from scipy.sparse import csr_array  # noqa: PLC0415 - importing irl_core must not import scipy

        shape = (self.n_states * self.n_actions, self.n_states)
        return csr_array((self.probabilities, self.indices, self.indptr), shape=shape)

    @cached_property
    def flow(self) -> "csr_array[Any, tuple[int, int]]":
        """W(s, s′) = Σ_a T(s′ | s, a) as a SciPy matrix, shape (S, S), entries in order, none twice, none 0."""
        from scipy.sparse import csr_array  # noqa: PLC0415 - as above

        ends = self.indptr[:: self.n_actions].copy()
        summed = csr_array((self.probabilities.copy(), self.indices.copy(), ends), shape=(self.n_states, self.n_states))
        summed.sum_duplicates()
        summed.eliminate_zeros()
        return summed

    def followed(self, policy: Matrix) -> "csr_array[Any, tuple[int, int]]":
        """How states follow each other under a policy of shape (S, A): Σ_a π(a | s) T(s′ | s, a), shape (S, S)."""
        from scipy.sparse import csr_array  # noqa: PLC0415 - as above

        chances = self.probabilities * policy.reshape(-1)[self.rows]
        return csr_array((chances, self.indices, self.indptr[:: self.n_actions]), shape=(self.n_states, self.n_states))

    @cached_property
    def steps_from_start(self) -> IntVector:
        """Fewest steps from the nearest start to each state, −1 where there is no way, shape (S,)."""
        return self.steps_from(self.start_states)

    @property
    def reachable(self) -> BoolVector:
        """Where an episode can come, the starts included, shape (S,)."""
        return self.steps_from_start >= 0

    @cached_property
    def steps_to_end(self) -> IntVector:
        """Fewest steps to the nearest terminal state, −1 where there is no way, shape (S,)."""
        return self._distances(np.flatnonzero(self.terminal), self.flow.transpose().tocsr())

    def steps_from(self, origins: IntVector) -> IntVector:
        """Fewest steps from the nearest of these states to each state, −1 where there is no way, shape (S,)."""
        return self._distances(origins, self.flow)

    def _distances(self, origins: IntVector, links: "csr_array[Any, tuple[int, int]]") -> IntVector:
        steps = np.full(self.n_states, -1, dtype=np.int64)
        steps[origins] = 0
        frontier, n_steps = origins, 0
        while len(frontier):
            n_steps += 1
            ahead = np.unique(links[frontier].indices).astype(np.int64)
            frontier = ahead[steps[ahead] < 0]
            steps[frontier] = n_steps
        return steps

    def _check_entries(self) -> None:
        n_rows, n_entries = self.n_states * self.n_actions, len(self.indices)
        if len(self.indptr) != n_rows + 1 or self.indptr[0] != 0 or self.indptr[-1] != n_entries:
            raise InvalidModel(
                f"indptr must be {n_rows + 1} numbers from 0 to {n_entries}, one more than states × actions; they are"
                f" {len(self.indptr)}, from {self.indptr[:1].sum()} to {self.indptr[-1:].sum()}.",
                field="indptr",
            )
        if (np.diff(self.indptr) < 0).any():
            raise InvalidModel("indptr must never fall: each row begins where the one before ends.", field="indptr")
        if len(self.probabilities) != n_entries:
            raise InvalidModel(
                f"probabilities must be {n_entries} numbers, one for each index, not {len(self.probabilities)}.",
                field="probabilities",
            )
        wrong = np.flatnonzero((self.indices < 0) | (self.indices >= self.n_states))
        if len(wrong):
            raise InvalidModel(
                f"{self._place(int(wrong[0]))} leads to state {self.indices[wrong[0]]}; states are 0 to"
                f" {self.n_states - 1}.",
                field="indices",
            )

    def _check_sums(self) -> None:
        wrong = np.flatnonzero(~(self.probabilities >= 0.0))
        if len(wrong):
            raise InvalidModel(
                f"{self._place(int(wrong[0]))} has the probability {self.probabilities[wrong[0]]:g}; none is below 0.",
                field="probabilities",
            )
        sums = np.bincount(self.rows, self.probabilities, self.n_states * self.n_actions)
        ends = np.repeat(self.terminal, self.n_actions)
        busy = np.flatnonzero(ends & (np.diff(self.indptr) > 0))
        if len(busy):
            raise InvalidModel(
                f"State {busy[0] // self.n_actions} is terminal, so its rows must be empty: nothing comes after it.",
                field="terminal",
            )
        wrong = np.flatnonzero(~ends & (np.abs(sums - 1.0) > _SUM_TOLERANCE))
        if len(wrong):
            state, action = divmod(int(wrong[0]), self.n_actions)
            raise InvalidModel(
                f"The probabilities of action {action} in state {state} must sum to 1; their sum is"
                f" {sums[wrong[0]]:g}. (Only terminal states have empty rows.)",
                field="probabilities",
            )

    def _settle_pays(self) -> None:
        given = _numbers("pays", self.pays, n_dimensions=None)
        shape = (self.n_states, self.n_actions)
        if given.shape == self.indices.shape:
            average = np.bincount(self.rows, self.probabilities * given, self.n_states * self.n_actions)
            self._set("pays", average.reshape(shape))
            self._set("entry_pays", given)
        elif given.shape == shape:
            self._set("pays", given)
            self._set("entry_pays", given.reshape(-1)[self.rows])
        else:
            raise InvalidModel(
                f"pays must be {self.n_states} × {self.n_actions} numbers, or {len(self.indices)}, one for each index;"
                f" their shape is {given.shape}.",
                field="pays",
            )

    def _settle_horizon(self) -> None:
        shortest = self._shortest_way()
        if self.horizon == 0:
            self._set("horizon", max(min(2 * self.n_states, _USUAL_HORIZON), 2 * shortest))
        if not is_integer(self.horizon) or not max(shortest, 1) <= self.horizon <= MAX_HORIZON:
            raise InvalidModel(
                f"horizon must be a whole number of at least {max(shortest, 1)} steps, the shortest way to a terminal"
                f" state, not {shown(self.horizon)}, and at most {MAX_HORIZON}.",
                field="horizon",
            )
        self._set("horizon", int(self.horizon))

    def _shortest_way(self) -> int:
        """Fewest steps from a start to a terminal state; 0 if there is none. Refuses terminals out of reach, traps."""
        if not self.terminal.any():
            return 0
        reached = self.steps_from_start
        ends = reached[self.terminal]
        if (ends < 0).all():
            raise InvalidModel("No terminal state can be reached from the start.", field="terminal")
        trapped = np.flatnonzero((reached >= 0) & (self.steps_to_end < 0))
        if len(trapped):
            alone = set(self._successors(int(trapped[0]))) == {int(trapped[0])}
            how = "leads nowhere but to itself" if alone else "leads to no terminal state, whatever is done"
            raise InvalidModel(
                f"State {trapped[0]} can be reached and {how}: mark it as terminal if the episode ends there, or give"
                " it a way out.",
                field="terminal",
            )
        return int(ends[ends >= 0].min())

    def _successors(self, state: int) -> Iterable[int]:
        first, last = self.indptr[state * self.n_actions], self.indptr[(state + 1) * self.n_actions]
        reached = self.indices[first:last]
        return [int(one) for one in reached[self.probabilities[first:last] > 0.0]]

    def _place(self, entry: int) -> str:
        """Which state and action an entry belongs to, in words."""
        state, action = divmod(int(np.searchsorted(self.indptr, entry, side="right")) - 1, self.n_actions)
        return f"Action {action} in state {state}"

    def _set(self, name: str, value: object) -> None:
        object.__setattr__(self, name, value)


def _terminal(given: object, *, n_states: int) -> BoolVector:
    marked = _listed("terminal", given)
    if marked.shape != (n_states,) or marked.dtype != np.bool_:
        raise InvalidModel(
            f"terminal must be {n_states} truth values, one a state; here are {marked.dtype} of shape {marked.shape}.",
            field="terminal",
        )
    return marked


def _whole_numbers(name: str, given: object) -> IntVector:
    values = _listed(name, given)
    if values.ndim != 1 or (len(values) and not np.issubdtype(values.dtype, np.integer)):
        raise InvalidModel(
            f"{name} must be a list of whole numbers; here are {values.dtype} of shape {values.shape}.", field=name
        )
    return values.astype(np.int64)


def _listed(name: str, given: object) -> np.ndarray[Any, np.dtype[Any]]:
    try:
        return np.array(given)
    except ValueError:
        raise InvalidModel(f"{name} must be one list, not lists of several lengths.", field=name) from None


def _numbers(name: str, given: object, *, n_dimensions: int | None = 1) -> np.ndarray[Any, np.dtype[np.float64]]:
    try:
        values = float_array(given).copy()
    except Refused as refused:
        raise InvalidModel(f"{name} must be numbers; {refused}.", field=name) from None
    if n_dimensions is not None and values.ndim != n_dimensions:
        raise InvalidModel(f"{name} must be a list of numbers; their shape is {values.shape}.", field=name)
    if not np.isfinite(values).all():
        raise InvalidModel(f"{name} must be finite numbers; {int((~np.isfinite(values)).sum())} are not.", field=name)
    return values
