"""Wrong closed forms of many kinds, on four mechanisms: each is refused on its first use, by name and with its line."""

from dataclasses import dataclass

import pytest

from assur import load
from assur.errors import MechanismFileError
from assur.kinematics.contract.check import problems
from assur.model.registry import CLOSED_FORM, load_record


@dataclass(frozen=True)
class Wrong:
    """What is exchanged in a closed form; what the first problem names, and part of the line at which it is told."""

    name: str
    what: str
    before: str
    after: str
    told: str
    line: str


ZENG = [
    Wrong("zeng2019", "a radicand", "m3 = p.l6 * p.l6 - v * v", "m3 = 1.2 * p.l6 * p.l6 - v * v", "margin M3",
          "m3 = 1.2"),
    Wrong("zeng2019", "factors that never vanish", '"w": core.w,\n        "v": core.v,',
          '"w": core.w * core.w + 1,\n        "v": core.v * core.v + 1,', "factor w", '"w": core.w'),
    Wrong("zeng2019", "a mode sign reversed", "half = e3 * ns.sqrt(meeting)", "half = -e3 * ns.sqrt(meeting)",
          "mode sign e3", "sign.e3"),
    Wrong("zeng2019", "a mode sign of the wrong quantity", '"e3": Sign("sin_beta_minus_alpha", "1")',
          '"e3": Sign("sin_alpha", "1")', "mode sign e3", 'Sign("sin_alpha"'),
    Wrong("zeng2019", "the sign of a joint value", '"D1": alpha, "D2": _back(alpha)', '"D1": alpha, "D2": alpha',
          "joint D2", '"D2": alpha'),
    Wrong("zeng2019", "inputs exchanged", "inputs = (y + p.l3 / 2 - u1, y - p.l3 / 2 - u2, y - u3)",
          "inputs = (y - p.l3 / 2 - u2, y + p.l3 / 2 - u1, y - u3)", "branch", "def inverse"),
    Wrong("zeng2019", "a row of Jq", "(sa * u1, 0, 0), (0, 0, sb * u3))", "(sa * u1, 0, 0), (0, 0, cb * u3))",
          "Jp and Jq row 3", "def jacobians"),
    Wrong("zeng2019", "a scale that is wrong away from home", "cos_alpha = (x + p.b - p.d) / p.l4",
          "cos_alpha = (x + p.b - p.d + 1e-6 * (x + 15.4714) * x / p.b) / p.l4", "", ""),
    Wrong("zeng2019", "a margin that is never negative", '"M3": m3}', '"M3": m3 * m3}', "margin M3", '"M3": m3 * m3}'),
    Wrong("zeng2019", "a margin that is too strict", '"M3": m3}', '"M3": m3 - 1000}', "margin M3", '"M3": m3 - 1000}'),
    Wrong("zeng2019", "a branch that is missing", "u3 = sign.u3 * ns.sqrt(m3)", "u3 = ns.sqrt(m3)", "mode sign u3",
          '"u3"'),
    Wrong("zeng2019", "a parameter that equals another", "- p.l6 * sin_beta - p.l7 - p.l1",
          "- p.l6 * sin_beta - p.l8 - p.l1", "margin M3", "m3 = "),
    Wrong("zeng2019", "a factor that is missing", '"u3", "serial"', '"u3", "other"', "factor", "def factors"),
]  # fmt: skip
FIVEBAR = [
    Wrong("fivebar", "the order of branches", "across = sign * ns.sqrt(reach)", "across = -sign * ns.sqrt(reach)",
          "mode sign s1", "sign.s1"),
    Wrong("fivebar", "a factor too many", '"gap_x", "other"', '"gap_x", "parallel"', "factor", ""),
    Wrong("fivebar", "a radicand in a quotient", "meeting = 4 * p.l2 * p.l2 - square",
          "meeting = 4.1 * p.l2 * p.l2 - square", "", "meeting"),
    Wrong("fivebar", "rows of Jp exchanged", "return (core.rod1, core.rod2), (", "return (core.rod2, core.rod1), (",
          "Jp and Jq row", "def jacobians"),
    Wrong("fivebar", "the sine of an input",
          "return ((along * dx + across * dy) / denominator, (along * dy - across * dx)",
          "return ((along * dx + across * dy) / denominator, -(along * dy - across * dx)", "", ""),
]  # fmt: skip
DELTA = [
    Wrong("delta_4s", "a wrong factor", '"volume": core.volume,', '"volume": core.volume * core.volume + 1,',
          "factor volume", '"volume"'),
    Wrong("delta_4s", "a joint that is not turned back", "upper, lower = product(back, tilt), transposed(tilt)",
          "upper, lower = product(back, tilt), tilt", "branch", "def inverse"),
    Wrong("delta_4s", "the branch of the direct problem", "(p.l * p.l,) * 3, -sign.e)", "(p.l * p.l,) * 3, sign.e)",
          "mode sign e", "sign.e"),
    Wrong("delta_4s", "another length", "2 * p.L * x, -2 * p.L * z, square + p.L * p.L - p.l * p.l",
          "2 * p.L * x, -2 * p.L * z, square + p.L * p.L - 1.01 * p.l * p.l", "", ""),
]  # fmt: skip
BIGLIDE = [
    Wrong("biglide", "a parameter that equals another", "height2 = p.r2 * p.r2 - y * y",
          "height2 = p.r1 * p.r1 - y * y", "margin height2", "height2 = p.r1"),
    Wrong("biglide", "a parameter that equals another, in the direct problem", "p.r1 * p.r1 - p.r2 * p.r2) /",
          "p.r1 * p.r1 - p.r1 * p.r1) /", "", ""),
    Wrong("biglide", "the ends of a mode exchanged", "arm1 = sign.s1 *", "arm1 = -sign.s1 *", "mode sign s1",
          "sign.s1"),
    Wrong("biglide", "half of the poses", "y = sign.e * ns.sqrt(square) * (gap / ns.sqrt(gap * gap))",
          "y = sign.e * ns.sqrt(square)", "mode sign e", "sign.e"),
    Wrong("biglide", "the sign of a Jacobian", "jq = ((core.arm1, 0), (0, core.arm2))",
          "jq = ((core.arm1, 0), (0, -core.arm2))", "Jp and Jq row 2", "def jacobians"),
    Wrong("biglide", "a scale that is far too large", 'Factor("gap", "parallel", "r1"',
          'Factor("gap", "parallel", "1e9 * r1"', "status gap", 'Factor("gap"'),
    Wrong("biglide", "a singularity of constraints that is none", "    factor_list=(",
          '    constraint_singular=(("arm1",),),\n    factor_list=(', "status arm1", 'Factor("arm1"'),
    Wrong("biglide", "a relation that its dimensions do not have", "    factor_list=(",
          '    relations=("r1 = r2 + 1",),\n    factor_list=(', "relation r1 = r2 + 1", "relations="),
    Wrong("biglide", "a relation of what is no dimension", "    factor_list=(",
          '    relations=("r1 = r3",),\n    factor_list=(', "relation r1 = r3", "relations="),
    Wrong("biglide", "a self-motion that is none", "    factor_list=(",
          '    self_motion_singular=(("y",),),\n    factor_list=(', "status y", 'Factor("y"'),
    Wrong("biglide", "a reach that is too short", '"square": square}', '"square": square - 900}', "margin square",
          '"square": square - 900'),
]  # fmt: skip
EVERY = [*ZENG, *FIVEBAR, *DELTA, *BIGLIDE]


