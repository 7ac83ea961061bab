"""Closed forms in exact arithmetic: what is wrong only between the places that are looked at, and what is right."""

import numpy as np
import pytest

from assur.kinematics.contract.check import problems
from assur.kinematics.contract.exact import Trial, exactness
from assur.kinematics.contract.extent import AT_LOAD
from assur.kinematics.contract.held import at_places
from assur.model.registry import load_record
from catalogue import REPRESENTATIVES, each

BUMP = "5/(1 + ({} - 10)*({} - 10)*1e20)"
HEIGHT = "w = z - p.l4 * sin_alpha - p.l1"
IN_X, IN_CORE = BUMP.format("x", "x"), BUMP.format("core.x", "core.x")
WRONG = {
    "a bump in an input": (
        "fivebar",
        "return Branch(pose, (crank1, crank2), margins",
        f"crank1 = (crank1[0] + {IN_X}, crank1[1])\n    return Branch(pose, (crank1, crank2), margins",
        "joint A1",
    ),
    "a bump in a rail": (
        "zeng2019",
        "inputs = (y + p.l3 / 2 - u1,",
        f"inputs = (y + p.l3 / 2 - u1 + {IN_X},",
        "branch",
    ),
    "a magnitude": ("zeng2019", HEIGHT, f"far = x - 1e6\n    {HEIGHT} + far + ns.sqrt(far*far)", "branch"),
    "a magnitude of three roots": (
        "zeng2019",
        HEIGHT,
        f"far = 1e6 - z\n    {HEIGHT} + ns.sqrt(far)*ns.sqrt(y + far) - ns.sqrt(far*(y + far))",
        "branch",
    ),
    "a bump in a joint": ("zeng2019", '"P1": core.y', f'"P1": core.y + {IN_CORE}', "branch"),
    "a bump in Jp": (
        "fivebar",
        "return (core.rod1, core.rod2)",
        f"return ((core.rod1[0] + {IN_CORE}, core.rod1[1]), core.rod2)",
        "Jp",
    ),
    "a bump in a factor": (
        "fivebar",
        '"arm1": p.l1 * core.sin_b1,',
        f'"arm1": p.l1 * core.sin_b1 + {IN_CORE},',
        "factor",
    ),
    "a bump in the direct problem": (
        "fivebar",
        "height = sign.e * ns.sqrt(meeting / square) / 2",
        f"x = crank1[0]*100\n    height = sign.e * ns.sqrt(meeting / square) / 2 + {IN_X}",
        "joint",
    ),
    "a system": ("gough_stewart", "+ 2 * dot(b, on_platform)", "+ dot(b, on_platform)", "branch"),
    "an eliminant": (
        "planar_3rrr",
        "return triangles.polynomial(_elbows(ns, p, inputs),",
        "turned = tuple((c + 1/(1 + s*s*1e20), s) for c, s in inputs)\n"
        "    return triangles.polynomial(_elbows(ns, p, turned),",
        "branch",
    ),
}


@pytest.mark.parametrize("name", [*each(quick=(*REPRESENTATIVES, "fivebar")), "biglide"])
def test_a_right_form_is_exact_with_any_dimensions(copied, name):
    """With every prime; that every built-in form passes with one is a test of the check."""
    found = exactness(load_record(copied(name)))
    assert (found.mismatches, found.undecided, found.general) == ((), "", True)
    assert found.error < 1e-15
    assert len(set(found.primes)) == len(found.primes) > 0
    assert min(found.primes) > 2**160
    assert found.places > 0
    assert found.degree > 0


@pytest.mark.parametrize("what", WRONG)
def test_what_is_wrong_between_the_places_is_refused(copied, what):
    name, before, after, part = WRONG[what]
    (found,) = exactness(load_record(copied(name, (before, after)))).mismatches
    assert found.title.startswith(part)


def test_a_bump_passes_at_the_places_and_is_refused_for_all_that(copied):
    name, before, after, _ = WRONG["a bump in a rail"]
    record = load_record(copied(name, (before, after)))
    assert at_places(record, AT_LOAD) == []
    found, _ = problems(record)
    assert "in exact arithmetic" in found[0].given
    assert found[0].line


def test_a_form_of_special_dimensions_says_so(copied):
    """With both rods equally long in the file, a form that knows one of them alone."""
    found = exactness(load_record(copied("biglide", ("p.r2", "p.r1"), ('"r2*r2"', '"r1*r1"'))))
    assert found.proved
    assert not found.general


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "three_rps", "orthoglide"])
@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.deep) for seed in range(1, 5))])
def test_other_primes_say_the_same(name, seed):
    for problem in ("inverse", "direct") if name in ("fivebar", "zeng2019", "orthoglide") else ("inverse",):
        trial = Trial(load_record(name), problem, True, np.random.default_rng(seed))
        assert trial.mismatch() is None
        assert trial.error < 1e-15 or trial.draws.tied or trial.places < 8  # then others are drawn


TEMPLATE = {
    'about = "z", count = 3': 'about = [0, 0, "sqrt(2)"], angles = [30, "5*pi/6", "270 deg"]',
    'axis = "-y"': 'axis = ["-1/2", "-sqrt(3)/2", 0]',
    '[0, "-w/2", 0]': '["-w/4", "-w*sqrt(3)/4", 0]',
    '[0, "w/2", 0]': '["w/4", "w*sqrt(3)/4", 0]',
} | {f'["{size}", 0, 0]': f'["{size}*cos(30 deg)", "-{size}*sin(pi/6)", 0]' for size in "rabc"}
"""A template that is written 30 degrees back, in limbs that are turned by as much more: the same mechanism."""


@pytest.mark.parametrize("slip", ["", "sqrt(3)/2"])
def test_axes_places_and_angles_keep_their_formulas(copied, slip):
    path = copied("tsai_platform") / "mechanism.toml"
    text = path.read_text()
    for old, new in TEMPLATE.items():
        assert old in text
        text = text.replace(old, new)
    path.write_text(text.replace(slip, "0.866025403784") if slip else text)
    assert exactness(load_record(path)).proved == (not slip)
