import json

import mpmath
import pytest

from assur.certificates.certificate import certificate
from assur.model.registry import load_record

FEW = ("--most", "60")


def test_the_file_is_that_of_the_library(assur_cli, tmp_path):
    path = tmp_path / "c.json"
    words = ("--box", "x=-50:50", "--stroke", "yA1=-300:300", "--at", "y=0", "--mode", "++-++")
    run = assur_cli("certify", "zeng2019", "-o", str(path), *words, *FEW, "--json")
    assert run.code == 0
    asked = {"box": {"x": (-50, 50)}, "strokes": {"yA1": (-300, 300)}, "held": {"y": 0.0}, "mode": "++-++"}
    found = certificate(load_record("zeng2019"), **asked, most=60)
    written, own = json.loads(path.read_text()), found.to_json()
    assert written == own
    assert run.json["claims"] == found.claims
    assert "proof" not in run.json


def test_angles_are_in_degrees(assur_cli, tmp_path):
    path = tmp_path / "c.json"
    assur_cli("certify", "planar_3rpr", "-o", str(path), "--box", "phi=0:90", *FEW)
    low, high = json.loads(path.read_text())["statement"]["box"][2]
    assert float.fromhex(low) == 0.0
    assert float.fromhex(high) == pytest.approx(1.5707963267948966)


def test_a_box_of_degrees_is_rounded_outwards(assur_cli, tmp_path):
    path = tmp_path / "c.json"
    words = ("--box", "phi=-10:10", "--box", "x=-1:1", "--box", "y=-1:1", "--kind", "box")
    assert assur_cli("certify", "planar_3rpr", "-o", str(path), *words, *FEW).code == 5  # so few leaves decide nothing
    (x, _), _, (low, high) = (map(float.fromhex, pair) for pair in json.loads(path.read_text())["statement"]["box"])
    with mpmath.workdps(40):
        assert low < -10 * mpmath.pi / 180 < 10 * mpmath.pi / 180 < high
    assert x == -1.0


def test_a_person_sees_what_is_claimed_and_that_it_is_not_checked_yet(assur_cli, tmp_path):
    path = tmp_path / "b.json"
    words = ("--kind", "box", "--box", "x=-20:0", "--box", "z=400:420")
    run = assur_cli("certify", "zeng2019", "-o", str(path), *words)
    assert "all of the box is reached: yes" in run.out
    assert "all of it is free of singularities: yes" in run.out
    assert "not yet checked by `assur verify`" in run.out
    assert max(map(len, run.out.splitlines())) <= 80


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--gap", "-1"), "gap: -1.0 is no share"),
        (("--most", "0"), "most: 0 leaves"),
        (("--most", "x"), "--most"),
        (("--box", "x=3:1"), "x"),
        (("--box", "q=1:3"), "unknown pose coordinate"),
        (("--kind", "road"), "kind"),
        (("--kind", "path", "--from", "0,0,300"), "from which pose to which"),
        (("--from", "0,0,300", "--to", "0,0,310"), "add --kind path"),
        (("--kind", "path", "--from", "0,0,300", "--to", "0,0,310", "--gap", "0.1"), "no --gap"),
        (("--kind", "path", "--from", "0,0,300", "--to", "0,0,310", "--resume"), "no --resume"),
        (("--kind", "path", "--from", "0,0,300", "--to", "0,0,310", "--most", "0"), "--most: 0 leaves"),
        (("--kind", "path", "--from", "0,0,300", "--to", "0,0,310", "--finest", "2"), "--finest: 2.0 is no share"),
        (("--kind", "path", "--from", "0,0,300", "--to", "0,0"), "--to"),
    ],
)
def test_misuse_ends_with_a_usage_error_and_no_file(assur_cli, tmp_path, words, message):
    path = tmp_path / "c.json"
    run = assur_cli("certify", "zeng2019", "-o", str(path), *words)
    assert run.code == 2
    assert message in run.err
    assert not path.exists()


def test_a_place_that_cannot_be_written_is_told_before_the_work(assur_cli, tmp_path):
    run = assur_cli("certify", "zeng2019", "-o", str(tmp_path / "none" / "c.json"))
    assert run.code == 2
    assert "does not exist" in run.err
    assert assur_cli("certify", "zeng2019", "-o", str(tmp_path / "c.txt")).code == 2


def test_it_is_carried_on(assur_cli, tmp_path):
    path = tmp_path / "c.json"
    words = ("certify", "zeng2019", "-o", str(path), "--resume", "--json")
    few = assur_cli(*words, *FEW).json["claims"]["leaves"]
    more = assur_cli(*words, "--most", "200").json["claims"]["leaves"]
    assert sum(few.values()) == 60
    assert sum(more.values()) == 200
    assert assur_cli("verify", str(path)).code == 0
    run = assur_cli(*words, "--mode", "+++++")
    assert run.code == 2
    assert "states something else" in run.err
    path.write_text("{}")
    run = assur_cli(*words)
    assert run.code == 2
    assert "cannot carry on" in run.err
