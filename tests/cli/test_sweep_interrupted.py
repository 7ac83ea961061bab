"""`assur sweep` interrupted: by Ctrl-C, by a full disk; it goes on and ends with the same files."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from assur.results.disk import Disk

COMMAND = Path(sys.executable).with_name("assur")
PLANE = ("--along", "x=-120:120:9", "--along", "z=250:550:11", "--at", "y=10")


def files_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture
def small_blocks(monkeypatch):
    monkeypatch.setattr("assur.results.store.layout.NUMBER_OF_BLOCKS", 10_000)  # as short as they may be


@pytest.fixture
def words(tmp_path):
    grid = ("--along", "x=20", "--along", "y=21", "--along", "z=22", "--keep", "inputs,exists,status,factors")
    return lambda name: ("sweep", "zeng2019", *grid, "--threads", "1", "-o", str(tmp_path / name))


def stopped_after(monkeypatch, blocks):
    """Ctrl-C in the middle of a block, once so many are written."""
    write, left = Disk.write, [blocks * 4]

    def stopping(disk, path, pieces):
        if path.name.endswith(".npy.part"):
            if not left[0]:
                raise KeyboardInterrupt
            left[0] -= 1
        write(disk, path, pieces)

    monkeypatch.setattr(Disk, "write", stopping)


@pytest.mark.usefixtures("small_blocks")
def test_it_goes_on_and_ends_with_the_same_files(assur_cli, tmp_path, words, monkeypatch):
    whole = assur_cli(*words("whole"), "--json").json
    with monkeypatch.context() as patched:
        stopped_after(patched, 3)
        run = assur_cli(*words("parts"))
    assert (run.code, run.out) == (130, "")
    stopped = f"interrupted: stopped at 3072 of 9240, in {tmp_path / 'parts'}"
    assert f"{stopped}\nhint: the same command goes on from there\n" in run.err
    assert files_of(tmp_path / "parts") != files_of(tmp_path / "whole")
    again = assur_cli(*words("parts"))
    assert (again.code, "9240 poses, of which 3072 are done" in again.err) == (0, True)
    assert files_of(tmp_path / "parts") == files_of(tmp_path / "whole")
    notes = [(tmp_path / name / "sweep.json").read_text() for name in ("parts", "whole")]
    assert notes[0] == notes[1]
    assert json.loads(notes[0]) == {key: whole[key] for key in json.loads(notes[0])}
    assert whole.keys() - json.loads(notes[0]).keys() == {"folder", "repaired"}
    assert sum(whole["counts"]["by_status"].values()) == 9240


@pytest.mark.usefixtures("small_blocks")
def test_a_finished_sweep_answers_again(assur_cli, words, monkeypatch):
    first = assur_cli(*words("same"), "--json")
    stopped_after(monkeypatch, 0)
    assert assur_cli(*words("same"), "--json") == first


@pytest.mark.usefixtures("small_blocks")
def test_a_disk_that_fills_up_is_told_and_loses_nothing(assur_cli, tmp_path, words, monkeypatch):
    assur_cli(*words("whole"))
    with monkeypatch.context() as patched:
        write, written = Disk.write, []

        def full(disk, path, pieces):
            written.extend([path] if path.name == "status.npy.part" else [])
            if len(written) > 2 and path.name.endswith(".npy.part"):
                raise OSError(28, "No space left on device", str(path))
            write(disk, path, pieces)

        patched.setattr(Disk, "write", full)
        run = assur_cli(*words("parts"))
    assert run.code == 2
    assert "No space left on device" in run.err
    assert "status.npy.part); 2048 of 9240 are done\nhint: the same command goes on from there, once" in run.err
    assert assur_cli(*words("parts")).code == 0
    assert files_of(tmp_path / "parts") == files_of(tmp_path / "whole")


def test_another_grid_is_refused_and_the_folder_left_as_it_is(assur_cli, tmp_path, words):
    assur_cli(*words("first"))
    before = {path: path.read_bytes() for path in (tmp_path / "first").iterdir()}
    for more in (("--mode", "+++++"), ("--set", "l2=300")):
        run = assur_cli(*words("first"), *more)
        assert run.code == 2
        assert "belongs to another question" in run.err
    run = assur_cli("sweep", "zeng2019", *PLANE, "-o", str(tmp_path / "first"))
    assert "it differs in" in run.err
    assert {path: path.read_bytes() for path in (tmp_path / "first").iterdir()} == before


@pytest.mark.skipif(os.name == "nt", reason="Ctrl-C is sent otherwise there")
def test_ctrl_c_from_a_keyboard(tmp_path):
    words = ("--along", "x=9000", "--along", "y=9000", "--mode", "all", "--keep", "exists,status")
    process = subprocess.Popen(
        [COMMAND, "sweep", "fivebar", *words, "-o", str(tmp_path)],
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # not as a shell's background has it
    )
    state = tmp_path / "state.json"
    while process.poll() is None and not (state.exists() and json.loads(state.read_text())["done"] > 0):
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate()
    done = json.loads(state.read_text())["done"]
    assert (process.returncode, out) == (130, "")
    assert 0 < done < 81_000_000
    assert f"interrupted: stopped at {done} of 81000000, in {tmp_path}\nhint: the same command goes on" in err
