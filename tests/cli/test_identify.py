"""`assur identify`: the same as the library says, from poses of a file or of its own, and bad tables by their lines."""

import pytest

import assur
from assur.machine.calibration.chosen_poses import chosen, random_poses
from assur.machine.calibration.identification import identification


def test_it_says_what_the_library_says(assur_cli):
    run = assur_cli("identify", "zeng2019", "--count", "4", "--json")
    record = assur.load("zeng2019")
    drawn = random_poses(record, 20)
    own = identification(record, drawn[chosen(identification(record, drawn), 4)])
    assert (run.code, run.json["rank"], run.json["parameters"]) == (0, own.rank, list(own.parameters))
    assert run.json["base_parameters"]["l7"] == {"l7": 1.0, "l8": pytest.approx(1.0)}
    assert run.json["unidentifiable"][0]["combination"] == {"b": 1.0, "d": pytest.approx(1.0)}
    assert list(run.json["observability"]) == ["O1", "O2", "O3", "O4", "O5"]
    out = assur_cli("identify", "tripteron", "--count", "2").out
    assert "together they do not act: e - q1 - q2 - q3" in out
    assert "what is told of these: e + q3, q1 - q3, q2 - q3" in out


def test_poses_come_from_a_table(assur_cli, tmp_path):
    path = tmp_path / "poses.csv"
    path.write_text("y,x\n224,0\n230,10\n\n210,-20\n", encoding="utf-8")
    data = assur_cli("identify", "fivebar", "--poses", str(path), "--frame", "--json").json
    assert data["poses"] == [[0, 224], [10, 230], [-20, 210]]
    assert data["parameters"][-6:] == [f"frame.{name}" for name in ("x", "y", "z", "rx", "ry", "rz")]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x,z\n1,2\n", "poses.csv:1: columns x, z are not those of the pose"),
        ("x,y\n1,2\n1,two\n", "poses.csv:3: column 2, y = 'two', is not a finite number"),
        ("x,y\n1,2,3\n", "poses.csv:2: 3 values, 2 columns are named"),
        ("x,y\n", "poses.csv: no poses"),
        ("x,y\n0,900\n", "pose 1 of fivebar is not reached"),
    ],
)
def test_bad_tables_are_told_by_their_lines(assur_cli, tmp_path, text, said):
    path = tmp_path / "poses.csv"
    path.write_text(text, encoding="utf-8")
    run = assur_cli("identify", "fivebar", "--poses", str(path))
    assert run.code == 2
    assert said in " ".join(run.err.split())


def test_one_source_of_poses_is_asked_for(assur_cli):
    assert assur_cli("identify", "fivebar").code == 2
    assert assur_cli("identify", "fivebar", "--count", "0").code == 2
    assert assur_cli("identify", "fivebar", "--count", "2", "--by", "O9").code == 2
    assert assur_cli("identify", "fivebar", "--count", "2", "--centre", "1,2").code == 2
    assert assur_cli("identify", "fivebar", "--poses", "nowhere.csv").code == 2
