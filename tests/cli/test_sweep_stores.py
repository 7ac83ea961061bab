"""`assur sweep` in parts and in trouble: shards and merges, damage, kills; always the bytes of a single run."""

import os
import random
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from assur.results import disk as disk_module

COMMAND = Path(sys.executable).with_name("assur")
GRID = ("--along", "x=20", "--along", "y=-250:250:21", "--along", "z=22")
LENGTHS = ("--dimension", "l1=-30:130:33", "--along", "x=-100:100:10", "--along", "y=20:280:12")
ALL_MODES = ("--along", "theta1=0.1:180:90", "--along", "theta2=0:179.9:70", "--problem", "direct")


def files_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def flip(path, place):
    raw = bytearray(path.read_bytes())
    raw[place] ^= 1
    path.write_bytes(bytes(raw))


@pytest.mark.parametrize("count", [1, 2, 3, 7])
@pytest.mark.parametrize(
    "words",
    [("zeng2019", *GRID), ("fivebar", *ALL_MODES), ("fivebar", *LENGTHS)],
    ids=["inverse", "direct", "dimensions"],
)
def test_shards_joined_are_a_single_run_to_the_byte(assur_cli, tmp_path, words, count):
    alone = assur_cli("sweep", *words, "-o", str(tmp_path / "alone"), "--json").json
    folders = [str(tmp_path / f"part-{k}") for k in range(1, count + 1)]
    parts = [
        assur_cli("sweep", *words, "--shard", f"{k}/{count}", "-o", folder, "--json").json
        for k, folder in enumerate(folders, start=1)
    ]
    assert sum(part["problems"] for part in parts) == alone["problems"] > 3 * 1024
    joined = assur_cli("sweep", "--merge", *reversed(folders), "-o", str(tmp_path / "joined"), "--json").json
    assert files_of(tmp_path / "joined") == files_of(tmp_path / "alone")
    assert {**joined, "folder": ""} == {**alone, "folder": ""}


def test_halves_of_a_grid_have_its_places(assur_cli, tmp_path):
    """Also where a step is no binary number, and where angles are turned into rad."""

    def values(along, name, held):
        folder = tmp_path / f"{name}-{along}".replace("=", "-").replace(":", "-")
        run = assur_cli("sweep", name, "--along", along, "--at", held, "--keep", "inputs,smallest", "-o", str(folder))
        assert run.code == 0, run.err
        return np.vstack([np.load(folder / "inputs.npy"), [np.load(folder / "smallest.npy")]])

    for name, coordinate, held in (("zeng2019", "x", "y=0,z=400"), ("planar_3rrr", "phi", "x=3,y=2")):
        whole = values(f"{coordinate}=0:10:101", name, held)
        halves = [values(f"{coordinate}={ends}", name, held) for ends in ("0:3.7:38", "3.8:10:63")]
        assert np.isfinite(whole).any()
        np.testing.assert_array_equal(np.hstack(halves), whole)


@pytest.mark.slow
def test_the_engine_leaves_no_trace(assur_cli, tmp_path, monkeypatch):
    words = ("fivebar", *ALL_MODES, "--keep", "poses,exists,status")
    for name, repaid in (("numpy", 10**9), ("compiled", 1)):
        monkeypatch.setattr("assur.kinematics.closed_form.filling.REPAID", repaid)
        run = assur_cli("sweep", *words, "-o", str(tmp_path / name))
        assert (run.code, {"numpy": "NumPy", "compiled": "a compiled loop"}[name] in run.err) == (0, True)
    assert files_of(tmp_path / "numpy") == files_of(tmp_path / "compiled")


def test_the_number_of_threads_leaves_no_trace(assur_cli, tmp_path):
    for threads in ("1", "5"):
        assur_cli("sweep", "zeng2019", *GRID, "--threads", threads, "-o", str(tmp_path / threads))
    assert files_of(tmp_path / "1") == files_of(tmp_path / "5")


def test_damage_is_told_with_file_and_block_and_is_repaired(assur_cli, tmp_path):
    words = ("sweep", "zeng2019", *GRID, "-o", str(tmp_path / "grid"))
    assert assur_cli(*words).code == 0
    before = files_of(tmp_path / "grid")
    flip(tmp_path / "grid" / "inputs.npy", 128 + 8 * (9240 + 5000))
    run = assur_cli(*words)
    assert (run.code, run.out) == (3, "")
    assert run.err.startswith(f"error: 1 problem:\n{tmp_path}/grid/inputs.npy: block 4: its numbers are not those that")
    assert run.err.endswith("--repair computes again what is damaged, and nothing else\n")
    problem = assur_cli(*words, "--json").json["error"]["problems"]
    assert [(item["file"], item["path"]) for item in problem] == [(f"{tmp_path}/grid/inputs.npy", "block 4")]
    run = assur_cli(*words, "--repair")
    assert (run.code, "repaired: " in run.err, "of which 8216 are done" in run.err) == (0, True, True)
    assert files_of(tmp_path / "grid") == before
    assert assur_cli(*words, "--repair", "--json").json["repaired"] == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("zeng2019", *GRID, "--shard", "3/2"), "--shard: '3/2' is not I/N"),
        (("--merge", "nowhere"), "nowhere: no shard is there"),
        (("zeng2019", "--merge", "nowhere"), "--merge stands alone"),
        (("--merge", "nowhere", "--shard", "1/2"), "--merge stands alone"),
        (("--shard", "1/2"), "no mechanism to sweep"),
        (("zeng2019",), "x, y, z: neither varied nor held"),
    ],
)
def test_what_is_refused(assur_cli, tmp_path, words, message):
    run = assur_cli("sweep", *words, "-o", str(tmp_path / "new"))
    assert (run.code, message in run.err, "hint: " in run.err) == (2, True, True)
    assert not list(tmp_path.iterdir())


