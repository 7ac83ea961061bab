import json
import math

import numpy as np
import pytest

from assur.certificates.paths import path_certificate
from assur.model.registry import load_record
from assur.workspace.aspects.aspects import aspects

FIVEBAR = ("certify", "fivebar", "--kind", "path", "--mode=-+")
WAY = ("--from", "x=-60,y=150", "--to", "60,220")


def test_the_file_is_that_of_the_library(assur_cli, tmp_path):
    path = tmp_path / "p.json"
    run = assur_cli(*FIVEBAR, "-o", str(path), *WAY, "--json")
    assert run.code == 0
    record = load_record("fivebar")
    found = aspects(record, "-+")
    made = path_certificate(record, found, found.path([-60.0, 150.0], [60.0, 220.0]))
    written, own = json.loads(path.read_text()), made.to_json()
    assert written == own
    assert run.json["claims"] == made.claims
    assert run.json["written"] == str(path)
    assert "proof" not in run.json


def test_a_person_sees_both_ends_and_verify_proves_it_again(assur_cli, tmp_path):
    path = tmp_path / "p.json"
    run = assur_cli(*FIVEBAR, "-o", str(path), *WAY)
    for text in ("from: x = -60 mm, y = 150 mm", "to: x = 60 mm, y = 220 mm", "all of the path is reached: yes"):
        assert text in run.out
    assert "not yet checked by `assur verify`" in run.out
    again = assur_cli("verify", str(path))
    assert again.code == 0
    assert "all of it is free of singularities: yes" in again.out
    path.write_text(path.read_text().replace('"to": ["0x1.e', '"to": ["0x1.f'))
    assert assur_cli("verify", str(path)).code == 3


def test_angles_box_strokes_and_what_is_held_are_those_that_are_given(assur_cli, tmp_path):
    path = tmp_path / "p.json"
    words = ("--at", "phi=17", "--box", "x=-8:8", "--stroke", "rho1=0:11", "--stroke", "rho2=1:9")
    ends = ("--from", "-6,-1.5", "--to", "-4,-9")
    assert assur_cli("certify", "planar_3rpr", "--kind", "path", "-o", str(path), *words, *ends).code == 0
    statement = json.loads(path.read_text())["statement"]
    assert float.fromhex(statement["held"]["phi"]) == pytest.approx(17 * math.pi / 180)
    strokes = {name: tuple(map(float.fromhex, pair)) for name, pair in statement["strokes"].items()}
    assert strokes == {"rho1": (0.0, 11.0), "rho2": (1.0, 9.0)}
    assert assur_cli("verify", str(path)).code == 0


@pytest.mark.parametrize("where", ["certificates.leaves.Leaves.axes", "workspace.aspects.search._between"])
def test_ctrl_c_ends_it_and_writes_nothing(assur_cli, tmp_path, monkeypatch, where):
    """While the path is proved, whose one box must be halved here, and while it is looked for."""
    from assur.certificates import leaves

    def interrupted(*_, **__):
        raise KeyboardInterrupt

    honest = leaves.Leaves.tokens
    monkeypatch.setattr(
        leaves.Leaves, "tokens", lambda self, boxes: honest(self, boxes) if len(boxes) > 1 else np.array(["b"])
    )
    monkeypatch.setattr(f"assur.{where}", interrupted)
    path = tmp_path / "p.json"
    run = assur_cli(*FIVEBAR, "-o", str(path), *WAY)
    assert (run.code, run.out, run.err) == (130, "", "interrupted: there is no answer yet\n")
    assert not path.exists()


def test_a_smaller_size_has_more_boxes(assur_cli, tmp_path):
    count = []
    for finest in ("0.05", "0.005"):
        path = tmp_path / "p.json"
        assert assur_cli(*FIVEBAR, "-o", str(path), *WAY, "--finest", finest).code == 0
        count.append(len(json.loads(path.read_text())["statement"]["boxes"]))
    assert count[0] < count[1]


@pytest.mark.parametrize(
    ("name", "words", "code", "why"),
    [
        ("fivebar", ("--from", "-60,150", "--to", "600,220"), 4, "beyond the box"),
        ("fivebar", ("--from", "-60,150", "--to", "150,260", "--mode=-+"), 4, "not reached"),
        ("planar_3rpr", ("--from", "0,0,0", "--to", "1,1,10"), 5, "may be zero here"),
    ],
)
def test_without_a_path_there_is_no_file(assur_cli, tmp_path, name, words, code, why):
    path = tmp_path / "p.json"
    run = assur_cli("certify", name, "--kind", "path", "-o", str(path), *words)
    assert run.code == code
    assert "no path written" in run.out
    assert why in run.out
    assert not path.exists()
    data = assur_cli("certify", name, "--kind", "path", "-o", str(path), *words, "--json").json
    assert data["written"] is None


def test_poses_of_two_aspects_have_no_path(assur_cli, tmp_path):
    record = load_record("fivebar")
    box = {"x": (-300, 300), "y": (-300, 300)}
    found = aspects(record, "++", box)
    ends = [",".join(map(repr, item.boxes.middles[:, 0].tolist())) for item in found.aspects[:2]]
    words = ("--mode", "++", "--box", "x=-300:300", "--box", "y=-300:300", f"--from={ends[0]}", f"--to={ends[1]}")
    run = assur_cli("certify", "fivebar", "--kind", "path", "-o", str(tmp_path / "p.json"), *words)
    assert run.code == 4
    assert "no path written: separated" in run.out
