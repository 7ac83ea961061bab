"""A kernel that answers in another shape than its mechanism asks for is told with the line of its function."""

import shutil
from pathlib import Path

import pytest

import assur
from assur.errors import MechanismFileError
from assur.model.closed_form_answers import answer_faults
from assur.model.registry import load_record, names

HOME = Path(assur.__file__).parent / "mechanisms/fivebar"
FIRST = "return Branch(pose, (crank1, crank2), margins,"


@pytest.mark.parametrize("name", [name for name in names() if load_record(name).closed_form])
def test_every_built_in_kernel_answers_in_the_shape_of_its_mechanism(name):
    record = load_record(name)
    assert answer_faults(record, record.closed_form, record.folder / "closed_form.py") == ()


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (f"    {FIRST}", "    return 3\n" + f"    {FIRST}", "inverse returns a number; allowed: a Branch"),
        ('"reach2": reach2}', "}", "inverse returns no margin 'reach2'"),
        ('{"distance1": square1', '{"distance1": (square1, 1)', "a margin 'distance1' that is a tuple"),
        (
            FIRST,
            "return Branch(pose, (crank1,), margins,",
            "inputs of 1 entries; allowed: one for each of theta1, theta2",
        ),
        (FIRST, "return Branch(pose, (crank1[0], crank2), margins,", "theta1 is a number; allowed: a pair"),
        (FIRST, "return Branch((crank1, 1), (crank1, crank2), margins,", "pose in which x is a tuple"),
        ("_core(p, pose, crank1, crank2))\n\n\ndef _leg", "1)\n\n\ndef _leg", "a core that is a number"),
        ('        "A1": core.crank1,\n', "", "joints returns no value of 'A1'"),
        ('"A1": core.crank1', '"A1": "a"', "joints returns 'A1' as a text"),
        ('        "arm2": p.l1 * core.sin_b2,\n', "", "factors returns no factor 'arm2'"),
        (
            "return (core.rod1, core.rod2), (",
            "return (core.rod1,), (",
            "Jp of another shape; allowed: 2 rows of 2 numbers",
        ),
        ('{"rod1": core.rod1', '{"rodX": core.rod1', "quantities returns no quantity 'rod1'"),
        ('{"rod1": core.rod1', '{"rod1": 1', "'rod1' as a number"),
        ('Sign("sin_rods", "1")', 'Sign("nothing", "1")', "a core without 'nothing', of which 'e' is the sign"),
        ("    crank1, crank2 = inputs\n", "    crank1, crank2 = inputs\n    return None\n", "direct returns None"),
        ("def direct(ns, p, inputs, sign):", "def direct(ns, p, inputs):", "the name 'sign'"),
        ("sign.e *", "sign.q *", "no 'q' there; allowed: there is: e"),
        ("p.l2 * p.l2 - square\n", "p.l9 * p.l2 - square\n", "no 'l9' there; allowed: there is: g, l1, l2"),
    ],
)
def test_a_slip_of_the_pen_is_a_fault_with_a_line(old, new, told, tmp_path):
    folder = tmp_path / "own"
    shutil.copytree(HOME, folder)
    text = (folder / "closed_form.py").read_text(encoding="utf-8")
    assert old in text
    (folder / "closed_form.py").write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(MechanismFileError) as caught:
        load_record(folder)
    assert any(told in str(problem) for problem in caught.value.problems), caught.value
    assert all(problem.line for problem in caught.value.problems)
