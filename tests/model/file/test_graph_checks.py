"""Chains and parallelograms are checked against the graph, never believed."""

from collections.abc import Callable
from importlib.resources import files

import pytest

from assur.errors import UsageError
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord

Read = Callable[[str], MechanismRecord]
Faults = Callable[[str], list[str]]

FOUR = """
[links]
ground = {}
left = {}
top = {}
right = {}
[joints]
A = { type = "TYPE", parent = "ground", child = "left", KEY, at = [0, 0, 7] }
B = { type = "TYPE", parent = "left", child = "top", KEY, at = [0, "b", 3] }
C = { type = "TYPE", parent = "top", child = "right", KEY, at = ["c", 0, 0], child_at = [0, "d", 0] }
D = { type = "TYPE", parent = "ground", child = "right", KEY, at = ["a", 0, 0] }
[generalised.Pa]
kind = "KIND"
joints = ["A", "B", "C", "D"]
stands_for = { parent = "ground", child = "top" }
[chains.only]
serial = ["Pa"]
[inputs]
"A.FIRST" = { name = "q" }
[home]
A = HOME
B = HOME
C = HOME
D = HOME
"""
TOP = """format = 1
name = "four"
unit = "mm"
angle = "deg"
base = "ground"
platform = { link = "top", pose = ["x", "y"] }
[parameters]
a = { value = 20 }
b = { value = 30 }
c = { value = 20 }
d = { value = 30 }
"""


def four(kind: str) -> str:
    joint, key, first, home = {
        "P(4R)": ("revolute", 'axis = "z"', "rotation", "0"),
        "P(4U)": ("universal", 'axes = ["z", "x"]', "first", "[0, 0]"),
        "P(4S)": ("spherical", 'meaning = "ball"', "rx", "[0, 0, 0]"),
    }[kind]
    text = TOP + FOUR
    for old, new in (("TYPE", joint), ("KEY", key), ("FIRST", first), ("HOME", home), ("KIND", kind)):
        text = text.replace(old, new)
    return text if kind == "P(4R)" else text.replace(", 7]", ", 0]").replace('"b", 3]', '"b", 0]')


@pytest.mark.parametrize("kind", ["P(4R)", "P(4U)", "P(4S)"])
def test_a_parallelogram_is_one_joint(read: Read, kind: str) -> None:
    record = read(four(kind))
    assert record.generalised["Pa"].joints == ("A", "B", "C", "D")
    assert (record.generalised["Pa"].parent, record.generalised["Pa"].child) == ("ground", "top")
    with pytest.raises(UsageError, match=r"no parallelogram: sides 30 on left and 31 on right"):
        with_parameters(record, d=31)
    assert with_parameters(record, b=31, d=31).values.b == 31


