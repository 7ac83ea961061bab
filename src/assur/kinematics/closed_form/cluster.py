"""Stored sweeps on a Dask cluster: its workers solve blocks, this process alone writes.

A block is a pure function of its number, so that one whose worker is lost is solved again by another. A worker loads
the mechanism itself, by its name or the path of its file, and must come to the same question as this process.
"""

from __future__ import annotations

import importlib
import importlib.util
import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any

from assur.errors import UsageError
from assur.kinematics.closed_form.grid_sweep import GridSweep
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.stored import stored_sweep
from assur.kinematics.modes import Problem
from assur.model.registry import load_record
from assur.results.store.note import asked, differences
from assur.results.store.store import SolvedBlock, Store
from assur.work import Progress

ANSWERS = 30.0
"""Seconds within which a scheduler must answer, and have a worker."""
AHEAD = 2
"""Blocks that each thread of a worker has before it; more would only fill memory."""
GOES_ON = "what is done is kept; once the cluster works, the same command goes on"


@dataclass(frozen=True)
class Job:
    """All that a worker must know of a sweep; plain data.

    Attributes:
        mechanism: a name, or the path of a file that the worker sees too.
        overrides: other values for parameters.
        problem, grid, mode, keep: as of `GridSweep`.
    """

    mechanism: str
    overrides: tuple[tuple[str, float], ...]
    problem: Problem
    grid: Grid
    mode: str
    keep: tuple[str, ...]


def job_of(sweep: GridSweep, mechanism: str) -> Job:
    """The job of a sweep whose mechanism was called by a name or a path."""
    path = Path(mechanism)
    called = str(path.absolute()) if path.exists() else mechanism
    overrides = tuple(sorted(sweep.record.overrides.items()))
    return Job(called, overrides, sweep.problem, sweep.grid, sweep.mode, sweep.keep)


@lru_cache(maxsize=4)
def sweep_of(job: Job) -> GridSweep:
    """The sweep of a job, on a worker."""
    record = load_record(job.mechanism, **dict(job.overrides))
    return stored_sweep(record, job.problem, job.grid, job.mode, job.keep)


def question_of(job: Job) -> dict[str, Any]:
    """What a worker takes a job to be."""
    return asked(sweep_of(job).plan())


def solved_block(job: Job, number: int) -> tuple[int, SolvedBlock]:
    """A block by its number among those of the whole grid, on a worker."""
    sweep = sweep_of(job)
    return number, sweep.block(sweep.grid.poses(sweep.plan().part(number)))


def fill_on_cluster(
    sweep: GridSweep, mechanism: str, store: Store, address: str, *, progress: Progress | None = None
) -> None:
    """Let the workers of a cluster work out what a store lacks; this process writes it.

    Args:
        sweep: what is solved.
        mechanism: the name or the path that its mechanism was loaded by, which workers load it by too.
        store: open.
        address: of the scheduler, as tcp://localhost:8786.
        progress: called after every block.

    Errors:
        UsageError: Dask is not installed, no cluster answers, its workers take the sweep for another one (other files,
            another version), or block after block loses its worker.
    """
    job = job_of(sweep, mechanism)
    with _client(address) as client:
        kept = _answer(client, client.submit(question_of, job, pure=False))
        other = differences(json.loads(json.dumps(asked(store.plan.whole))), kept)
        if other:
            raise UsageError(
                f"{address}: its workers take this for another question; it differs in {', '.join(other)}",
                hint="they need the same version of assur, and the same file of the mechanism at the same path",
            )
        store.fill(_solved(client, job, store.missing), progress)


@contextmanager
def _client(address: str) -> Iterator[Any]:
    """A client of a scheduler that has a worker."""
    if importlib.util.find_spec("distributed") is None:
        raise UsageError("--scheduler needs Dask, which is not installed", hint="pip install '.[cluster]'")
    distributed = importlib.import_module("distributed")
    try:
        client = distributed.Client(address, timeout=ANSWERS, set_as_default=False)
    except (OSError, ValueError) as error:
        raise UsageError(
            f"--scheduler: no Dask scheduler answers at {address}", hint="`dask scheduler` prints its address"
        ) from error
    with client:
        try:
            client.wait_for_workers(1, timeout=ANSWERS)
        except OSError as error:
            raise UsageError(f"{address}: the scheduler has no worker", hint=f"dask worker {address}") from error
        yield client


def _solved(client: Any, job: Job, numbers: Sequence[int]) -> Iterator[tuple[int, SolvedBlock]]:
    """Blocks as they are ready; only a few for each worker are under way."""
    left = iter(numbers)
    many = AHEAD * max(1, sum(client.nthreads().values()))

    def sent(count: int) -> list[Any]:
        return [client.submit(solved_block, job, number, pure=False) for number in islice(left, count)]

    ready = importlib.import_module("distributed").as_completed(sent(many), loop=client.loop)
    try:
        for future in ready:
            yield _answer(client, future)
            ready.update(sent(1))
    finally:
        client.cancel(list(ready.futures))


def _answer(client: Any, future: Any) -> Any:
    """What a worker answers; its own errors are those of this process."""
    distributed = importlib.import_module("distributed")
    try:
        return future.result()
    except (distributed.KilledWorker, distributed.CancelledError) as error:
        lost = f"--scheduler: the workers of {client.scheduler_info().get('address', 'the cluster')} were lost"
        raise UsageError(f"{lost} ({type(error).__name__})", hint=GOES_ON) from error
