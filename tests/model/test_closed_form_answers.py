"""A kernel that answers in another shape than its mechanism asks for is told with the line of its function."""

import os
import shutil
from pathlib import Path

import pytest

import assur
from assur.errors import MechanismFileError, UsageError
from assur.model.closed_form_answers import answer_faults
from assur.model.examination import examine
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
        ('"A1": core.crank1', '"A9": 1, "A1": core.crank1', "joints returns a value of 'A9', which is no joint"),
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


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (
            'unit=4, signs=("s1",)',
            'unit=4, signs=("s9",)',
            "the sign 's9' of inverse margin reach1; signs of modes.working",
        ),
        (
            'unit=4, signs=("s1",)',
            'unit=4, signs=("e",)',
            "the sign 'e' of inverse margin reach1; signs of modes.working",
        ),
        ('Factor("gap_y"', 'Factor("gap_x"', "factor_list: 'gap_x' 2 times; each name once"),
        ('Margin("gap"', f'Margin("{"g" * 101}"', "has 101 characters; 1 to 100"),
        ("# crank", "# \u202e crank", r"closed_form.py:6: \u202e, a character that nobody sees"),
    ],
)
def test_a_slip_in_what_is_declared_is_a_fault(old, new, told, tmp_path):
    folder = tmp_path / "own"
    shutil.copytree(HOME, folder)
    path = folder / "closed_form.py"
    text = path.read_text(encoding="utf-8").replace("\n\n\ndef inverse", "\n# crank\n\ndef inverse", 1)
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(MechanismFileError) as caught:
        load_record(folder)
    assert any(told in str(problem) for problem in caught.value.problems), caught.value


@pytest.mark.parametrize("kind", ["pipe", "folder", "device", "link to itself"])
def test_a_closed_form_that_is_no_file_is_told(kind, tmp_path):
    folder = tmp_path / "own"
    shutil.copytree(HOME, folder)
    path = folder / "closed_form.py"
    path.unlink()
    {
        "pipe": lambda: os.mkfifo(path),
        "folder": path.mkdir,
        "device": lambda: path.symlink_to("/dev/zero"),
        "link to itself": lambda: path.symlink_to(path),
    }[kind]()
    with pytest.raises(UsageError, match=r"cannot read '.*closed_form\.py'"):
        load_record(folder)
    with pytest.raises(UsageError, match=r"cannot read '.*closed_form\.py'"):
        examine(folder)


def lengthened(folder, times):
    """A copy of the built-in folder whose closed form goes through a long chain of sums; its numbers stay."""
    shutil.copytree(HOME, folder)
    path, first = folder / "closed_form.py", "    square = dx * dx + dy * dy\n"
    text = path.read_text(encoding="utf-8")
    assert text.count(first) == 1
    chain = f"    extra = dx\n    for k in range({times}):\n        extra = extra * 0.5 + dy\n"
    path.write_text(text.replace(first, f"{first}{chain}    square = square + 1e-30 * extra\n"), encoding="utf-8")
    return folder


def test_kernels_that_would_take_memory_by_the_square_of_their_length_are_refused(tmp_path):
    with pytest.raises(MechanismFileError, match=r"\d+ different operations on numbers .*allowed: 8000"):
        load_record(lengthened(tmp_path / "long", 1999))
    assert load_record(lengthened(tmp_path / "shorter", 1500)).closed_form


def test_a_long_chain_of_operations_is_no_deep_recursion(tmp_path):
    from assur.kinematics.contract.algebra import Algebra
    from assur.kinematics.contract.kernel import recorded

    record = load_record(lengthened(tmp_path / "chain", 1500))
    algebra = Algebra(recorded(record, "inverse"))
    assert {algebra.least(k) for k in reversed(range(len(algebra.operations)))} == {
        "positive",
        "zero or more",
        "anything",
    }