EQUAL = "allowed: opposite sides of equal length"
ONCE = "allowed: each joint in one chain, once"
CASES = [
    ("d = { value = 30 }", "d = { value = 31 }",
     [f"23: generalised.Pa: no parallelogram: sides 30 on left and 31 on right; {EQUAL}"]),
    ("c = { value = 20 }", "c = { value = 25 }",
     [f"23: generalised.Pa: no parallelogram: sides 25 on top and 20 on ground; {EQUAL}"]),
    ("a = { value = 20 }\nb = { value = 30 }\nc = { value = 20 }",
     'a = { value = 0, sign = "any" }\nb = { value = 30 }\nc = { value = 0, sign = "any" }',
     ["23: generalised.Pa: a side of length zero; allowed: four sides"]),
    ('child = "top", axis = "z"', 'child = "top", axis = [0, 1, 1]',
     ["23: generalised.Pa: the axes of A and B are not parallel; allowed: parallel axes",
      "23: generalised.Pa: the axes of B and C are not parallel; allowed: parallel axes"]),
    ('"A", "B", "C", "D"', '"A", "C", "B", "D"',
     ["25: generalised.Pa.joints: no loop of four links; allowed: four joints around one loop",
      "? give them in turn: each shares a link with the next, the last with the first"]),
    ('"A", "B", "C", "D"', '"A", "B", "C"', ["25: generalised.Pa.joints: a list of 3; allowed: at least 4"]),
    ('"A", "B", "C", "D"', '"A", "B", "C", "E"',
     ["25: generalised.Pa.joints[3]: unknown joint 'E'; there is: A, B, C, D"]),
    ('parent = "ground", child = "top" }\n[ch', 'parent = "ground", child = "left" }\n[ch',
     ["26: generalised.Pa.stands_for: ground and left; allowed: opposite links, left and right or ground and top"]),
    ('kind = "P(4R)"', 'kind = "P(4U)"',
     ["25: generalised.Pa.joints: A, B, C, D; allowed in P(4U): universal joints"]),
    ('kind = "P(4R)"', 'kind = "P(5R)"', ['24: generalised.Pa.kind: "P(5R)"; allowed: P(4R), P(4U), P(4S) or P(2US)',
                                          "? did you mean 'P(4R)' or 'P(4U)'?"]),
    ('serial = ["Pa"]', 'serial = ["A"]',
     ["28: chains.only.serial: ends at 'left'; allowed: from 'ground' to 'top'"]),
    ('serial = ["Pa"]', 'serial = ["A", "C"]',
     ["28: chains.only.serial[1]: 'C' does not meet 'left'; allowed: a joint of that link"]),
    ('serial = ["Pa"]', 'serial = ["Pb"]',
     ["28: chains.only.serial[0]: unknown joint 'Pb'; there is: A, B, C, D, Pa", "? did you mean 'Pa'?"]),
    ('serial = ["Pa"]', 'printed = "-"',
     ["27: chains.only: neither serial nor a loop; allowed: serial, or loop, output and tail"]),
    ('serial = ["Pa"]', 'serial = ["Pa"]\nloop = ["A", "B"]',
     ["27: chains.only: neither serial nor a loop; allowed: serial, or loop, output and tail"]),
    ('serial = ["Pa"]', 'loop = ["A", "B", "C"]\noutput = "left"\ntail = ["B"]',
     ["28: chains.only.loop: no closed loop through the base; allowed: joints in turn around one"]),
    ('serial = ["Pa"]', 'loop = ["A", "B", "C", "D"]\noutput = "rigth"\ntail = ["C"]',
     ["29: chains.only.output: unknown link 'rigth'; there is: ground, left, right, top", "? did you mean 'right'?"]),
    ('serial = ["Pa"]', 'loop = ["A", "B", "C", "D"]\noutput = "right"\ntail = ["D"]',
     ["30: chains.only.tail: ends at 'ground'; allowed: from 'right' to 'top'"]),
    ('serial = ["Pa"]', 'serial = ["Pa", "Pa", "Pa"]', [f"27: chains.only: '{name}' stands here twice; {ONCE}"
                                                        for name in "ABCD"]),
    ('serial = ["Pa"]', 'serial = ["Pa"]\n[chains.other]\nserial = ["A", "B"]',
     [f"29: chains.other: '{name}' stands here in the chain 'only' as well; the first one is in line 27; {ONCE}"
      for name in "AB"]),
    ('serial = ["Pa"]', 'serial = ["A", "B"]',
     [f"27: chains: no chain has C, D; {ONCE}",
      "? the chains together are the whole mechanism; without any they are found from the joints"]),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "expected"), CASES)
def test_a_fault_of_the_graph_is_told(faults: Faults, old: str, new: str, expected: list[str]) -> None:
    text = four("P(4R)")
    assert old in text
    wanted = [f"    hint: {line[2:]}" if line.startswith("? ") else f"f.toml:{line}" for line in expected]
    assert faults(text.replace(old, new, 1)) == wanted


@pytest.mark.parametrize("order", [["A", "B", "C", "D"], ["B", "A", "D", "C"], ["C", "B", "A", "D"]])
def test_a_loop_may_be_given_from_any_joint_in_either_sense(read: Read, order: list[str]) -> None:
    loop = ", ".join(f'"{name}"' for name in order)
    text = four("P(4R)").replace('serial = ["Pa"]', f'loop = [{loop}]\noutput = "top"')
    assert read(text).chains["only"].loop == tuple(order)


def test_the_chains_of_a_shipped_mechanism_are_walks_of_its_graph(faults: Faults) -> None:
    text = files("assur").joinpath("mechanisms/zeng2019/mechanism.toml").read_text(encoding="utf-8")
    assert 'tail  = ["D1", "D2"]' in text
    (found,) = faults(text.replace('tail  = ["D1", "D2"]', 'tail  = ["D2", "D1"]'))
    assert found.endswith("chains.HSOC1.tail[0]: 'D2' does not meet 'link11'; allowed: a joint of that link")
    (found,) = faults(text.replace('child_at = ["0", "l5/2", "0"]', 'child_at = ["0", "l5/3", "0"]'))
    assert "generalised.Pa1: no parallelogram: sides 90 on slider3 and 75 on linkS" not in found
    assert "generalised.Pa1: no parallelogram: sides 75 on linkS and 90 on slider3" in found
