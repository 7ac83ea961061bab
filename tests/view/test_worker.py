"""The worker does the newest of each kind, one at a time, and survives what fails."""

import threading

from assur.view.worker import Worker


def _gate(worker):
    """Keep the worker busy until the event is set."""
    begun, gate = threading.Event(), threading.Event()
    worker.ask("gate", lambda: (begun.set(), gate.wait(10)))
    assert begun.wait(10)
    return gate


def test_only_the_newest_of_a_kind_is_done():
    done = []
    worker = Worker(lambda: False, done.append)
    worker.start()
    gate = _gate(worker)
    for number in range(5):
        worker.ask("drag", lambda number=number: done.append(number))
    worker.ask("other", lambda: done.append("other"))
    assert worker.busy
    assert [worker.waits(kind) for kind in ("drag", "other", "gate")] == [True, True, False]
    gate.set()
    worker.stop()
    assert done == [4, "other"]
    assert not worker.waits("drag")


def test_idle_work_is_done_until_there_is_no_more_and_again_after_a_wish():
    seen, twice = [], threading.Semaphore(0)

    def idle():
        seen.append(len(seen))
        twice.release()
        return len(seen) % 2 == 1

    worker = Worker(idle, seen.append, pause=0.01)
    worker.start()
    for _ in range(2):
        assert twice.acquire(timeout=10)
    worker.ask("wish", lambda: None)
    for _ in range(2):
        assert twice.acquire(timeout=10)
    worker.stop()
    assert seen == [0, 1, 2, 3]


def test_what_fails_is_told_and_the_next_wish_is_done():
    told, done = [], threading.Event()
    worker = Worker(lambda: False, told.append)
    worker.start()
    worker.ask("bad", lambda: 1 / 0)
    worker.ask("good", done.set)
    assert done.wait(10)
    worker.stop()
    assert not worker.busy
    assert [type(error) for error in told] == [ZeroDivisionError]


def test_idle_work_goes_on_after_a_wish_that_failed():
    calls = threading.Semaphore(0)
    worker = Worker(lambda: bool(calls.release()), [].append, pause=0.01)
    worker.start()
    assert calls.acquire(timeout=10)
    worker.ask("bad", lambda: 1 / 0)
    assert calls.acquire(timeout=10)
    worker.stop()
