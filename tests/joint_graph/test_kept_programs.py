"""Programs that are kept answer as those that are recorded, and a damaged entry is none."""

import numpy as np
import pytest

import assur
from assur.joint_graph import programs
from assur.joint_graph.frames import frame_numbers
from assur.joint_graph.programs import program
from assur.kinematics.newton_step import NewtonStep


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path))
    programs._programs.cache_clear()
    yield tmp_path / "programs"
    programs._programs.cache_clear()


def numbers(asked, given=()):
    record = assur.load("delta_4s")
    values = np.random.default_rng(1).normal(size=(3, len(record.coordinates)))
    return program(record, asked, given)(record, values, np.ones((len(given), 3)))


def recorded_anew(monkeypatch):
    programs._programs.cache_clear()
    calls, record = [], programs._Structure.program
    monkeypatch.setattr(programs._Structure, "program", lambda *given: calls.append(given) or record(*given))
    return calls


STEP = NewtonStep(tuple(assur.load("delta_4s").input_indices))


@pytest.mark.parametrize(("asked", "given"), [(frame_numbers, ()), (STEP, STEP.given)], ids=["function", "step"])
def test_a_kept_program_is_read_and_answers_to_the_last_bit(folder, monkeypatch, asked, given):
    first = numbers(asked, given)
    calls = recorded_anew(monkeypatch)
    again = numbers(asked, given)
    assert not calls
    np.testing.assert_array_equal(first, again)


@pytest.mark.parametrize("part", [slice(0, -7), slice(0, 0), slice(None, None, -1)])
def test_a_damaged_entry_is_made_anew(folder, monkeypatch, part):
    first = numbers(frame_numbers)
    (entry,) = folder.iterdir()
    entry.write_bytes(entry.read_bytes()[part])
    calls = recorded_anew(monkeypatch)
    np.testing.assert_array_equal(numbers(frame_numbers), first)
    assert len(calls) == 1


def test_what_no_name_tells_apart_is_not_kept(folder):
    for power in (2, 3):
        numbers(lambda configuration, power=power: {"y": configuration.frames["platform"][1][1] ** power})
    assert not folder.exists()
