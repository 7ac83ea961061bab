import pytest

from assur.verifier.program import Program
from hand_certificates import NO_JOINTS

ONE = (1.0).hex()
HALF = (0.5).hex()


def data(*operations, margins=(), factors=()):
    return {
        "operations": [["coordinate", "x"], ["number", HALF, ONE, "l"], *map(list, operations)],
        "margins": [["m", len(operations) + 1], *margins],
        "nonzero": [],
        "factors": list(factors),
        **NO_JOINTS,
    }


def value(*operations, box=(2, 3), strict=True):
    program = Program(data(*operations), ["x"])
    found = program.over(([box[0]], [box[1]]), program.margins, strict)
    return found and (float(found[0][0]), float(found[0][1]))


def test_every_operation():
    assert value(["+", 0, 1]) == (2.5, 4.0)
    assert value(["-", 0, 1]) == (1.0, 2.5)
    assert value(["*", 0, 1]) == (1.0, 3.0)
    assert value(["/", 0, 1]) == (2.0, 6.0)
    assert value(["negative", 0]) == (-3.0, -2.0)
    assert value(["magnitude", 0], box=(-2, 3)) == (0.0, 3.0)
    assert value(["root", 0], box=(4, 9)) == (2.0, 3.0)
    assert value(["*", 0, 0], box=(-2, 3)) == (0.0, 9.0)
    assert value(["cosine", 0], box=(3, 4))[0] == -1.0
    assert value(["sine", 0], box=(1, 2))[1] == 1.0


def test_what_has_no_value_proves_nothing():
    assert value(["/", 1, 0], box=(-1, 1)) is None
    assert value(["/", 1, 0], box=(-1, 1), strict=False) is None
    assert value(["/", 1, 0], box=(0, 1)) is None
    assert value(["root", 0], box=(-1, 4)) is None
    assert value(["root", 0], box=(-1, 4), strict=False) == (0.0, 2.0)


def test_only_what_is_wanted_is_worked_out():
    program = Program(data(["/", 1, 0], ["+", 0, 1]), ["x"])
    assert [float(v) for v in program.over(([-1], [1]), [3])[0]] == [-0.5, 2.0]


@pytest.mark.parametrize(
    "operation",
    [
        ["+", 0],
        ["+", 0, 1, 1],
        ["+", 0, 2],
        ["+", 0, -1],
        ["+", 0, 1.0],
        ["+", 0, True],
        ["+", "0", 1],
        ["root"],
        ["root", 0, 1],
        ["power", 0, 1],
        ["varying"],
        [],
        [["+"], 0, 1],
        ["number", ONE, HALF, "reversed"],
        ["number", ONE, "inf", ""],
        ["number", "nan", "nan", ""],
        ["number", "1.5", "1.5", ""],
        ["number", "0x1p+0", "0x1p+0", ""],
        ["number", 1.0, 1.0, ""],
        ["number", "0x1p+99999", "0x1p+99999", ""],
        ["number", ONE, ONE],
        ["coordinate", "y"],
        ["coordinate"],
        ["coordinate", "x", "x"],
    ],
)
def test_what_is_no_operation_is_refused(operation):
    with pytest.raises((ValueError, TypeError, OverflowError)):
        Program(data(operation), ["x"])


@pytest.mark.parametrize("output", [["m", 1], ["n", 2], ["n", -1], ["n", True], ["n", 1.0], ["n"], ["n", 1, 1], [1, 1]])
def test_what_is_no_output_is_refused(output):
    with pytest.raises((ValueError, TypeError)):
        Program(data(margins=[output]), ["x"])
