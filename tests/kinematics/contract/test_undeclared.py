"""Radicands, divisors and margins that are not declared, or nothing else: refused by name and line, harm or no harm."""

import pytest

from assur.kinematics.contract.check import problems, unproved
from assur.kinematics.contract.exact import exactness
from assur.kinematics.contract.extent import AT_LOAD, IN_FULL
from assur.kinematics.contract.held import at_places
from assur.model.registry import CLOSED_FORM, load_record

ARM = "arm1 = sign.s1 * ns.sqrt(height1)"
WRONG = {
    "a divisor that vanishes on a line": (
        "biglide", ((ARM, f"{ARM} * ((y - 77) / (y - 77))"),), "divisor", "(y - 77)"),
    "a divisor that vanishes at a point": (
        "biglide",
        ((ARM, f"far = (x - 7) * (x - 7) + (y - 99) * (y - 99)\n    {ARM} * (far / far)"),), "divisor", "far / far"),
    "a radicand that is no margin": (
        "biglide", ((ARM, f"{ARM} + ns.sqrt(x + 100) - ns.sqrt(x + 100)"),), "radicand", "x + 100"),
    "a row of both Jacobians that vanishes": (
        "biglide",
        (("jp = ((core.arm1, core.y)", "jp = ((core.arm1 * (core.x - 30), core.y * (core.x - 30))"),
         ("jq = ((core.arm1, 0)", "jq = ((core.arm1 * (core.x - 30), 0)"),
         ('"gap": core.arm1 - core.arm2', '"gap": (core.arm1 - core.arm2) * (core.x - 30)'),
         ('"arm1": core.arm1,', '"arm1": core.arm1 * (core.x - 30),')),
        "factor gap", '"gap"'),
    "a divisor of a joint value": (
        "biglide", (('"S2": core.q2,', '"S2": core.q2 / (core.x - 11) * (core.x - 11),'),), "divisor", "return {"),
}  # fmt: skip


@pytest.mark.parametrize("what", WRONG)
def test_what_is_not_declared_and_does_harm_is_refused(copied, what):
    name, changes, told, line = WRONG[what]
    record = load_record(copied(name, *changes))
    found, _ = problems(record, IN_FULL)
    assert found
    assert found[0].path.startswith(told)
    text = (record.file.parent / CLOSED_FORM).read_text(encoding="utf-8").splitlines()
    assert line in text[found[0].line - 1]


def test_what_is_not_seen_to_be_harmless_is_refused(copied):
    """(x + 5 y)^2 + (x - 5 y)^2 + 1, written out: never zero, but no sum of squares as it stands."""
    written = "26 * x * x + 26 * y * y - 20 * x * y + 20 * x * y + 24 * (x * x + y * y) + 1"
    record = load_record(copied("biglide", (ARM, f"one = {written}\n    {ARM} * (one / one)")))
    (first,), _ = problems(record, AT_LOAD)
    assert first.path == "divisor"
    assert "nothing says that it is zero nowhere" in first.given
    assert "sum of squares" in first.hint


BUMP = "5/(1 + ({} - 10)*({} - 10)*1e20)".format
EXTRA = ('"height1": height1,', '"height1": height1, "extra": extra,')
DECLARED = ("inverse_margins=(", 'inverse_margins=(\n        Margin("extra", "1", "more", unit=0{}),')
FALSE_MARGINS = {
    "a bump in a radicand's margin": (
        "biglide", (('"height1": height1,', f'"height1": height1 - 1e6 * {BUMP("x", "x")},'),), "margin height1"),
    "a margin that is less than a float tells too small": (
        "biglide", (('"square": square}', '"square": square - 1e-12}'),), "margin square"),
    "a bump in a margin of a mechanism with dimensions by formulas": (
        "zeng2019", (('"M3": m3}', f'"M3": m3 - {BUMP("x", "x")}}}'),), "margin M3"),
    "a bump in a margin that a function returns": (
        "fivebar",
        (("return Branch(pose, (crank1, crank2), margins",
          f'margins["reach1"] = margins["reach1"] - 1e6 * {BUMP("x", "x")}\n'
          "    return Branch(pose, (crank1, crank2), margins"),), "margin reach1"),
    "a margin times what changes sign far away": (
        "orthoglide", (('[f"reach{i}"] = radicand', '[f"reach{i}"] = radicand * (1e6 + pose[0])'),), "margin reach1"),
    "a wall in a margin that degenerates": (
        "delta_4s", (('= x * x + z * z', '= (x * x + z * z) * (y - 77)'),), "margin distance1"),
    "a margin of a root that cancels": (
        "biglide", ((ARM, f"extra = 1 - {BUMP('x', 'x')}\n    {ARM} + 0 * ns.sqrt(extra)"), EXTRA,
                    (DECLARED[0], DECLARED[1].format(""))), "margin extra"),
    "a root parted into two": (
        "biglide",
        ((ARM, f"extra = 1 - {BUMP('x', 'x')}\n    arm1 = sign.s1 * ns.sqrt(height1 * extra) * ns.sqrt(extra) / extra"),
         ('"height1": height1,', '"height1": height1 * extra, "extra": extra, "wall": extra,'),
         (DECLARED[0], DECLARED[1].format(', signs=("s1",)')
          + 'Margin("wall", "1", "more", unit=0, zero="degenerate"),')), "margin extra"),
    "a root parted into a product of two": (
        "biglide",
        ((ARM, f"extra = 1 - {BUMP('x', 'x')}\n    arm1 = sign.s1 * ns.sqrt(height1 / extra) * ns.sqrt(extra)"),
         ('"height1": height1,', '"height1": height1 / extra, "extra": extra, "wall": extra,'),
         (DECLARED[0], DECLARED[1].format(', signs=("s1",)')
          + 'Margin("wall", "1", "more", unit=0, zero="degenerate"),')), "margin extra"),
}  # fmt: skip


