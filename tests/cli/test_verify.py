from __future__ import annotations

import json
import math
import shutil

import pytest

from assur.certificates.certificate import certificate
from assur.model.registry import load_record


@pytest.fixture
def path(tmp_path):
    return certificate(load_record("zeng2019"), most=60).write(tmp_path / "c.json")


def test_a_valid_one_is_verified(assur_cli, path, monkeypatch):
    monkeypatch.chdir(path.parent)  # a long path would be broken over two lines
    run = assur_cli("verify", str(path), "--json")
    assert run.code == 0
    assert run.json["verified"] is True
    assert run.json["mechanism_compared"] is True
    assert run.json["claims"] == json.loads(path.read_text())["claims"]
    shown = assur_cli("verify", path.name)
    assert shown.out.startswith(f"verified: {path.name}\n")
    text = " ".join(shown.out.split())
    assert "checked: every part, proved again by ball arithmetic; the sums, exactly; in" in text
    assert "formulas: the mechanism's, recorded anew" in text
    assert "parts: 60, which cover the box without overlap; of these" in text
    open_ = run.json["shares"]["open"]
    assert f"{run.json['claims']['leaves']['open']} ({100 * open_:.3g} %) undecided: nothing is proved there" in text
    low, high = (float.fromhex(value) for value in run.json["claims"]["volume"])
    sides = [float.fromhex(b) - float.fromhex(a) for a, b in run.json["statement"]["box"]]
    assert open_ == pytest.approx((high - low) / math.prod(sides))
    assert max(map(len, shown.out.splitlines())) <= 80


def test_a_damaged_one_is_refused(assur_cli, path):
    path.write_text(path.read_text()[:-40])
    run = assur_cli("verify", str(path))
    assert run.code == 3
    assert "not JSON, or cut short" in run.out
    assert assur_cli("verify", str(path), "--json").json["verified"] is False


def test_a_false_one_is_refused(assur_cli, tmp_path):
    import hashlib

    document = certificate(load_record("zeng2019"), most=60).to_json()
    del document["sha256"]
    document["proof"] = document["proof"].replace("b", "i")
    text = json.dumps(document, sort_keys=True, separators=(",", ":"))
    document["sha256"] = hashlib.sha256(text.encode()).hexdigest()
    (tmp_path / "c.json").write_text(json.dumps(document))
    run = assur_cli("verify", str(tmp_path / "c.json"))
    assert run.code == 1
    assert "does not hold: inside for x " in run.out


@pytest.mark.parametrize("part", ["mechanism", "mode", "parameters", "strokes", "held"])
def test_a_statement_that_nobody_can_read_is_refused(assur_cli, tmp_path, part):
    """Its leaves hold for its formulas, but what it says of a mechanism is nothing."""
    import hashlib

    for value in (5, "no", ["no"], {"no": "no"}):
        document = certificate(load_record("zeng2019"), most=2).to_json()
        del document["sha256"]
        document["statement"][part] = value
        text = json.dumps(document, sort_keys=True, separators=(",", ":"))
        document["sha256"] = hashlib.sha256(text.encode()).hexdigest()
        (tmp_path / "c.json").write_text(json.dumps(document))
        assert assur_cli("verify", str(tmp_path / "c.json")).code in (1, 2, 3, 5)


def test_another_version_of_the_mechanism_is_refused(assur_cli, path, tmp_path):
    folder = load_record("zeng2019").file.parent
    for name in ("mechanism.toml", "closed_form.py"):
        shutil.copy(folder / name, tmp_path)
    mechanism = tmp_path / "mechanism.toml"
    assert assur_cli("verify", str(path), "--mechanism", str(mechanism)).code == 0
    mechanism.write_text(mechanism.read_text() + "\n# another version\n")
    run = assur_cli("verify", str(path), "--mechanism", str(mechanism))
    assert run.code == 1
    assert "another mechanism or version: files: mechanism.toml not as they were" in " ".join(run.out.split())
    run = assur_cli("verify", str(path), "--mechanism", "fivebar")
    assert run.code == 1
    assert "another mechanism or version: mechanism: zeng2019 there, fivebar here" in " ".join(run.out.split())


def test_a_mechanism_that_is_not_at_hand_leaves_it_undecided(assur_cli, tmp_path):
    folder = load_record("zeng2019").file.parent
    for name in ("mechanism.toml", "closed_form.py"):
        shutil.copy(folder / name, tmp_path)
    mechanism = tmp_path / "mechanism.toml"
    mechanism.write_text(mechanism.read_text().replace('"zeng2019"', '"of_my_own"', 1))
    certificate(load_record(mechanism), most=20).write(tmp_path / "c.json")
    run = assur_cli("verify", str(tmp_path / "c.json"))
    assert run.code == 5
    assert "not compared: the mechanism is not at hand" in run.out
    assert assur_cli("verify", str(tmp_path / "c.json"), "--mechanism", str(mechanism)).code == 0
    assert assur_cli("verify", str(tmp_path / "c.json"), "--mechanism", "zeng2021").code == 2


def test_a_file_that_is_not_there_is_a_usage_error(assur_cli, tmp_path):
    run = assur_cli("verify", str(tmp_path / "none.json"))
    assert run.code == 2
    assert "cannot read" in run.err
