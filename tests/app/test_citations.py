"""What to cite: the paper, the software, and the methods of exactly the learners that took part."""

import re
from collections import Counter

from app.comparisons.citations import METHODS, PAPER, SOFTWARE, WORKS, citations_of
from irl_core import LEARNERS


def keys(*learners: str, **settings: object) -> list[str]:
    return [one["key"] for one in citations_of(learners, settings)]


def test_every_learner_says_what_it_stands_on():
    assert set(METHODS) == set(LEARNERS)
    assert {key for works in METHODS.values() for key in works} <= set(WORKS)


def test_a_run_cites_its_own_learners_and_no_others():
    assert keys("meirl") == [PAPER, SOFTWARE, "ziebart2008"]
    assert keys("bc", "trex") == [PAPER, SOFTWARE, "bradley1952", "brown2019", "pomerleau1991"]
    assert keys("random") == [PAPER, SOFTWARE]
    assert "ziebart2010" in keys("irlf", inference="causal")
    assert "ziebart2010" not in keys("birlfr", inference="causal")


def test_each_work_names_the_learners_that_stand_on_it():
    used = {one["key"]: one["learners"] for one in citations_of(["meirl", "irlf"], {})}
    assert used["ziebart2008"] == ["meirl", "irlf"]
    assert used["shiarlis2016"] == ["irlf"]


def test_a_reference_reads_as_in_a_list_and_as_in_a_caption():
    (ziebart,) = [one for one in citations_of(["meirl"], {}) if one["key"] == "ziebart2008"]
    assert ziebart["short"] == "Ziebart et al. 2008"
    assert ziebart["text"] == (
        "Ziebart, B. D., Maas, A., Bagnell, J. A. and Dey, A. K. (2008). Maximum Entropy Inverse Reinforcement "
        "Learning. Proceedings of the 23rd AAAI Conference on Artificial Intelligence, 1433–1438."
    )
    (software,) = [one for one in citations_of([], {}, versions={"irlfr": "1.2.3"}) if one["key"] == SOFTWARE]
    assert software["text"] == "The IRLFR authors. IRLFR, version 1.2.3. Computer program, MIT licence."


def test_bibtex_is_whole():
    entries = [one["bibtex"] for one in citations_of(list(LEARNERS), {"inference": "causal"})]
    assert len(entries) == len(WORKS) + 1
    for entry in entries:
        assert Counter(entry)["{"] == Counter(entry)["}"]
        assert re.fullmatch(r"@\w+\{[\w-]+,\n(  \w+ = \{.+\},\n)+\}", entry), entry


def test_nothing_is_said_of_who_wrote_the_paper():
    """Its text, as it came to us, does not say; a guess would be copied into other people's papers."""
    assert (WORKS[PAPER].authors, WORKS[PAPER].year) == ((), None)
