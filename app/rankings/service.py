"""What people can do with rankings: confirm an order. Nothing is ever overwritten."""

from collections import Counter
from collections.abc import Iterable, Sequence
from hashlib import sha256

from sqlalchemy.orm import Session

from app.db import Database
from app.demonstrations.queries import all_in_world
from app.errors import Unprocessable
from app.kit.clock import now
from app.models import Demonstration, Ranking
from app.rankings import queries
from app.rankings.schemas import Outcome, RankingIn

PLURAL = {"success": "successes", "failure": "failures"}


def confirm(database: Database, visitor_id: str | None, world_id: str, outcome: Outcome, told: RankingIn) -> Ranking:
    """Store the order as the next version; raises Unprocessable unless it holds exactly what is kept."""
    if not told.confirmed:
        message = "Only an order that the person has confirmed is stored: send it again with confirmed: true."
        raise Unprocessable(message, fields={"confirmed": message})

    def store(session: Session) -> Ranking:
        theirs = all_in_world(session, visitor_id, world_id)
        check_order(told.order, theirs, outcome)
        known = queries.newest(session, visitor_id, world_id).get(outcome)
        ids = [member for group in told.order for member in group]
        ranking = Ranking(
            world_id=world_id,
            visitor_id=visitor_id,
            outcome=outcome,
            version=known.version + 1 if known else 1,
            order=told.order,
            start_order=start_order(str(visitor_id), world_id, outcome, ids),
            created_at=now(),
        )
        session.add(ranking)
        session.flush()
        return ranking

    return database.write(store)


def start_order(visitor_id: str, world_id: str, outcome: str, ids: Iterable[str]) -> list[str]:
    """Shuffle for the first showing: at random, yet the same at every reload, and a new attempt disturbs no other."""
    return sorted(ids, key=lambda one: sha256(f"{visitor_id}/{world_id}/{outcome}/{one}".encode()).digest())


def check_order(order: Sequence[Sequence[str]], theirs: Iterable[Demonstration], outcome: Outcome) -> None:
    """Raise Unprocessable with every reason why the order is not one of exactly these demonstrations."""
    told = Counter(member for group in order for member in group)
    known = {row.id: row for row in theirs}
    kept = {row.id for row in known.values() if row.outcome == outcome and row.discarded_at is None}
    if not kept:
        message = f"You have no {PLURAL[outcome]} in this world yet, so there is nothing to order."
        raise Unprocessable(message, fields={"order": message})
    reasons = list(_reasons(told, known, kept, outcome))
    if reasons:
        message = f"This is not an order of your {PLURAL[outcome]} in this world: {'; '.join(reasons)}."
        raise Unprocessable(message, fields={"order": message})


def _reasons(told: Counter[str], known: dict[str, Demonstration], kept: set[str], outcome: Outcome) -> Iterable[str]:
    discarded = {one for one, row in known.items() if row.outcome == outcome and row.discarded_at is not None}
    other_outcome = {one for one, row in known.items() if row.outcome != outcome}
    yield from _reason("in it twice", [one for one, n in told.items() if n > 1])
    yield from _reason("missing", kept - told.keys())
    yield from _reason("discarded (restore it first)", told.keys() & discarded)
    yield from _reason(f"not among your {PLURAL[outcome]} but of the other outcome", told.keys() & other_outcome)
    yield from _reason("not yours, or of another world", told.keys() - known.keys())


def _reason(what: str, ids: Iterable[str], *, most_named: int = 5) -> Iterable[str]:
    named = sorted(ids)
    if named:
        more = f" and {len(named) - most_named} more" if len(named) > most_named else ""
        yield f"{what}: {', '.join(named[:most_named])}{more}"
