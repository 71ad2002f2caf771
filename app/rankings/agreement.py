"""How well a confirmed order agrees with the true totals, where the study lets people know."""

from sqlalchemy.orm import Session

from app.demonstrations.queries import all_in_world
from app.errors import NotFound, NotShown
from app.models import Ranking
from app.rankings import queries
from app.rankings.content import PLURAL, Outcome
from app.rankings.schemas import AgreementOut
from irl_core import agreement_of


def of_the_newest(
    session: Session, visitor_id: str | None, world_id: str, outcome: Outcome, *, is_shown: bool
) -> AgreementOut:
    """Compare the newest version; raises NotShown where the study keeps it back, NotFound where there is no version."""
    if not is_shown:
        message = "How well an order agrees with the totals is not shown here."
        raise NotShown(message)
    ranking = queries.newest(session, visitor_id, world_id).get(outcome)
    if ranking is None:
        message = f"You have not confirmed an order of your {PLURAL[outcome]} in this world yet."
        raise NotFound(message)
    totals = {row.id: row.total for row in all_in_world(session, visitor_id, world_id)}
    return _agreement_out(ranking, totals)


def _agreement_out(ranking: Ranking, totals: dict[str, float]) -> AgreementOut:
    """Successes stand best first, failures worst first."""
    found = agreement_of(ranking.order, totals, lowest_first=ranking.outcome == "failure")
    return AgreementOut(
        version=ranking.version,
        tau_b=found.tau_b,
        n_pairs=found.n_pairs,
        n_agreeing=found.n_agreeing,
        n_swapped=found.n_swapped,
        n_tied=found.n_tied,
        swapped=list(found.swapped),
    )
