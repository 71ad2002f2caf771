"""What people can do with rankings: work on an order, and confirm it. Nothing is ever overwritten."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NoReturn

from sqlalchemy.orm import Session

from app.errors import Conflict, Unprocessable
from app.kit.clock import now
from app.models import Ranking
from app.rankings import queries, replay
from app.rankings.content import PLURAL, Outcome, as_order, flat
from app.rankings.events import AnyEvent, as_sent
from app.rankings.log import Log, start_order
from app.rankings.queries import Attempt
from app.rankings.schemas import RankingIn
from app.rankings.sittings import Sittings, Whose


def log(sittings: Sittings, whose: Whose, sitting_id: str, events: Sequence[AnyEvent]) -> int:
    """Append events to a sitting, leaving out those that it has already; return how many it has then."""
    told = [as_sent(event) for event in events]
    return sittings.append(whose, sitting_id, told, lambda session, _: queries.n_events(session, sitting_id))


def confirm(sittings: Sittings, whose: Whose, outcome: Outcome, told: RankingIn) -> tuple[Ranking, bool]:
    """Store the order as the next version, once; return it and whether it counts.

    Raises Unprocessable unless it holds exactly what is kept, and is the one that its sitting led to; Conflict where
    something came in between.
    """
    if not told.confirmed:
        message = "Only an order that the person has confirmed is stored: send it again with confirmed: true."
        raise Unprocessable(message, fields={"confirmed": message})
    sitting = told.sitting
    if sitting is None:
        return sittings.database.write(lambda session: (_store(session, whose, outcome, told, None), True))

    def work(session: Session, log: Log) -> tuple[Ranking, bool]:
        known = queries.confirmed_in(session, sitting.id, outcome, log.n_events)
        if known is None:
            return _store(session, whose, outcome, told, log), True
        if known.order != told.order:
            _refuse_another_order()
        return known, known is _newest(session, whose, outcome)

    return sittings.append(whose, sitting.id, [as_sent(event) for event in sitting.events], work)


def _newest(session: Session, whose: Whose, outcome: Outcome) -> Ranking | None:
    return queries.newest(session, whose.visitor_id, whose.world_id).get(outcome)


def _store(session: Session, whose: Whose, outcome: Outcome, told: RankingIn, log: Log | None) -> Ranking:
    newest = _newest(session, whose, outcome)
    _check(told, queries.attempts(session, whose.visitor_id, whose.world_id), outcome, newest, log)
    ids = [member for group in told.order for member in group]
    ranking = Ranking(
        world_id=whose.world_id,
        visitor_id=whose.visitor_id,
        outcome=outcome,
        version=newest.version + 1 if newest else 1,
        order=told.order,
        start_order=start_order(str(whose.visitor_id), whose.world_id, outcome, ids),
        created_at=now(),
        sitting_id=told.sitting.id if told.sitting else None,
        **(_origin(log, outcome) if log else {}),
    )
    session.add(ranking)
    session.flush()
    return ranking


def _origin(log: Log, outcome: Outcome) -> dict[str, Any]:
    return {
        "way": log.state.way,
        "given": replay.given(log.state, outcome),
        "n_events": log.n_events,
        "untouched": not log.state.touched[outcome],
    }


def _check(
    told: RankingIn, attempts: Mapping[str, Attempt], outcome: Outcome, newest: Ranking | None, log: Log | None
) -> None:
    """Raise what speaks against storing this as the version after the newest, if anything does."""
    if log is not None:
        check_is_confirm(log, outcome)
    check_order(told.order, attempts, outcome, log)
    if log is not None and not told.untouched:
        check_is_touched(log, outcome)
    check_is_upon(told, newest, log)
    if log is not None and log.state.orders[outcome] != as_order(told.order):
        _refuse_another_order()


def check_is_upon(told: RankingIn, newest: Ranking | None, log: Log | None) -> None:
    """Raise Conflict where an order counts that the person did not see count, unless it is from earlier in this log."""
    version = newest.version if newest else 0
    if told.based_on not in {None, version} and not _is_earlier(newest, told, log):
        message = f"Version {version} of this order counts by now. Look at both, and send the one that is to count."
        raise Conflict(message, code="stale_version", fields={"version": str(version)})


def _is_earlier(ranking: Ranking | None, told: RankingIn, log: Log | None) -> bool:
    if ranking is None or ranking.n_events is None or told.sitting is None or log is None:
        return False
    return ranking.sitting_id == told.sitting.id and ranking.n_events < log.n_events


def check_is_confirm(log: Log, outcome: Outcome) -> None:
    """Raise Unprocessable unless the log ends with the confirm of this list."""
    if (log.last["type"], log.last.get("outcome")) != ("confirm", outcome):
        message = f"The last event of a sitting that comes with an order of {PLURAL[outcome]} must be its confirm."
        raise Unprocessable(message, fields={"sitting": message})


def check_is_touched(log: Log, outcome: Outcome) -> None:
    """Raise Unprocessable where nothing was moved in a list that was drawn at random."""
    is_choice = len(flat(log.state.orders[outcome])) > 1
    if is_choice and log.is_drawn(outcome) and not log.state.touched[outcome]:
        message = (
            f"Nothing was moved among these {PLURAL[outcome]}, and their order was drawn at random."
            " If it is your order as it stands, send it with untouched: true."
        )
        raise Unprocessable(message, code="untouched", fields={"untouched": message})


def check_order(
    order: Sequence[Sequence[str]], attempts: Mapping[str, Attempt], outcome: Outcome, log: Log | None = None
) -> None:
    """Raise Unprocessable with every reason why the order is not one of exactly what is kept of these attempts.

    Where all that is wrong is that attempts came which the log does not know, raise Conflict with their ids.
    """
    told = Counter(member for group in order for member in group)
    kept = {one.id for one in attempts.values() if one.outcome == outcome and one.is_kept}
    if not kept:
        message = f"You have no {PLURAL[outcome]} in this world yet, so there is nothing to order."
        raise Unprocessable(message, fields={"order": message})
    missing = kept - told.keys()
    new = missing - set(flat(log.state.orders[outcome])) if log else set()
    reasons = list(_reasons(told, attempts, set() if new else missing, outcome))
    if reasons:
        message = f"This is not an order of your {PLURAL[outcome]} in this world: {'; '.join(reasons)}."
        raise Unprocessable(message, fields={"order": message})
    if new:
        message = f"Of your {PLURAL[outcome]} in this world {len(new)} came meanwhile. Put them in order, too."
        raise Conflict(message, code="new_attempts", fields={"missing": ", ".join(sorted(new))})


def _reasons(told: Counter[str], attempts: Mapping[str, Attempt], missing: set[str], outcome: Outcome) -> Iterable[str]:
    discarded = {one.id for one in attempts.values() if one.outcome == outcome and not one.is_kept}
    other_outcome = {one.id for one in attempts.values() if one.outcome != outcome}
    yield from _reason("in it twice", [one for one, n in told.items() if n > 1])
    yield from _reason("missing", missing)
    yield from _reason("discarded (restore it first)", told.keys() & discarded)
    yield from _reason(f"not among your {PLURAL[outcome]} but of the other outcome", told.keys() & other_outcome)
    yield from _reason("not yours, or of another world", told.keys() - attempts.keys())


def _reason(what: str, ids: Iterable[str], *, most_named: int = 5) -> Iterable[str]:
    named = sorted(ids)
    if named:
        more = f" and {len(named) - most_named} more" if len(named) > most_named else ""
        yield f"{what}: {', '.join(named[:most_named])}{more}"


def _refuse_another_order() -> NoReturn:
    message = "The events of this sitting lead to another order than the one sent with them. Nothing was stored."
    raise Unprocessable(message, code="log_differs", fields={"order": message})
