"""The writer: everything acknowledged is stored, one failure harms nobody else."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
from sqlalchemy import func, insert, select, text
from sqlalchemy.exc import IntegrityError, OperationalError

from app.config import Settings
from app.db import Database, make_engine
from app.kit import clock
from app.kit.writer import TransactionLost, Writer, WriterIsBusy, _Item
from app.models import Visitor


@pytest.fixture
def database(settings: Settings):
    opened = Database(settings)
    yield opened
    opened.close()


def add(name: str):
    return lambda session: session.execute(insert(Visitor).values(id=name, created_at=clock.now())).rowcount


def count(database: Database) -> int:
    with database.read() as session:
        return session.scalar(select(func.count()).select_from(Visitor)) or 0


def test_many_threads_store_everything_once(database):
    with ThreadPoolExecutor(16) as pool:
        list(pool.map(lambda number: database.write(add(str(number))), range(400)))
    assert count(database) == 400


def test_a_failing_piece_of_work_takes_no_other_with_it(database):
    database.write(add("taken"))
    with ThreadPoolExecutor(16) as pool:
        futures = [
            pool.submit(database.write, add("taken" if number % 3 == 0 else str(number))) for number in range(90)
        ]
    failures = [future for future in futures if isinstance(future.exception(), IntegrityError)]
    assert len(failures) == 30
    assert count(database) == 1 + 60


def test_what_a_failing_piece_had_written_is_undone(database):
    def write_then_fail(session):
        add("half")(session)
        raise ValueError("on purpose")

    with pytest.raises(ValueError, match="on purpose"):
        database.write(write_then_fail)
    assert count(database) == 0


def test_acknowledged_rows_survive_opening_the_file_again(database, settings):
    database.write(add("kept"))
    again = Database(settings)
    assert count(again) == 1
    again.close()


def test_writing_connections_wait_for_the_disk(database):
    """FULL (2) is what survives a power cut; NORMAL lost acknowledged rows when it was tried."""
    assert database.write(lambda session: session.scalar(text("PRAGMA synchronous"))) == 2
    assert database.write(lambda session: session.scalar(text("PRAGMA journal_mode"))) == "wal"


def test_who_stops_waiting_does_not_stop_the_work(database):
    future = database._writer.submit(add("kept"))
    assert not future.cancel()
    assert future.result(10) == 1
    assert count(database) == 1


def test_a_writer_is_as_free_after_its_work_as_before(settings):
    """Places in the queue are given back, by work that fails too."""
    engine = make_engine(settings.database_url, "write")
    writer = Writer(engine, queue_length=1)

    def fail(_):
        raise ValueError("on purpose")

    for n in range(5):
        assert writer.run(add(str(n))) == 1
        with pytest.raises(ValueError, match="on purpose"):
            writer.run(fail)
    writer.close()
    engine.dispose()


def test_readers_cannot_write(database):
    with database.read() as session, pytest.raises(OperationalError, match="readonly"):
        add("nobody")(session)


def test_a_full_queue_says_so_at_once(settings):
    engine = make_engine(settings.database_url, "write")
    writer = Writer(engine, queue_length=2)
    release, started = threading.Event(), threading.Event()

    def hold(_):
        started.set()
        release.wait(10)

    with ThreadPoolExecutor(2) as pool:
        held = pool.submit(writer.run, hold)
        started.wait(10)
        waiting = pool.submit(writer.run, add("waits"))
        while writer._queue.empty():
            pass
        with pytest.raises(WriterIsBusy):
            writer.run(add("refused"))
        release.set()
        held.result(10)
        assert waiting.result(10) == 1
    writer.close()
    with pytest.raises(WriterIsBusy):
        writer.run(add("late"))
    engine.dispose()


def test_a_locked_file_is_an_error_for_everyone_in_the_group_and_nothing_is_stored(settings):
    database = Database(settings, patience_ms=50)
    other = make_engine(settings.database_url, "write")
    with other.begin(), pytest.raises(OperationalError, match="locked"):
        database.write(add("refused"))
    assert count(database) == 0
    assert database.write(add("later")) == 1, "it recovers by itself"
    database.close()
    other.dispose()


def test_nobody_is_told_that_it_is_stored_when_the_disk_fills_in_the_middle_of_a_group(settings):
    """SQLite then gives up the whole transaction; a commit of nothing succeeds, and what follows commits by itself."""
    database = Database(settings)
    n_pages = database.write(lambda session: session.scalar(text("PRAGMA page_count")))
    database.write(lambda session: session.execute(text(f"PRAGMA max_page_count={n_pages + 2}")))
    group = [_Item(add(name)) for name in ("before", "x" * 200_000, "after")]
    database._writer._commit(group)
    assert [type(item.future.exception(1)) for item in group] == [TransactionLost] * 3
    assert count(database) == 0
    database.write(lambda session: session.execute(text("PRAGMA max_page_count=1000000")))
    assert database.write(add("later")) == 1, "it recovers by itself"
    database.close()


def test_while_the_file_is_locked_one_tries_and_the_others_are_told_at_once(settings):
    database = Database(settings, patience_ms=400)
    other = make_engine(settings.database_url, "write")
    with other.begin(), ThreadPoolExecutor(8) as pool:
        with pytest.raises(OperationalError, match="locked"):
            database.write(add("first"))
        waves = [pool.submit(database.write, add(str(number))) for number in range(8)]
        errors = [type(one.exception()) for one in waves]
    assert sorted(error.__name__ for error in errors) == ["OperationalError"] + ["WriterIsBusy"] * 7
    assert count(database) == 0
    assert database.write(add("later")) == 1
    database.close()
    other.dispose()


def test_closing_while_many_write_answers_everyone(settings):
    database = Database(settings)
    with ThreadPoolExecutor(16) as pool:
        futures = [pool.submit(database.write, add(str(number))) for number in range(300)]
        futures[20].result(10)
        database._writer.close()
        told = [future.exception(10) for future in futures]
    assert {type(error) for error in told} <= {type(None), WriterIsBusy}
    assert count(database) == told.count(None)
    database.close()
