import dataclasses
import shutil

import numpy as np
import pytest

from assur.errors import MechanismFileError
from assur.kinematics.position import inverse
from assur.model.registry import load_record
from assur.scene.companion import Companion, companion, length
from assur.scene.skeleton import skeleton


def test_bars_are_as_long_as_they_claim_in_every_configuration(every):
    record = every.record
    claims = [bar for bar in every.companion.bars if bar.length]
    assert claims or record.name == "gough_stewart", "legs that change their lengths"
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    poses = np.random.default_rng(3).uniform(low, high, size=(40, len(low)))
    solved = inverse(record, poses)
    for row, branch in list(zip(*np.nonzero(solved.exists), strict=True))[:40:4]:
        body = skeleton(record, every.companion, solved.joints[row, branch])
        for rod in body.rods:
            if rod.length:
                assert rod.size == pytest.approx(length(record, rod.length), rel=1e-9, abs=1e-9)


def test_without_a_file_everything_is_default(every):
    assert companion(dataclasses.replace(every.record, folder=None)) == Companion()


BAD = """
inputs = [1]
colour = "red"
rail = "2 +"
[links]
bsae = "0"
[[bars]]
link = "base"
ends = ["Q1"]
[views]
model = { kind = "perspective" }
"""


def test_every_fault_of_a_file_is_reported_with_its_line(every, tmp_path):
    (tmp_path / "figures.toml").write_text(BAD)
    with pytest.raises(MechanismFileError) as caught:
        companion(dataclasses.replace(every.record, folder=tmp_path))
    text = str(caught.value)
    assert "figures.toml:3: colour: unknown key 'colour'; there is: bars, chains" in text
    assert "figures.toml:7: bars[0].ends" in text
    assert "figures.toml:11: views.model" in text


NAMES = """
inputs = [1]
rail = "nothing"
bars = [ { link = "bsae", ends = ["Q1", "Q2"], length = "no*2" } ]
[examples]
serial = "nonsense"
"""


def test_names_that_do_not_exist_are_reported(every, tmp_path):
    (tmp_path / "figures.toml").write_text(NAMES)
    with pytest.raises(MechanismFileError) as caught:
        companion(dataclasses.replace(every.record, folder=tmp_path))
    text = str(caught.value)
    for part in ("inputs", "rail", "'bsae'", "'Q1'", "'Q2'", "bars[0].length", "'nonsense'"):
        assert part in text
    assert "did you mean 'base'" in text


def test_a_dollar_sign_begins_no_formula_in_a_text(tmp_path):
    source = load_record("fivebar").folder
    shutil.copy(source / "mechanism.toml", tmp_path / "mechanism.toml")
    (tmp_path / "figures.toml").write_text('[links]\ncrank1 = "a$b$"\n', encoding="utf-8")
    with pytest.raises(MechanismFileError, match=r"figures.toml:2: links.crank1: 'a\$b\$'; allowed: words without"):
        companion(load_record(tmp_path / "mechanism.toml"))
