"""Inverse problems whose solutions are all choices of one way a limb: the ways are listed, all rows on demand."""

import itertools
import json

import numpy as np
import pytest

from assur.cli.main import main
from assur.kinematics.position import inverse
from assur.model.registry import load_record

POSE = ["10", "20", "300", "1", "0", "0", "0"]


@pytest.fixture(scope="module")
def legs(tmp_path_factory):
    path = str(tmp_path_factory.mktemp("limbs") / "legs.toml")
    assert main(["new", path, "6-UPS"]) == 0
    return path


def test_the_product_of_the_ways_is_the_answer(legs, capsys):
    capsys.readouterr()
    assert main(["inverse", legs, *POSE, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    ways = [[list(way.values()) for way in limb["ways"]] for limb in told["limbs"]]
    names = [name for limb in told["limbs"] for name in limb["ways"][0]]
    product = [
        dict(zip(names, itertools.chain.from_iterable(chosen), strict=True)) for chosen in itertools.product(*ways)
    ]
    rows = np.array([[row[name] for name in told["input_names"]] for row in product])
    listed = np.array([solution["inputs"] for solution in told["solutions"]])
    assert rows.shape == listed.shape == (64, 6)
    assert np.allclose(rows[np.lexsort(rows.T)], listed[np.lexsort(listed.T)], rtol=0, atol=1e-6)


def test_python_has_them_too(legs):
    solutions = inverse(load_record(legs), [float(value) for value in POSE])
    assert [len(limb.values) for limb in solutions.limbs] == [2] * 6
    for limb in solutions.limbs:
        own = solutions.joints[:, list(limb.indices)]
        away = np.abs(own[:, None] - limb.values[None])
        assert np.max(np.min(np.max(np.minimum(away, np.abs(away - 2 * np.pi)), axis=-1), axis=1)) < 1e-6


def test_the_ways_are_printed_and_all_rows_where_asked(legs, capsys):
    capsys.readouterr()
    assert main(["inverse", legs, *POSE]) == 0
    short = capsys.readouterr().out
    assert "All 64 are one way of each limb; --all lists them" in short
    assert "64 solutions" in short
    assert main(["inverse", legs, *POSE, "--all"]) == 0
    whole = capsys.readouterr().out
    assert "one way of each limb" not in whole
    rows = [line for line in whole.splitlines() if line.strip().startswith(("+", "-")) and "regular" in line]
    assert len(rows) == 64


def test_few_solutions_are_listed(capsys):
    assert main(["inverse", "planar_3rrr", "0", "0", "0", "--method", "loops"]) == 0
    assert "--all" not in capsys.readouterr().out


def test_of_more_solutions_than_are_shown_the_nearest_are_listed(capsys, monkeypatch):
    monkeypatch.setattr("assur.cli.positions.MOST_ROWS", 5)
    assert main(["inverse", "planar_3rrr", "0", "0", "0"]) == 0
    printed = capsys.readouterr().out
    assert main(["inverse", "planar_3rrr", "0", "0", "0", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert len(told["solutions"]) == 8
    assert "These are the 5 nearest to home of 8; --json lists them all." in printed
    rows = [line for line in printed.splitlines() if line.strip().startswith(("+", "-", "0"))]
    assert len(rows) == 5
    assert main(["inverse", "planar_3rrr", "0", "0", "0", "--all"]) == 0
    assert "nearest to home of" not in capsys.readouterr().out