@pytest.mark.parametrize("wrong", EVERY, ids=lambda wrong: f"{wrong.name}: {wrong.what}")
def test_a_wrong_form_is_refused_by_name_and_line(copied, wrong):
    folder = copied(wrong.name, (wrong.before, wrong.after))
    found, _ = problems(load_record(folder))
    assert found, "nothing was noticed"
    first = found[0]
    assert first.path.startswith(wrong.told)
    assert first.file == str(folder / CLOSED_FORM)
    assert first.line is not None
    assert wrong.line in (folder / CLOSED_FORM).read_text(encoding="utf-8").splitlines()[first.line - 1]


def test_inputs_without_measure_are_a_fault_of_the_form(copied):
    height = "height1 = p.r1 * p.r1 - y * y"
    folder = copied("biglide", (height, height + "\n    " + "\n    ".join(["x = x**16"] * 40)))
    found, _ = problems(load_record(folder))
    assert found


def test_loading_a_wrong_form_says_where_and_by_how_much(copied):
    folder = copied("zeng2019", (ZENG[0].before, ZENG[0].after))
    with pytest.raises(MechanismFileError, match=r"closed_form\.py:26: margin M3: .* at x = .* mm: a gap of \d+"):
        load(folder)


def test_a_dimension_that_is_at_fault_is_named(copied):
    wrong = next(item for item in ZENG if item.what == "a parameter that equals another")
    with pytest.raises(MechanismFileError, match=r"\(with l[78] = "):
        load(copied("zeng2019", (wrong.before, wrong.after)))
