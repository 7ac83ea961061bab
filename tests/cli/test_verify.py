import hashlib
import json
import math
import shutil

import pytest

from assur.certificates.certificate import certificate
from assur.model.registry import load_record
from hand_certificates import NO_JOINTS


@pytest.fixture
def path(tmp_path):
    return certificate(load_record("zeng2019"), most=60).write(tmp_path / "c.json")


@pytest.fixture
def forged(tmp_path):
    """The file of a small certificate that a function changes, its checksum put right."""
    made = certificate(load_record("zeng2019"), most=2)

    def write(change):
        document = json.loads(made.text)
        del document["sha256"]
        change(document)
        text = json.dumps(document, sort_keys=True, separators=(",", ":"))
        document["sha256"] = hashlib.sha256(text.encode()).hexdigest()
        (tmp_path / "forged.json").write_text(json.dumps(document))
        return str(tmp_path / "forged.json")

    return write


def own_formulas(document):
    """Formulas that say nothing of a mechanism, for which all of a huge box is regular."""
    one = (1.0).hex()
    document["kind"] = "box"
    document["statement"]["box"] = [[(-1e6).hex(), (1e6).hex()]] * 3
    document["program"] = {"operations": [["number", one, one, ""]], "margins": [["M12", 0]], "nonzero": []}
    document["program"] |= {"factors": [["w", 0]], **NO_JOINTS}
    document["proof"] = "r"
    leaves = {"inside": 0, "regular": 1, "outside": 0, "open": 0}
    document["claims"] = {"leaves": leaves, "reached": "yes", "regular": "yes"}


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
    document = certificate(load_record("zeng2019"), most=60).to_json()
    del document["sha256"]
    document["proof"] = document["proof"].replace("b", "i")
    text = json.dumps(document, sort_keys=True, separators=(",", ":"))
    document["sha256"] = hashlib.sha256(text.encode()).hexdigest()
    (tmp_path / "c.json").write_text(json.dumps(document))
    run = assur_cli("verify", str(tmp_path / "c.json"))
    assert run.code == 1
    assert "does not hold: inside for x " in run.out


@pytest.mark.parametrize("part", ["mechanism", "mode", "parameters", "strokes", "held", "files"])
def test_a_statement_that_nobody_can_read_is_refused(assur_cli, forged, part):
    """Its leaves hold for its formulas, but what it says of a mechanism is nothing."""
    text = {"mechanism": 5, "mode": 1}  # where a text is expected, "no" is the name of a mechanism or a mode
    for value in (5, ["no"], {"no": "no"}, {"a": "0x1p5000"}, text.get(part, "no")):
        run = assur_cli("verify", forged(lambda document, value=value: document["statement"].update({part: value})))
        assert run.code == 3
        assert run.err == ""


NAMES = {
    "mode": ["no", "+" * 5, "+" * 500],
    "parameters": [
        *({"l2": value} for value in (0.0, -1.0, 1e300, 5e-324)),
        {"l_2": 280.0},
        {"": 1.0},
        {"record": 1.0},
    ],
    "held": [{"q": 0.0}, {"x": 1e308}, {"x": 0.0, "y": 0.0, "z": 0.0}, {"y": 5e-324}],
    "strokes": [{"q": None}, {"yA1": (1.0, 0.0)}, {"yA1": (1e308, 1.5e308)}, {"yA1": (0.0, math.inf)}],
}


def in_hex(value):
    return [end.hex() for end in value] if isinstance(value, tuple) else None if value is None else value.hex()


@pytest.mark.parametrize("part", NAMES)
def test_a_statement_of_another_mechanism_is_refused(assur_cli, forged, part):
    """It is written as it should be, but there is no such mechanism: refused, and neither usage nor a bug."""
    for value in NAMES[part]:
        new = value if isinstance(value, str) else {name: in_hex(item) for name, item in value.items()}
        run = assur_cli("verify", forged(lambda document, new=new: document["statement"].update({part: new})))
        assert (run.code, run.err) == (1, "")


@pytest.mark.parametrize("wrong", [{"l_2": 280.0}, {"l2": 0.0}])
def test_a_dimension_that_is_none_does_not_turn_the_comparison_off(assur_cli, forged, wrong):
    def change(document):
        own_formulas(document)
        document["statement"]["parameters"] = {name: value.hex() for name, value in wrong.items()}

    run = assur_cli("verify", forged(change))
    assert run.code == 1
    assert run.out.startswith("refused: ")
    assert "another mechanism or version: " in run.out
    assert f"'{next(iter(wrong))}'" in run.out
    run = assur_cli("verify", forged(change), "--json")
    assert run.json["verified"] is False
    assert assur_cli("verify", forged(change), "--mechanism", "zeng2019").code == 1
    other = assur_cli("verify", forged(change), "--mechanism", "fivebar")
    assert other.code == 1
    assert "mechanism: zeng2019 there, fivebar here" in " ".join(other.out.split())


@pytest.mark.parametrize("count", [1, 3, 5])
def test_formulas_of_its_own_are_never_called_verified(assur_cli, forged, count):
    """Anyone can write some under which a claim holds, for a mechanism of any name and any number of coordinates."""

    def change(document):
        own_formulas(document)
        one = (1.0).hex()
        document |= {"kind": "workspace"}
        coordinates, box = list("xyzuv"[:count]), [[(0.0).hex(), one]] * count
        document["statement"] |= {"mechanism": "mine", "coordinates": coordinates, "box": box}
        document["claims"] = {"leaves": document["claims"]["leaves"], "volume": [one, one], "regular_volume": one}

    run = assur_cli("verify", forged(change))
    assert run.code == 5
    assert run.out.startswith("holds for its own formulas: ")
    assert "verified" not in run.out
    data = assur_cli("verify", forged(change), "--json").json
    assert (data["verified"], data["mechanism_compared"]) == (None, False)


@pytest.mark.parametrize("part", ["mechanism", "mode"])
def test_nothing_in_it_moves_the_cursor(assur_cli, forged, part):
    run = assur_cli("verify", forged(lambda document: document["statement"].update({part: "a\x1b[2J\x1b[31mb"})))
    assert run.code == 3
    assert "\x1b" not in run.out + run.err


def test_a_mechanism_without_closed_form_is_another(assur_cli, path, tmp_path):
    shutil.copy(load_record("zeng2019").file, tmp_path)
    run = assur_cli("verify", str(path), "--mechanism", str(tmp_path / "mechanism.toml"))
    assert run.code == 1
    assert "files: closed_form.py not as they were" in " ".join(run.out.split())


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
