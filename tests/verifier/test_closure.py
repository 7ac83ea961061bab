"""Formulas against the verifier's own joint graph: right ones close it, whatever is changed in them or in the file."""

import copy
from functools import lru_cache
from pathlib import Path

import pytest

from assur.certificates.exact_check import exact_check
from assur.certificates.formulas import formulas
from assur.kinematics.contract.exact import inverse_exactness
from assur.kinematics.status import closed_form_of
from assur.model.registry import load_record
from assur.verifier.closure import closes
from assur.verifier.reading import AT_PLACES, EXACT, OF_THESE, RefusedError
from catalogue import REPRESENTATIVES, each

BIGLIDE = Path(__file__).parents[1] / "kinematics/contract/biglide/mechanism.toml"


@lru_cache
def drafted(name, **changed):
    """What a certificate holds beside its proof, of a mechanism with some dimensions changed, and its file."""
    record = load_record(name, **changed)
    rules = formulas(record)
    statement = {
        "parameters": {key: float(value).hex() for key, value in record.overrides.items()},
        "held": {key: value.hex() for key, value in rules.slice.held.items()},
        "coordinates": list(rules.slice.free),
    }
    document = {"statement": statement, "program": rules.to_json(), "exact": exact_check(record)}
    return document, record.file.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", [*each(quick=(*REPRESENTATIVES, "fivebar", "three_rps")), BIGLIDE])
def test_right_formulas_close_the_graph_with_any_dimensions(name):
    document, text = drafted(name)
    assert document["exact"]["says"] == EXACT
    found = closes(document, text)
    assert found["error"] < 1e-15
    assert found["places"] >= 2
    assert found["degree"] > 1
    assert found["guards_left_out"] == inverse_exactness(load_record(name)).guarded
    assert int(found["prime"]) not in inverse_exactness(load_record(name)).primes


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "three_rps"])
@pytest.mark.parametrize("says", [OF_THESE, AT_PLACES])
def test_less_than_they_do_is_not_claimed(name, says):
    document, text = drafted(name)
    with pytest.raises(RefusedError, match="is claimed, but they close the joint graph with any dimensions"):
        closes({**document, "exact": {**document["exact"], "says": says}}, text)


def test_other_dimensions_are_those_of_the_statement():
    document, text = drafted("zeng2019", l2=300.1, b=148.0)
    assert closes(document, text)["error"] < 1e-15
    with pytest.raises(RefusedError, match=r"is 148.0, and 150.0 in the mechanism file"):
        closes({**document, "statement": {**document["statement"], "parameters": {}}}, text)


def changed(document, change):
    other = copy.deepcopy(document)
    change(other)
    return other