def test_ctrl_c_is_an_object_too(assur_cli, tmp_path, monkeypatch):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("assur.kinematics.closed_form.grid_sweep.GridSweep.fill", stopped)
    run = assur_cli("sweep", "zeng2019", *GRID, "-o", str(tmp_path), "--json")
    assert (run.code, run.json["error"]["exit_code"]) == (130, 130)
    assert run.json["error"]["message"] == f"interrupted: stopped at 0 of 9240, in {tmp_path}"
    assert run.json["error"]["hint"] == "the same command goes on from there"


CHANGES = {"open", "os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.truncate", "os.link", "os.symlink"}


class _Watch:
    """Changes of files under a folder, and whether the disk's operations are among those who called for them."""

    folder = ""
    seen: list[tuple[str, bool]] = []  # noqa: RUF012  # a hook of this process cannot be taken away, and there is one

    @classmethod
    def hook(cls, event, given):
        if not cls.folder or event not in CHANGES or cls.folder not in str(given[0]):
            return
        if event == "open" and not set(given[1] or "") & set("wax+"):
            return
        frame, callers = sys._getframe(1), set()
        while frame is not None:
            callers.add(frame.f_code.co_filename)
            frame = frame.f_back
        cls.seen.append((f"{event} {given[0]}", disk_module.__file__ in callers))


def test_every_change_of_a_file_is_an_operation_of_the_disk(assur_cli, tmp_path):
    """Tests of the store let each of these fail: none is left out."""
    words = ("sweep", "zeng2019", *GRID, "--json", "-o", str(tmp_path / "new"))
    sys.addaudithook(_Watch.hook)
    for more in ((), ("--repair",)):
        if more:
            (tmp_path / "new" / "status.npy").unlink()
        _Watch.folder = str(tmp_path / "new")
        try:
            assert assur_cli(*words, *more).code == 0
        finally:
            _Watch.folder = ""
    assert len(_Watch.seen) > 20
    nameless = f"open {tmp_path / 'new'}"  # a file that is never seen, to try whether the folder can be written into
    assert {what for what, by_disk in _Watch.seen if not by_disk} <= {nameless}


# ---- real kills --------------------------------------------------------------------------------------------


CODE = """
import atexit, os, signal, sys, threading, time
delay = float(sys.argv.pop(1))
from assur.cli.main import main
from assur.results.store import store
store.SAVED = store.SHARE = 0.0
begin = store.Store.open
def opened(self, **options):
    begun = time.monotonic()
    atexit.register(lambda: sys.stderr.write(f"{time.monotonic() - begun}"))
    if delay:
        timer = threading.Timer(delay, os.kill, (os.getpid(), signal.SIGKILL))
        timer.daemon = True
        timer.start()
    return begin(self, **options)
store.Store.open = opened
sys.exit(main(sys.argv[1:]))
"""
"""A sweep that notes every block and is killed some seconds after it begins with its folder, or else says how long."""


def run_with_kill(seconds, words):
    return subprocess.run([sys.executable, "-c", CODE, str(seconds), *words], capture_output=True, check=False)


@pytest.mark.deep
@pytest.mark.skipif(os.name == "nt", reason="no SIGKILL there")
def test_two_hundred_kills(assur_cli, tmp_path):
    """Over the first 50 ms, over the blocks, and about the end; each folder is then gone on with."""
    words = ("zeng2019", "--along", "x=40", "--along", "y=41", "--along", "z=42", "--json", "--keep", "inputs,status")
    assert assur_cli("sweep", *words, "-o", str(tmp_path / "alone")).code == 0
    wanted = files_of(tmp_path / "alone")
    span = float(run_with_kill(0, ("sweep", *words, "-o", str(tmp_path / "timed"))).stderr)
    draw = random.Random(7)
    delays = [0.05 * (k + 1) / 70 for k in range(70)]
    delays += [draw.uniform(0.05, span) for _ in range(70)] + [draw.uniform(0.8, 1.1) * span for _ in range(60)]
    kills = 0
    for number, delay in enumerate(delays):
        folder = tmp_path / str(number)
        killed = run_with_kill(delay, ("sweep", *words, "-o", str(folder)))
        kills += killed.returncode == -signal.SIGKILL
        for path in folder.glob("*.npy"):
            assert path.read_bytes() == wanted[path.name], (delay, path.name)
        run = assur_cli("sweep", *words, "-o", str(folder))
        assert (run.code, run.err) == (0, ""), delay
        assert files_of(folder) == wanted, delay
        shutil.rmtree(folder)
    assert kills >= 70  # those of the first 50 ms; how many more depends on what else the machine does