@pytest.mark.parametrize("what", FALSE_MARGINS)
def test_a_margin_that_is_no_radicand_divisor_or_factor_is_refused_at_once(copied, what):
    name, changes, told = FALSE_MARGINS[what]
    record = load_record(copied(name, *changes))
    assert at_places(record, AT_LOAD) == []
    assert exactness(record).proved
    found, _ = problems(record, AT_LOAD)
    assert found[0].path == told
    assert found[0].line
    assert " is " in found[0].given
    assert "exactly" in found[0].allowed or "reduced" in found[0].allowed


RIGHT = {
    "a margin times a number and a dimension": (('"height1": height1,', '"height1": 3 * height1 * p.r1,'),),
    "a radicand times a dimension": ((ARM, "arm1 = sign.s1 * ns.sqrt(height1 * p.r1) / ns.sqrt(p.r1)"),),
    "a radicand over a square": (
        (
            "arm2 = sign.s2 * ns.sqrt(height2)",
            "far = 1 + x * x\n    arm2 = sign.s2 * far * ns.sqrt(height2 / far / far)",
        ),
    ),
    "a sum of squares": ((ARM, f"one = x * x + y * y + p.r1\n    {ARM} * (one / one)"),),
}


@pytest.mark.parametrize("what", RIGHT)
def test_what_is_a_positive_multiple_of_a_margin_is_declared(copied, what):
    assert problems(load_record(copied("biglide", *RIGHT[what])), IN_FULL) == ((), True)


SPLIT = (
    ("square = p.r1 * p.r1 - along * along",
     "square = p.r1 * p.r1 - along * along\n    half = ns.sqrt(square * p.{0}) * ns.sqrt(square / p.{0}) / square"),
    ("y = sign.e * ns.sqrt(square) *", "y = half * sign.e * ns.sqrt(square) *"),
)  # fmt: skip
SIGNED = 'spare = {{ value = {}, sign = "{}", meaning = "of no use" }}'


@pytest.mark.parametrize(
    ("value", "sign", "passes", "general"),
    [("260.53", "positive", True, True), ("3", "positive", True, True), ("260.53", "any", True, False),
     ("3", "any", True, False), ("-3", "any", False, False), ("-260.53", "any", False, False)],
)  # fmt: skip
def test_a_product_of_roots_is_right_where_both_exist_whatever_is_drawn(copied, value, sign, passes, general):
    """Where the sign of the dimension that they share is not said, the form holds with the dimensions of the file."""
    folder = copied("biglide", *((before, after.format("spare")) for before, after in SPLIT))
    path = folder / "mechanism.toml"
    text = path.read_text(encoding="utf-8")
    assert "[parameters]\n" in text
    path.write_text(text.replace("[parameters]\n", f"[parameters]\n{SIGNED.format(value, sign)}\n"), encoding="utf-8")
    found, any_dimensions = problems(load_record(folder), IN_FULL)
    assert (found == (), any_dimensions) == (passes, general)


def test_ends_of_a_reduced_model_are_told(copied):
    assert unproved(load_record(copied("h4_robot"))) == ("near",)
    assert unproved(load_record(copied("zeng2019"))) == ()
