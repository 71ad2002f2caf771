"""What was found out is found out once, whoever asks, and whoever goes away."""

import asyncio
from typing import cast

import pytest

from app.db import Database
from app.kit.companion import Superseded
from app.retraining.answers import MOST_KEPT, Answers
from tests.awaited import awaited


class Work:
    """Somebody's way to an answer, which goes on when the test says so."""

    def __init__(self):
        self.n_begun = 0
        self.has_begun = asyncio.Event()
        self.may_end = asyncio.Event()
        self.fails_with = None

    def line(self, kind):
        return kind

    async def __call__(self, line):
        self.n_begun += 1
        self.has_begun.set()
        await self.may_end.wait()
        if self.fails_with:
            raise self.fails_with
        return {"kind": line}


def no_answers():
    return Answers(cast("Database", None))  # it only hands it on


def find(answers, work, *about):
    return asyncio.create_task(answers.find(work, "why", *about, work=work))


async def both_ask(answers, mine, yours):
    """Two ask for the same, the second while the first is being answered."""
    first = find(answers, mine, "run")
    await mine.has_begun.wait()
    second = find(answers, yours, "run")
    await asyncio.sleep(0)
    return first, second


def test_two_who_ask_for_the_same_wait_for_one_answer_which_is_kept():
    async def story():
        answers, mine, yours = no_answers(), Work(), Work()
        first, second = await both_ask(answers, mine, yours)
        mine.may_end.set()
        assert await first is await second
        assert await find(answers, yours, "run") is await first
        assert (mine.n_begun, yours.n_begun) == (1, 0)

    awaited(story())


def test_where_the_one_who_began_it_turns_to_something_newer_the_next_takes_over():
    async def story():
        answers, mine, yours = no_answers(), Work(), Work()
        first, second = await both_ask(answers, mine, yours)
        mine.fails_with = Superseded()
        mine.may_end.set()
        with pytest.raises(Superseded):
            await first
        await yours.has_begun.wait()
        yours.may_end.set()
        assert await second == {"kind": "why"}

    awaited(story())


def test_who_goes_away_takes_nobody_with_them():
    async def story():
        answers, mine, yours = no_answers(), Work(), Work()
        first, second = await both_ask(answers, mine, yours)
        first.cancel()
        mine.may_end.set()
        assert await second == {"kind": "why"}
        assert yours.n_begun == 0

    awaited(story())


def test_a_failure_is_not_kept_and_the_oldest_answers_are_forgotten():
    async def story():
        answers, work = no_answers(), Work()
        work.may_end.set()
        work.fails_with = ValueError("too bad")
        with pytest.raises(ValueError, match="too bad"):
            await find(answers, work, "run")
        work.fails_with = None
        for number in range(MOST_KEPT + 1):
            await find(answers, work, str(number))
        assert work.n_begun == MOST_KEPT + 2
        await find(answers, work, str(MOST_KEPT))
        assert work.n_begun == MOST_KEPT + 2
        await find(answers, work, "0")
        assert work.n_begun == MOST_KEPT + 3

    awaited(story())


def test_closing_ends_what_is_being_found_out():
    async def story():
        answers, work = no_answers(), Work()
        asked = find(answers, work, "run")
        await work.has_begun.wait()
        await answers.close()
        with pytest.raises(asyncio.CancelledError):
            await asked

    awaited(story())
