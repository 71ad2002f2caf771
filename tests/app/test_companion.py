"""The process beside the server: it answers in turns, survives what it is asked, and outlives nobody.

Calls are functions of the standard library: the companion finds them by their names.
"""

import contextlib
import operator
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

from app.kit.companion import Companion, Failed, Superseded
from app.kit.companion_process import Died, Overdue
from tests.awaited import awaited

OUTLIVED = """
import os, sys
from app.kit.companion import Companion
from tests.awaited import awaited
from tests.awaited import awaited
companion = Companion(warm_up=os.getpid, expected=(), environment={})
print(companion.submit(companion.line("a", "pid"), os.getpid, ()).result(), flush=True)
sys.stdin.read()
"""


@pytest.fixture
def make_companion():
    with contextlib.ExitStack() as closing:

        def make(*, warm_up=os.getpid, expected=(), environment=None, **limits):
            made = Companion(warm_up=warm_up, expected=expected, environment=environment or {}, **limits)
            closing.callback(made.close)
            return made

        yield make


@pytest.fixture
def companion(make_companion):
    return make_companion()


def submit(companion, function, *arguments, who="a", kind="k"):
    return companion.submit(companion.line(who, kind), function, arguments)


def ask(companion, function, *arguments):
    return submit(companion, function, *arguments).result()


def test_it_answers_from_one_other_process_whatever_that_prints(companion):
    pid = ask(companion, os.getpid)
    assert pid != os.getpid()
    assert ask(companion, print, "this is no answer") is None
    assert ask(companion, os.getpid) == pid


def test_its_environment_is_what_the_app_says(make_companion):
    assert ask(make_companion(environment={"OMP_NUM_THREADS": "1"}), os.getenv, "OMP_NUM_THREADS") == "1"


def test_waking_starts_it_before_anybody_asks(companion):
    companion.wake()
    while companion._process is None:
        time.sleep(0.001)
    assert ask(companion, os.getpid) == companion._process._running.pid


def test_an_expected_error_comes_back_and_another_only_by_its_name(make_companion):
    knowing = make_companion(expected=(ZeroDivisionError,))
    with pytest.raises(ZeroDivisionError, match="division"):
        ask(knowing, operator.floordiv, 1, 0)
    with pytest.raises(Failed, match="TypeError"):
        ask(knowing, operator.floordiv, "1", 0)
    with pytest.raises(Failed):  # an answer that cannot be sent
        ask(knowing, eval, "lambda: 0")
    assert ask(knowing, operator.add, 1, 2) == 3


def test_its_death_is_told_once_and_the_next_call_has_a_new_one(companion):
    pid = ask(companion, os.getpid)
    with pytest.raises(Died):
        ask(companion, os._exit, 7)
    assert ask(companion, os.getpid) != pid


def test_one_that_died_while_nobody_asked_is_replaced_before_anybody_notices(companion):
    pid = ask(companion, os.getpid)
    companion._process.kill()
    companion._process._running.wait()
    assert ask(companion, os.getpid) != pid


def test_a_call_that_hangs_is_ended_and_the_next_one_answered(make_companion):
    hasty = make_companion(hangs_after_s=0.2)
    with pytest.raises(Overdue):
        ask(hasty, time.sleep, 600)
    assert ask(hasty, operator.add, 1, 2) == 3


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="without it the clock alone ends a call")
def test_a_call_that_computes_too_long_is_ended_but_not_one_that_has_to_wait(make_companion):
    hasty = make_companion(limit_s=0.2)
    with pytest.raises(Overdue):
        ask(hasty, pow, 3, 10**9)  # within one call of C, where no look at the clock reaches
    assert ask(hasty, time.sleep, 0.4) is None, "time in which others compute does not count"


def test_one_that_cannot_start_tells_everybody_who_waits_and_is_tried_again_when_next_asked(make_companion, tmp_path):
    broken = make_companion(warm_up=os.abort)
    with broken._changed:
        waiting = [submit(broken, os.getpid, who=who) for who in "ab"]
    for answer in waiting:
        with pytest.raises(Died):
            answer.result()
    broken._warm_up = os.getpid
    assert ask(broken, operator.add, 1, 2) == 3


def test_who_asks_take_turns_and_a_newer_question_takes_the_place_of_an_older(companion):
    done = []
    asked = [("a", "x", 1), ("a", "y", 2), ("a", "z", 3), ("b", "x", 4), ("a", "x", 5), ("c", "x", 6)]
    with companion._changed:  # nothing begins before all of them wait
        for who, kind, number in asked:
            answer = submit(companion, operator.pos, number, who=who, kind=kind)
            answer.add_done_callback(lambda answer: done.append(answer.exception() or answer.result()))
    ask(companion, os.getpid)
    while len(done) < 6:
        time.sleep(0.001)
    assert isinstance(done[0], Superseded)
    assert done[1:] == [2, 4, 6, 3, 5]


def test_a_question_of_several_calls_ends_when_a_newer_one_begins(companion):
    async def converse():
        old = companion.line("a", "x")
        assert await old.ask(operator.add, 1, 2) == 3
        new = companion.line("a", "x")
        other = companion.line("a", "y")
        with pytest.raises(Superseded):
            await old.ask(operator.add, 3, 4)
        assert await other.ask(operator.add, 5, 6) == 11
        return await new.ask(operator.add, 7, 8)

    assert awaited(converse()) == 15


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="a call that waits for as long as the test likes needs a FIFO")
def test_closing_ends_a_call_at_once_and_tells_who_waits(companion, tmp_path):
    os.mkfifo(tmp_path / "never")
    asked = submit(companion, pathlib.Path.read_text, tmp_path / "never")
    while not asked.running():
        time.sleep(0.001)
    waiting = submit(companion, os.getpid, who="b")
    companion.close()
    for answer in (asked, waiting, submit(companion, os.getpid)):
        with pytest.raises(Died):
            answer.result()
    assert not companion._keeper.is_alive()


def test_it_dies_with_the_one_that_started_it():
    command = [sys.executable, "-c", OUTLIVED]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as parent:
        assert parent.stdout is not None
        assert parent.stderr is not None
        parent.stdout.readline()
        parent.kill()
        assert parent.stderr.read() == b""  # it ends only when the companion, which writes there too, has ended
