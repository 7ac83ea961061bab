"""Grids that are streamed: the numbers of a sweep, in little memory, resumed where they were stopped."""

import json
import os
import signal
import subprocess
import sys
import time
import tracemalloc

import numpy as np
import pytest

import assur
from assur.errors import DamagedStoreError, UnknownNameError, UsageError
from assur.kinematics.closed_form.grids import grid_over
from assur.kinematics.closed_form.streamed import reduce_grid, sweep_grid
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.results.store.store import STATE
from exact_grids import exact_axis

COUNTS = (7, 5, 11)
WANT = ("inputs", "exists", "condition_index")


class StoppedError(Exception):
    """Stands for Ctrl-C."""


def everything(zeng, counts=COUNTS):
    """The same grid in memory, by fractions and numpy's own meshgrid."""
    axes = [exact_axis(*zeng.box[name], count) for name, count in zip(zeng.platform.pose, counts, strict=True)]
    poses = np.array([axis.ravel() for axis in np.meshgrid(*axes, indexing="ij")])
    return poses, inverse_sweep(zeng, poses, want=WANT, engine="numpy")


def stop_after(poses):
    def progress(done, total):
        if done >= poses:
            raise StoppedError

    return progress


@pytest.mark.parametrize(("block", "threads"), [(385, 1), (64, 1), (50, 2), (1, 3)])
def test_files_hold_the_sweep(zeng, tmp_path, block, threads):
    found = sweep_grid(zeng, COUNTS, tmp_path / "new", want=WANT, block=block, threads=threads)
    _, wanted = everything(zeng)
    assert wanted["exists"].any()
    for name, values in wanted.items():
        np.testing.assert_array_equal(found[name].reshape(values.shape), values)
    assert found["inputs"].shape == (3, *COUNTS)
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == sorted([*(f"{n}.npy" for n in WANT), STATE])


@pytest.mark.parametrize("threads", [1, 2])
def test_an_interrupted_sweep_goes_on_where_it_stopped(zeng, tmp_path, threads):
    with pytest.raises(StoppedError):
        sweep_grid(zeng, COUNTS, tmp_path, want=WANT, block=40, threads=threads, progress=stop_after(120))
    assert json.loads((tmp_path / STATE).read_text())["done"] == 120
    told = []
    found = sweep_grid(
        zeng,
        COUNTS,
        tmp_path,
        want=WANT,
        block=40,
        threads=threads,
        progress=lambda done, total: told.append((done, total)),
    )
    assert told == [(done, 385) for done in (160, 200, 240, 280, 320, 360, 385)]
    for name, values in everything(zeng)[1].items():
        np.testing.assert_array_equal(found[name].reshape(values.shape), values)
    told.clear()
    sweep_grid(zeng, COUNTS, tmp_path, want=WANT, block=40, progress=lambda *done: told.append(done))
    assert told == []
    with pytest.raises(UsageError, match="differs in block"):
        sweep_grid(zeng, COUNTS, tmp_path, want=WANT, block=50)


