"""What `assur sweep` says: before it begins, where it was interrupted, and what the files hold."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rich.console import RenderableType

from assur.cli.options import Outcome, Shared
from assur.cli.output import InterruptedByUserError, Verbatim, heading, table
from assur.cli.paths import planned_folder
from assur.cli.progress import Step, progress
from assur.errors import OutputError, UsageError
from assur.kinematics.closed_form.about import described, told
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.home_sweep import HOME
from assur.kinematics.closed_form.stored import stored_sweep
from assur.kinematics.modes import Problem
from assur.mechanism import Mechanism
from assur.results.answers.sweep import SweepAnswer, SweptCoordinate, SweptCounts, SweptFile, SweptShard
from assur.results.plain_text import size_text
from assur.results.store.inspection import Fault
from assur.results.store.layout import Shard
from assur.results.store.merged import parts_in
from assur.results.store.store import ABOUT, Store

REASONS = 5
"""So many reasons are printed; the note beside the files has all."""
AGAIN = "the same command goes on from there"


@dataclass(frozen=True)
class Request:
    """How a sweep is worked out.

    Attributes:
        output: the folder.
        threads: how many work on it; as many as there are cores where 0.
        shard: which part of the grid; all of it where None.
        scheduler: address of a Dask scheduler whose workers do it; this process where None.
        repair: whether damaged blocks are computed again.
    """

    output: str
    threads: int = 0
    shard: Shard | None = None
    scheduler: str | None = None
    repair: bool = False


def outcome(
    record: Mechanism,
    name: str,
    grid: Grid,
    problem: Problem,
    mode: str | None,
    keep: Sequence[str],
    request: Request,
    shared: Shared,
) -> Outcome:
    """The sweep, run into a folder, as data and for a person; `name` is what the mechanism was called by."""
    if request.threads < 0:
        raise UsageError(f"--threads: {request.threads} is no number of threads", hint="leave it out")
    sweep = stored_sweep(record, problem, grid, mode or "", keep)
    folder = planned_folder(request.output)

    def fill(store: Store, step: Step) -> None:
        if request.scheduler is None:
            sweep.fill(store, progress=step, threads=request.threads)
        else:
            from assur.kinematics.closed_form.cluster import fill_on_cluster

            fill_on_cluster(sweep, name, store, request.scheduler, progress=step)

    how = f"by {sweep.engine}" + (f", on the cluster at {request.scheduler}" if request.scheduler else "")
    with sweep.store(folder, request.shard) as store:
        return _run(store, fill, how, request, shared)


def merged(folders: Sequence[str], request: Request, shared: Shared) -> Outcome:
    """Shards joined in a folder, as data and for a person."""
    folder = planned_folder(request.output)
    given = [Path(text) for text in folders]
    if folder.resolve() in [one.resolve() for one in given]:
        raise UsageError(f"--output: {folder} is one of the shards", hint="give the whole grid a folder of its own")
    with progress("shards", shared) as step:
        parts = parts_in(given, step)
    plan = parts[0].plan.whole

    def fill(store: Store, step: Step) -> None:
        left = set(store.missing)
        store.fill(((n, part.solved(n)) for part in parts for n in part.plan.blocks if n in left), step)

    with Store(folder, plan, told) as store:
        return _run(store, fill, f"joined from {len(parts)} shards", request, shared)


def _run(store: Store, fill: Callable[[Store, Step], None], how: str, request: Request, shared: Shared) -> Outcome:
    """Fill a store and say so."""
    with _told(store):
        with progress("check", shared) as step:
            faults = store.open(repair=request.repair, progress=step)
        if not shared.json:
            sys.stderr.write("".join(f"{line}\n" for line in (*map(_repaired, faults), beforehand(store, how))))
        with progress("sweep", shared) as step:
            fill(store, step)
        store.finish()
    known = described(store.plan, store.counts, store.places_done)
    files = {name: SweptFile(**about) for name, about in known.pop("files").items()}
    along = tuple(SweptCoordinate(**about) for about in known.pop("along"))
    counts, shard = SweptCounts(**known.pop("counts")), known.pop("shard")
    answer = SweepAnswer(
        **known,
        along=along,
        shard=shard and SweptShard(**shard),
        counts=counts,
        files=files,
        folder=str(store.folder),
        repaired=tuple(str(fault.problem) for fault in faults),
    )
    return Outcome(answer, lambda: _shown(answer))


@contextmanager
def _told(store: Store) -> Iterator[None]:
    """Where it stops, it is said what is done and how to go on."""
    try:
        yield
    except KeyboardInterrupt as error:
        done = f"stopped at {store.places_done} of {store.plan.length}"
        if not (store.folder.is_dir() and any(store.folder.iterdir())):
            raise InterruptedByUserError(f"interrupted: {done}; nothing is written in {store.folder} yet") from error
        raise InterruptedByUserError(f"interrupted: {done}, in {store.folder}", hint=AGAIN) from error
    except OSError as error:
        done = f"{store.places_done} of {store.plan.length} are done"
        at = f" ({error.filename})" if error.filename else ""
        raise OutputError(
            f"cannot write {store.folder}: {error.strerror}{at}; {done}", hint=f"{AGAIN}, once that is mended"
        ) from error


def _repaired(fault: Fault) -> str:
    return f"repaired: {fault.problem}"


def beforehand(store: Store, how: str) -> str:
    """What it will take."""
    plan, done = store.plan, store.places_done
    what = "poses" if (plan.about or {})["problem"] == "inverse" else "inputs"
    shard = f" of {plan.size}, shard {plan.shard.index} of {plan.shard.of}" if plan.shard else ""
    begun = f", of which {done} are done" if done else ""
    return f"{plan.length} {what}{shard}{begun}, {how}: {size_text(plan.bytes)} in {store.folder}"


def _mode_of(about: SweepAnswer) -> str:
    mode = about.mode
    if mode == "all":
        return f"{len(about.modes)} modes"
    kind = "assembly mode" if about.problem == "direct" else "working mode"
    if mode == HOME:
        return f"the {kind} of home"
    if about.problem == "direct":
        return f"{kind} {mode}"
    return f"working mode {mode}" if mode else "its only working mode"


def _shown(data: SweepAnswer) -> Iterable[RenderableType]:
    inverse, folder = data.problem == "inverse", Path(data.folder)
    yield heading(f"{data.mechanism}, {data.problem} problem, {_mode_of(data)}: {data.problems} problems")
    yield f"how: {data.how}"
    grid = [f"{a.name} {a.low:g} .. {a.high:g} {a.unit}, {a.count} places" for a in data.along]
    yield f"grid: {'; '.join(grid)}"
    if data.shard:
        shard = data.shard
        places = f"places {shard.first} to {shard.last} of {shard.problems}" if data.problems else "none"
        yield f"shard {shard.index} of {shard.of}: {places}"
    if data.at:
        yield f"held: {', '.join(f'{name} = {value:g}' for name, value in data.at.items())}"
    yield ""
    counts = data.counts
    if counts.by_status:
        what = "branches" if data.mode == "all" else "poses" if inverse else "inputs"
        yield table(("status", what), [(n, str(k)) for n, k in counts.by_status.items()], left=("status",))
    else:
        yield table(("modes with a solution", "problems"), [(n, str(k)) for n, k in counts.by_modes.items()])
    for reason, count in list(counts.refused.items())[:REASONS]:
        yield f"no_mechanism, {count}: {reason}"
    if len(counts.refused) > REASONS:
        yield f"and {len(counts.refused) - REASONS} more reasons: {ABOUT} has them"
    yield ""
    rows = [
        (item.file, item.dtype, " x ".join(map(str, item.shape)), ", ".join(item.axes)) for item in data.files.values()
    ]
    yield table(("file", "dtype", "shape", "axes"), rows, left=("file", "dtype", "axes"))
    yield ""
    yield f"written: {folder}, {size_text(data.bytes)}; {ABOUT} there says what they hold"
    yield "in Python:"
    first = next(iter(data.files.values())).file
    yield Verbatim(f'    values = numpy.load({str(folder / first)!r}, mmap_mode="r")')
