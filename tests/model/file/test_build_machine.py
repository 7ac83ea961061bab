"""Tables of the machine: what they become, and every fault of theirs at its line."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from assur.model.machine_data import Gear, Tolerance
from assur.model.mechanism import MechanismRecord

Read = Callable[[str], MechanismRecord]
Faults = Callable[[str], list[str]]
MACHINE = """
[materials]
steel = { density = 7850, E = 210e9, nu = 0.3 }
[profiles]
bar = { round = 0.02 }
flat = { box = [0.03, 0.01], up = "z" }
[gravity]
direction = [0, -3, 0]
[payload]
mass = 2
centre = [0, "l1", 0]
[actuators]
A = { stiffness = 1e7, force = 60, speed = 1, rotor = 0.1, friction = { coulomb = 5, viscous = 20 }, GEAR }
[tolerances]
l1 = 0.3
l3 = { sigma = 0.1 }
tilt = { bound = 1, sigma = 0.1 }
[clearances]
R2 = 0.01
[compliances]
R2 = [1e-8, 1e-8, 1e-8, 1e-6, 1e-6, 0]
C = [
  [1e-8, 0, 0, 0, 0, 5e-8],
  [0, 0, 0, 0, 0, 0],
  [0, 0, 1e-8, 0, 0, 0],
  [0, 0, 0, 0, 0, 0],
  [0, 0, 0, 0, 1e-6, 0],
  [5e-8, 0, 0, 0, 0, 1e-6],
]
"""
LINK = "compliance = [1e-8, 2e-8, 3e-8, 1e-6, 2e-6, 3e-6]"
GEAR = "gear = { ratio = -30, stiffness = 1e6, rotor = 2e-4 }"


@pytest.fixture(scope="module")
def machine(fourbar: str) -> str:
    bar = 'crank = { profile = "bar", material = "steel", bars = [["A", "R2"]] }'
    return fourbar.replace("crank = {}", bar).replace("coupler = {}", f"coupler = {{ {LINK} }}") + MACHINE.replace(
        "GEAR", GEAR
    )


def test_a_file_becomes_data(machine: str, read: Read) -> None:
    data = read(machine).machine
    link, actuator = data.links["crank"], data.actuators["A"]
    assert (link.profile, link.material, link.bars, link.rigid) == ("bar", "steel", (("A", "B"),), False)
    assert list(data.links) == ["crank", "coupler"]
    np.testing.assert_array_equal(data.links["coupler"].compliance, np.diag([1e-8, 2e-8, 3e-8, 1e-6, 2e-6, 3e-6]))
    assert actuator.gear == Gear(-30.0, 1e6, 2e-4)
    assert actuator.inertia == pytest.approx(0.1 + 900 * 2e-4)
    assert list(data.compliances) == ["B", "C"]
    np.testing.assert_array_equal(data.compliances["C"][5], [5e-8, 0, 0, 0, 0, 1e-6])
    assert (actuator.stiffness, actuator.force, actuator.coulomb, actuator.viscous) == (1e7, 60.0, 5.0, 20.0)
    np.testing.assert_allclose(data.gravity.direction * data.gravity.value, [0.0, -9.81, 0.0])
    assert data.payload is not None
    np.testing.assert_allclose(data.payload.centre, [0.0, 40.0, 0.0])
    assert data.tolerances["l1"] == Tolerance(0.3, pytest.approx(0.1))
    assert data.tolerances["l3"] == Tolerance(pytest.approx(0.3), 0.1)
    assert data.tolerances["tilt"].bound == pytest.approx(np.pi / 180)  # an angle of a file in degrees
    assert data.clearances == {"B": 0.01}


def test_without_tables_there_is_gravity_and_nothing_else(fourbar: str, read: Read) -> None:
    data = read(fourbar).machine
    assert (data.links, data.payload, data.actuators, data.gravity.value) == ({}, None, {}, 9.81)


ROWS = "allowed: six numbers, which are its diagonal, or six rows of six"
NO_COMPLIANCE = "allowed: a symmetric matrix without negative eigenvalues, displacement before rotation"
CASES = [
    ("mass = 2\n", "mass = -2\n", ["payload.mass: -2; allowed: zero or a positive number"]),
    ("mass = 2\n", "", ["payload.mass: missing; this key must be there: a mass in kg",
                        "payload.centre: centre without mass; allowed beside a mass", "hint: add mass, in kg"]),
    ("mass = 2\n", "mass = 2\ninertia = [1, 1, 3, 0, 0, 0]\n",
     ["payload.inertia: principal moments 1, 1, 3; allowed: none negative, and none larger than the sum of the two "
      "others", "hint: the order is xx, yy, zz, xy, xz, yz"]),
    ("mass = 2\n", "mass = 2\ninertia = [1, 1, 1, 2, 0, 0]\n",
     ["payload.inertia: principal moments -1, 1, 3; allowed: none negative, and none larger than the sum of the two "
      "others", "hint: the order is xx, yy, zz, xy, xz, yz"]),
    ('profile = "bar"', 'profile = "bra"',
     ["links.crank.profile: unknown profile 'bra'; there is: bar, flat", "hint: did you mean 'bar'?"]),
    (', material = "steel"', "",
     ["links.crank.profile: a profile without material; allowed: material = beside it, or kg_per_m"]),
    ('["A", "R2"]', '["A", "D"]', ["links.crank.bars[0]: 'D' is no joint of crank; allowed: a joint of crank"]),
    ('["A", "R2"]', '["A", "A"]', ["links.crank.bars[0]: A twice; allowed: two joints"]),
    ("round = 0.02", "round = 0", ["profiles.bar.round: 0; allowed: a positive number"]),
    ("round = 0.02", "tube = [0.02, 0.03]",
     ["profiles.bar.tube: an inner diameter of 0.03; allowed: less than the outer, 0.02"]),
    ("round = 0.02", "round = 0.02, A = 1", ["profiles.bar: round and A; allowed: one of round, tube, box, or A"]),
    ("round = 0.02", "A = 1, J = 1", ["profiles.bar: lacks Iy, Iz; allowed: A, Iy, Iz, J together"]),
    ("round = 0.02", "box = [1, 2]",
     ["links.crank.profile: 'bar' without up; allowed: up = \"z\", or another direction"]),
    ("density = 7850", "density = -1", ["materials.steel.density: -1; allowed: a positive number"]),
    ("nu = 0.3", "nu = 0.5", ["materials.steel.nu: 0.5; allowed: a number between -1 and 0.5"]),
    ("A = { stiffness", "B = { stiffness",
     ["actuators.B: unknown driven joint 'B'; there is: A, A.rotation"]),
    ("force = 60", "force = 0", ["actuators.A.force: 0; allowed: a positive number"]),
    ("l1 = 0.3", "l9 = 0.3",
     ["tolerances.l9: unknown size 'l9'; there is: g, l1, l2, l3, theta, tilt", "hint: did you mean 'l3' or 'l2'?"]),
    ("l1 = 0.3", "l1 = {}", ["tolerances.l1: nothing; allowed: a bound, or { sigma = 0.02 }"]),
    ("R2 = 0.01", "R3 = 0.01",
     ["clearances.R3: unknown joint 'R3'; there is: A, B, C, D, R2", "hint: did you mean 'R2'?"]),
    ("ratio = -30, ", "", ["actuators.A.gear.ratio: missing; this key must be there"]),
    ("ratio = -30", "ratio = 0", ["actuators.A.gear.ratio: 0; allowed: a number that is not zero"]),
    ("rotor = 2e-4", "rotor = -1", ["actuators.A.gear.rotor: -1; allowed: zero or a positive number"]),
    (LINK, 'compliance = "soft"', [f'links.coupler.compliance: "soft"; {ROWS}']),
    (LINK, "compliance = [1e-8, 1e-8]", [f"links.coupler.compliance: a list of 2, [1e-08, 1e-08]; {ROWS}"]),
    (LINK, 'compliance = [1, 1, 1, 1, 1, "1"]', ['links.coupler.compliance: "1"; allowed: a number, in SI units']),
    (LINK, "compliance = [1, 1, 1, 1, 1, -1]", [f"links.coupler.compliance: -1 along rz; {NO_COMPLIANCE}"]),
    (LINK, "compliance = [1, 0, 1, 0, 1, 1]",
     ["links.coupler.compliance: nothing gives way along y, rx; allowed: a positive definite matrix",
      "hint: what is rigid but in some ways: [compliances] of the joint at its end may be zero along others"]),
    (LINK, f'{LINK}, bars = [["R2", "C"], ["C", "R2"]]',
     ["links.coupler.bars: 2 pairs beside a compliance; allowed: one pair, the joint that is held and the joint that "
      "gives way"]),
    ("1e-6, 1e-6, 0]", "1e-6, 1e-6]", [f"compliances.R2: a list of 5, [1e-08, 1e-08, 1e-08, 1e-06, 1e-06]; {ROWS}"]),
    ("  [0, 0, 1e-8, 0, 0, 0],", "  [0, 0, 1e-8],", [f"compliances.C: row 3: a list of 3, [0, 0, 1e-08]; {ROWS}"]),
    ("  [1e-8, 0, 0, 0, 0, 5e-8],", "  [1e-8, 0, 0, 0, 0, 4e-8],",
     [f"compliances.C: 4e-08 in row 1, column 6, 5e-08 across; {NO_COMPLIANCE}"]),
    ("  [0, 0, 1e-8, 0, 0, 0],\n  [0, 0, 0, 0, 0, 0],", "  [0, 0, 1e-8, 1e-9, 0, 0],\n  [0, 0, 1e-9, 0, 0, 0],",
     [f"compliances.C: a load that does negative work; {NO_COMPLIANCE}"]),
    ("R2 = [1e-8", "R3 = [1e-8",
     ["compliances.R3: unknown joint 'R3'; there is: A, B, C, D, R2", "hint: did you mean 'R2'?"]),
    ("stiffness = 1e7", 'stiffness = "1e7"', ['actuators.A.stiffness: "1e7"; allowed: a number, in SI units']),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "expected"), CASES)
def test_a_fault_is_told(machine: str, faults: Faults, old: str, new: str, expected: list[str]) -> None:
    assert old in machine
    told = [line.strip() for line in faults(machine.replace(old, new, 1))]
    assert [line if line.startswith("hint") else line.split(": ", 1)[1] for line in told] == expected


DELTA = Path(__file__).with_name("delta.toml").read_text(encoding="utf-8")
ARM = 'arm = { mass = 0.5, centre = ["R", 0, 0], inertia = [1, 2, 2, 0, 0, 0] }'


def test_vectors_of_a_template_turn_with_the_limb_and_one_limb_may_differ(read: Read) -> None:
    text = DELTA.replace('arm = { meaning = "driven" }', ARM)
    assert ARM in text
    text = text.replace("[links]\n", '[links]\n"leg2.arm" = { mass = 3, centre = [0, 0, 7] }\n')
    record = read(text)
    links = record.machine.links
    np.testing.assert_allclose(links["leg3.arm"].centre[:2], record.joints["leg3.A"].at[:2])  # both at R
    assert (links["leg1.arm"].mass, links["leg2.arm"].mass) == (0.5, 3.0)
    np.testing.assert_allclose(links["leg2.arm"].centre, [0, 0, 7])  # not turned: it stands outside the template
    cosine, sine = record.joints["leg2.A"].at[:2] / 200
    turned = [cosine**2 + 2 * sine**2, sine**2 + 2 * cosine**2, 2.0]
    np.testing.assert_allclose(np.diag(links["leg2.arm"].inertia), turned)


def test_compliances_of_a_template_turn_with_the_limb_and_one_joint_may_differ(read: Read) -> None:
    rows = "[1e-8, 2e-8, 3e-8, 1e-6, 2e-6, 3e-6]"
    text = DELTA.replace('arm = { meaning = "driven" }', f"arm = {{ compliance = {rows} }}")
    text += f'[compliances]\nA = {rows}\n"leg2.A" = [0, 0, 0, 0, 0, 1e-6]\n'
    record = read(text)
    cosine, sine = record.joints["leg3.A"].at[:2] / 200
    turn = np.kron(np.eye(2), [[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    turned = turn @ np.diag([1e-8, 2e-8, 3e-8, 1e-6, 2e-6, 3e-6]) @ turn.T
    np.testing.assert_allclose(record.machine.links["leg3.arm"].compliance, turned, atol=1e-18)
    np.testing.assert_allclose(record.machine.compliances["leg3.A"], turned, atol=1e-18)
    np.testing.assert_array_equal(record.machine.compliances["leg2.A"], np.diag([0, 0, 0, 0, 0, 1e-6]))


def test_a_link_of_a_limb_that_is_not_there_is_told(faults: Faults) -> None:
    (told, hint) = faults(DELTA.replace("[links]\n", '[links]\n"leg9.arm" = { mass = 3 }\n'))
    assert "unknown link 'leg9.arm'; there is: " in told
    assert "leg1.arm" in hint or "leg2.arm" in hint or "leg3.arm" in hint