def test_a_killed_process_loses_nothing_that_it_noted(zeng, tmp_path):
    counts = (60, 60, 60)
    code = (
        "import sys, time, assur\n"
        "from assur.kinematics.closed_form import streamed\n"
        "from assur.results.store import store\n"
        "store.SAVED = store.SHARE = 0.0\n"
        "def slowly(done, total):\n"
        "    time.sleep(0.02)\n"
        "streamed.sweep_grid(assur.load('zeng2019'), (60, 60, 60), sys.argv[1], "
        f"want={WANT!r}, block=1000, progress=slowly)\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code, str(tmp_path)], env={**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    )
    state = tmp_path / STATE
    while process.poll() is None and not (state.exists() and json.loads(state.read_text())["done"] >= 5000):
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.wait()
    done = json.loads(state.read_text())["done"]
    assert 5000 <= done < 216_000
    told = []
    found = sweep_grid(zeng, counts, tmp_path, want=WANT, block=1000, progress=lambda done, _: told.append(done))
    assert told[0] == done + 1000
    for name, values in everything(zeng, counts)[1].items():
        np.testing.assert_array_equal(found[name].reshape(values.shape), values)


def test_a_total_goes_on_where_it_stopped_and_counts_nothing_twice(zeng, tmp_path):
    def add(total, poses, found):
        real = found["exists"]
        sums = (float(np.sum(part[real])) for part in (*poses, found["condition_index"]))
        return {
            "count": total["count"] + int(real.sum()),
            "sums": [a + b for a, b in zip(total["sums"], sums, strict=True)],
        }

    start, keep = {"count": 0, "sums": [0.0] * 4}, tmp_path / "total.json"
    options = {"want": ("exists", "condition_index"), "block": 50}
    whole = reduce_grid(zeng, COUNTS, add, start, **options)
    for stop in (50, 150, 300):
        with pytest.raises(StoppedError):
            reduce_grid(zeng, COUNTS, add, start, keep=keep, progress=stop_after(stop), **options)
    assert reduce_grid(zeng, COUNTS, add, start, keep=keep, threads=2, **options) == whole
    poses, wanted = everything(zeng)
    real = wanted["exists"]
    assert whole["count"] == real.sum()
    np.testing.assert_allclose(whole["sums"][:3], poses[:, real].sum(axis=1), rtol=1e-12)
    np.testing.assert_allclose(whole["sums"][3], wanted["condition_index"][real].sum(), rtol=1e-12)
    keep.write_text(keep.read_text().replace('"done": 385', '"done": -5'))
    with pytest.raises(DamagedStoreError, match=r"total\.json: is not what was written"):
        reduce_grid(zeng, COUNTS, add, start, keep=keep, **options)


def test_memory_is_that_of_a_block(zeng, tmp_path):
    def peak(counts, block):
        tracemalloc.start()
        sweep_grid(zeng, counts, tmp_path / f"{counts[0]}", want=WANT, block=block, engine="numpy", threads=1)
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return most

    peak((2, 50, 50), 5000)
    small, large = peak((4, 50, 50), 5000), peak((200, 50, 50), 5000)  # 10^4 and 5 10^5 poses: 0.4 and 20 MB
    assert large < 1.3 * small


@pytest.mark.parametrize(
    ("change", "differs"),
    [
        ({"box": {"x": (0.0, 10.0)}}, "box"),
        ({"mode": "+++++"}, "mode"),
        ({"want": ("exists",)}, "want"),
        ({"counts": (7, 5, 12)}, "counts"),
        ({"record": "orthoglide"}, "mechanism"),
    ],
)
def test_another_question_is_refused(zeng, tmp_path, change, differs):
    sweep_grid(zeng, COUNTS, tmp_path, want=WANT)
    asked = {"record": "zeng2019", "counts": COUNTS, "want": WANT, **change}
    with pytest.raises(UsageError, match=f"another question.*{differs}"):
        sweep_grid(assur.load(asked.pop("record")), asked.pop("counts"), tmp_path, **asked)


def test_other_dimensions_are_another_question(zeng, tmp_path):
    from assur.model.dimensions import with_parameters

    sweep_grid(zeng, COUNTS, tmp_path)
    with pytest.raises(UsageError, match="dimensions"):
        sweep_grid(with_parameters(zeng, l2=300.0), COUNTS, tmp_path)


def test_files_without_a_note_and_notes_that_are_none_are_left_alone(zeng, tmp_path):
    (tmp_path / "exists.npy").write_bytes(b"mine")
    with pytest.raises(UsageError, match="already there"):
        sweep_grid(zeng, COUNTS, tmp_path)
    assert (tmp_path / "exists.npy").read_bytes() == b"mine"
    (tmp_path / STATE).write_text("{}")
    with pytest.raises(DamagedStoreError, match="is not what was written"):
        sweep_grid(zeng, COUNTS, tmp_path)


def test_a_disk_that_is_too_small_is_told_before_anything_is_written(zeng, tmp_path):
    with pytest.raises(UsageError, match=r"takes 1000000000\.0 GB"):
        sweep_grid(zeng, (10**6, 10**6, 10**6), tmp_path / "big")
    assert not list((tmp_path / "big").glob("*.npy"))


def test_refuses_unknown_names_and_quaternions(zeng, tmp_path):
    with pytest.raises(UnknownNameError, match="coordinate"):
        grid_over(zeng, (2, 2, 2), {"w": (0.0, 1.0)})
    with pytest.raises(UnknownNameError, match="quantity"):
        sweep_grid(zeng, (2, 2, 2), tmp_path, want=("volume",))
    with pytest.raises(UsageError, match="block"):
        sweep_grid(zeng, (2, 2, 2), tmp_path / "b", block=0)
    with pytest.raises(UsageError, match="quaternions"):
        grid_over(assur.load("gough_stewart"), (2,) * 7)