OTHER = {"+": "-", "-": "+", "*": "/", "/": "*", "negative": "root", "root": "negative"}


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "gough_stewart"])
def test_every_operation_that_is_another_one_is_refused(name):
    """Joints, velocities and determinants need each operation that is looked at here."""
    document, text = drafted(name)
    operations = document["program"]["operations"]
    needed = {k for group in ("joints", "jp", "jq", "factors") for _, k in document["program"][group]}
    for k in range(len(operations) - 1, -1, -1):
        if k in needed and operations[k][0] in OTHER:
            needed.update(operations[k][1:])
    places = [k for k in sorted(needed) if operations[k][0] in OTHER]
    assert len(places) > 40
    for k in places[:: len(places) // 12]:

        def another(draft, k=k):
            draft["program"]["operations"][k][0] = OTHER[operations[k][0]]

        with pytest.raises(RefusedError, match="do not"):
            closes(changed(document, another), text)


CHANGES = {
    "two joints for one another": ("zeng2019", lambda d: swap(d["program"]["joints"], "B1 0", "D1 0")),
    "the sign of a sine": ("fivebar", lambda d: swap(d["program"]["joints"], "A1 0", "A1 1")),
    "a row of Jp": ("fivebar", lambda d: swap(d["program"]["jp"], "0,0", "1,0")),
    "an entry of Jq": ("fivebar", lambda d: swap(d["program"]["jq"], "0,0", "1,1")),
    "a factor left out": ("fivebar", lambda d: d["exact"]["serial"].pop()),
    "factors in another order": ("fivebar", lambda d: d["exact"]["serial"].reverse()),
    "a factor of the other kind": ("fivebar", lambda d: d["exact"]["parallel"].append(d["exact"]["serial"].pop())),
    "a joint left out": ("fivebar", lambda d: d["program"]["joints"].pop(0)),
    "a dimension's number": ("fivebar", lambda d: number(d, "l1", 100.5)),
    "the bounds of a dimension": ("fivebar", lambda d: number(d, "l1", 100.0, 101.0)),
    "a dimension taken for another": ("fivebar", lambda d: label(d, "l1", "l2")),
    "a dimension that nobody has": ("fivebar", lambda d: label(d, "l1", "l9")),
    "a coordinate taken for another": ("fivebar", lambda d: coordinates(d)),
    "a number that is close": ("fivebar", lambda d: number(d, "", 2.0 * (1 + 1e-9))),
}


def swap(pairs, first, second):
    names = [name for name, _ in pairs]
    i, j = names.index(first), names.index(second)
    pairs[i][1], pairs[j][1] = pairs[j][1], pairs[i][1]


def number(document, name, low, high=None):
    operation = next(o for o in document["program"]["operations"] if o[0] == "number" and o[3] == name)
    operation[1:3] = low.hex(), (low if high is None else high).hex()


def label(document, name, other):
    next(o for o in document["program"]["operations"] if o[0] == "number" and o[3] == name)[3] = other


def coordinates(document):
    for operation in document["program"]["operations"]:
        if operation[0] == "coordinate":
            operation[1] = {"x": "y", "y": "x"}[operation[1]]


@pytest.mark.parametrize("what", CHANGES)
def test_what_is_changed_in_the_formulas_is_refused(what):
    name, change = CHANGES[what]
    document, text = drafted(name)
    with pytest.raises(RefusedError):
        closes(changed(document, change), text)


FILES = {
    "an axis turned round": ("zeng2019", '["-d", "0", "0"],   axis = "-y"', '["-d", "0", "0"], axis = "y"'),
    "another axis": ("fivebar", 'axis = "z"', 'axis = ["0.0001", "0", "1"]'),
    "a point": ("zeng2019", 'at = ["0", "l2", "0"]', 'at = ["0", "l2 + 1e-9*l1", "0"]'),
    "a dimension": ("zeng2019", "value = 280", "value = 281"),
    "the platform's point": ("zeng2019", 'point   = ["0", "0", "0"]', 'point = ["0", "l1", "0"]'),
    "a joint of another type": ("three_rps", 'type = "spherical"', 'type = "universal", axes = ["x", "y"]'),
    "limbs at other angles": ("three_rps", 'count = 3', 'angles = ["0", "121 deg", "240 deg"]'),
    "other inputs": ("zeng2019", 'order = ["P1", "P2", "P3"]', 'order = ["P2", "P1", "P3"]'),
    "another mechanism": ("fivebar", None, "zeng2019"),
    "no mechanism": ("fivebar", None, None),
}  # fmt: skip


@pytest.mark.parametrize("what", FILES)
def test_a_file_that_is_not_the_certificates_is_refused(what):
    name, before, after = FILES[what]
    document, text = drafted(name)
    if before is None:
        other = drafted(after)[1] if after else "no = TOML ="
    else:
        assert before in text
        other = text.replace(before, after, 1)
    with pytest.raises(RefusedError):
        closes(document, other)


def test_a_form_of_special_dimensions_is_exact_with_these_alone(tmp_path, monkeypatch):
    """With both rods equally long in the file, a form that knows one of them alone; places refuse it, with others."""
    monkeypatch.setattr("assur.certificates.formulas.checked_form", closed_form_of)
    for path in BIGLIDE.parent.iterdir():
        if path.is_file():
            text = path.read_text(encoding="utf-8").replace("p.r2", "p.r1").replace('"r2*r2"', '"r1*r1"')

            (tmp_path / path.name).write_text(text, encoding="utf-8")
    document, text = drafted(tmp_path / "mechanism.toml")
    assert document["exact"]["says"] == OF_THESE
    assert closes(document, text)["error"] < 1e-15
    with pytest.raises(RefusedError, match="do not close the joint graph with any dimensions"):
        closes({**document, "exact": {**document["exact"], "says": EXACT}}, text)
    with pytest.raises(RefusedError, match="but they close the joint graph with the dimensions of the file"):
        closes({**document, "exact": {**document["exact"], "says": AT_PLACES}}, text)
