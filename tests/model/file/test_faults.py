"""Every kind of fault in a file: the line, the path, what was found, what is allowed, the hint."""

from collections.abc import Callable

import pytest

Faults = Callable[[str], list[str]]
TOP = (
    "allowed here: actuators, angle, angles, base, chains, clearances, compliances, format, generalised, gravity, "
    "home, inputs, joints, limbs, links, materials, modes, name, parameters, payload, platform, points, profiles, "
    "source, title, tolerances, unit, workspace"
)
LINKS = "there is: coupler, crank, ground, rocker"
JOINTS = "there is: A, B, C, D, R2"
TYPES = "allowed: cylindrical, helical, planar, prismatic, revolute, spherical, universal"
NUMBER = 'allowed: a number, or a formula in quotes: 30, "l2/2", "62 deg"'
NAME = "a name is a letter, then letters, digits, _ and primes"
MIXED = "allowed: angles with angles, plain numbers with plain numbers"
FIRST = "; the first one is in line"
POINT = "write decimals with a point: 0.5, not 0,5"
DEG = "a unit makes an angle of a number: 90 deg"
QUANTITIES = (
    "there is: A, A.x, A.y, A.z, B, B.x, B.y, B.z, C, C.x, C.y, C.z, D, D.x, D.y, D.z, P.x, P.y, P.z, "
    "R2, R2.x, R2.y, R2.z, g, gamma, l1, l2, l3, and 1 more"
)

CASES: list[tuple[str, str, list[str]]] = [
    # the top of the file
    ("format = 1", "format = 2", ["1: format: 2; allowed: 1, the format that this version reads"]),
    ("format = 1", "format = true", ["1: format: true; allowed: 1, the format that this version reads"]),
    ("format = 1\n", "", ["1: format: missing; this must be there: 1, the format that this version reads"]),
    ('name = "fourbar"', 'name = "four bar"', ['2: name: "four bar" is no name; allowed: letters, digits, _ and -']),
    ('unit = "mm"\n', "", ["1: unit: missing; this must be there: the unit of length: mm, cm, m, in or ft"]),
    ('unit = "mm"', 'unit = "mile"', ['3: unit: "mile"; allowed: mm, cm, m, in or ft']),
    ('angle = "deg"\n', "", ["1: angle: missing; this must be there: the unit of angles: deg or rad"]),
    ('angle = "deg"', 'angle = "degree"', ['4: angle: "degree"; allowed: deg or rad', "? did you mean 'deg'?"]),
    ('base = "ground"\n', "", ["1: base: missing; this must be there: the link that stands still"]),
    ('base = "ground"', 'base = "grund"', [f"5: base: unknown link 'grund'; {LINKS}", "? did you mean 'ground'?"]),
    ("platform = ", "plattform = ", [f"6: plattform: unknown key; {TOP}", "? did you mean 'platform' or 'format'?"]),
    ('"coupler", point', '"ground", point', ["6: platform.link: 'ground' is the base; allowed: another link"]),
    ('["x", "y"]', "[]", ["6: platform.pose: a list of 0; allowed: at least 1"]),
    ('["x", "y"]', '["x", "w", "y"]',
     ['6: platform.pose[1]: "w"; allowed: x, y, z, phi, theta, psi, qw, qx, qy or qz', "? did you mean 'qw'?"]),
    ('["x", "y"]', '["x", "y", "y"]', [f"6: platform.pose[2]: the coordinate y twice{FIRST} 6; allowed: each once"]),
    ('["x", "y"]', '["x", "y", "qw"]',
     ["6: platform.pose: half a quaternion; allowed: qw, qx, qy, qz together, without angles"]),
    ('"y"] }', '"y", "phi"], orientation = "constant" }',
     ["6: platform.pose: a coordinate that turns; allowed with constant orientation: x, y, z"]),
    ('base = "ground"', 'base = ["ground", "rocker"]',
     ["5: base: a list of 2; allowed: the name of one link",
      "? one link stands still; all joints on the ground have it as their parent or child"]),
    ('unit = "mm"', 'unit = 1', ["3: unit: 1; allowed: mm, cm, m, in or ft"]),
    ('"coupler", point', '"cuopler", point',
     [f"6: platform.link: unknown link 'cuopler'; {LINKS}", "? did you mean 'coupler'?"]),
    ('platform = { link = "coupler", ', "platform = { ", ["6: platform.link: missing; this key must be there"]),
    # parameters
    ("value = 40", 'value = "4o"',
     ['9: parameters.l1.value: "4o" has \'o\' at character 2; expected an operator or the end',
      "? write * between factors: 2*l2"]),
    ("value = 40", "value = nan", ["9: parameters.l1.value: nan; allowed: a finite number"]),
    ("value = 40", "value = -inf", ["9: parameters.l1.value: -inf; allowed: a finite number"]),
    ("value = 40", "value = 1e999", ["9: parameters.l1.value: inf; allowed: a finite number"]),
    ("value = 40", f"value = 1{'0' * 400}", [f"9: parameters.l1.value: 1{'0' * 56}...; allowed: a finite number"]),
    ("value = 40", "value = true", [f"9: parameters.l1.value: true; {NUMBER}"]),
    ("value = 40", "value = 2000-01-01", [f"9: parameters.l1.value: 2000-01-01; {NUMBER}"]),
    ("value = 40", "value = [40]", [f"9: parameters.l1.value: a list of 1; {NUMBER}"]),
    ("value = 40", "value = 0",
     ["9: parameters.l1.value: l1 = 0 mm; allowed: a positive number", '? sign = "nonnegative" allows zero',
      "10: parameters.l2.value: l2 = 3*l1 = 0 mm; allowed: a positive number", '? sign = "nonnegative" allows zero']),
    ("value = 80", "value = -8",
     ["11: parameters.l3.value: l3 = -8 mm; allowed: a positive number", '? sign = "any" allows negative values']),
    ("value = 80", 'sign = "nonnegative", value = -8',
     ["11: parameters.l3.value: l3 = -8 mm; allowed: zero or a positive number",
      '? sign = "any" allows negative values']),
    ("value = 40", 'value = "l2/3"',
     ["9: parameters.l1.value: a formula that needs itself: l1 -> l2 -> l1; "
      "allowed: formulas of parameters that do not need it"]),
    ("value = 80", 'value = "l3"',
     ["11: parameters.l3.value: a formula that needs itself: l3 -> l3; "
      "allowed: formulas of parameters that do not need it"]),
    ("value = 40", 'value = "q9/3"', ["9: parameters.l1.value: unknown parameter 'q9'; there is: g, l1, l2, l3, tilt"]),
    ("value = 40", 'value = "1/(l3-80)"',
     ['9: parameters.l1.value: "1/(l3-80)" has no value: division by zero; allowed: a finite number']),
    ("value = 40", 'value = "sqrt(-l3)"',
     ['9: parameters.l1.value: "sqrt(-l3)" has no value: square root of a negative number; allowed: a finite number']),
    ("value = 40", 'value = "1e300*1e300 - 1e300*1e300"',
     ['9: parameters.l1.value: "1e300*1e300 - 1e300*1e300" is too large; allowed: numbers up to 1e+100']),
    ("value = 40", "value = 1e101", ['9: parameters.l1.value: "1e+101" is too large; allowed: numbers up to 1e+100']),
    ("value = 40", 'value = "3 deg"', ['9: parameters.l1.value: "3 deg" is an angle; allowed: a number in mm']),
    ("value = 40", 'value = "sin(l3)"',
     [f'9: parameters.l1.value: "sin(l3)": sin of a plain number; {MIXED}', f"? {DEG}"]),
    ("value = 40", 'value = "sqrt(tilt)"',
     [f'9: parameters.l1.value: "sqrt(tilt)": the square root of an angle; {MIXED}', f"? {DEG}"]),
    ("value = 40", 'value = "l3*cos(tilt*tilt)"',
     [f'9: parameters.l1.value: "l3*cos(tilt*tilt)": a product of angles; {MIXED}', f"? {DEG}"]),
    ("value = 40", 'value = "l3/tilt"',
     [f'9: parameters.l1.value: "l3/tilt": a plain number divided by an angle; {MIXED}', f"? {DEG}"]),
    ('unit = "deg"', 'unit = "m"',
     ['13: parameters.tilt.unit: "m"; allowed: mm (the file\'s length unit), deg, rad, or 1 for a pure number']),
    ('sign = "any"', 'sign = "some"', ['13: parameters.tilt.sign: "some"; allowed: positive, nonnegative or any']),
    ('sign = "any"', "drawn_only = 1", ["13: parameters.tilt.drawn_only: 1; allowed: true or false"]),
    ('{ value = 80, meaning = "rocker" }', "80",
     ["11: parameters.l3: 80; allowed: a table { ... }", "? write l3 = { value = 80 }"]),
    ("g = { value", "g = { vaule",
     ["12: parameters.g.vaule: unknown key; allowed here: drawn_only, meaning, sign, unit, value",
      "? did you mean 'value'?"]),
    ("l3 = { value = 80, ", "l3 = { ", ["11: parameters.l3.value: missing; this key must be there"]),
    ("l3 = {", "lambda = {",
     ['11: parameters.lambda: "lambda" is no name; allowed: a Python name: letters, digits and _',
      "24: joints.C.child_at[0]: unknown parameter 'l3'; there is: g, l1, l2, tilt", "? did you mean 'l2' or 'l1'?"]),
    # links and joints
    ("[links]", "[lnks]", [f"15: lnks: unknown key; {TOP}", "? did you mean 'links'?"]),
    ("crank = {}", "crank = { masss = 3 }",
     ["17: links.crank.masss: unknown key; allowed here: bars, centre, compliance, inertia, kg_per_m, mass, material, "
      "meaning, profile, rigid, up", "? did you mean 'mass'?"]),
    ("crank = {}", "crank = { meaning = 3 }", ["17: links.crank.meaning: 3; allowed: a text in quotes"]),
    ("crank = {}", "crank = 3", ["17: links.crank: 3; allowed: a table { ... }"]),
    ("rocker = {}", "rocker = {}\nlost = {}",
     ["20: links.lost: 'lost' is not connected to the base; allowed: one connected graph"]),
    ('child = "rocker", at = ["g', 'child = "coupler", at = ["g',
     ["19: links.rocker: 'rocker' dangles: it has one joint only; allowed: two or more",
      "? a body that only rides along belongs to the link that carries it, as a point"]),
    ('axis = "z"', 'axsi = "z"',
     ["22: joints.A.axsi: unknown key; allowed here: alias, at, axis, child, child_at, child_axis, limits, meaning, "
      "parent, type", "? did you mean 'axis'?"]),
    (', axis = "z" }', " }", ["22: joints.A.axis: missing; this key must be there"]),
    ('type = "revolute"', 'type = "revolut"', [f'22: joints.A.type: "revolut"; {TYPES}', "? did you mean 'revolute'?"]),
    ('type = "revolute", ', "", [f"22: joints.A.type: missing; {TYPES}"]),
    ('"l1", 0, 0', '"l1", 0', ['23: joints.B.at: a list of 2, ["l1", 0]; allowed: a list of three components']),
    ('"l1", 0, 0', '"l1", "l1", 0,5',
     ['23: joints.B.at: a list of 4, ["l1", "l1", 0, 5]; allowed: a list of three components', f"? {POINT}"]),
    ('"l1", 0, 0', '"l1", 0, "l1", 0',
     ['23: joints.B.at: a list of 4, ["l1", 0, "l1", 0]; allowed: a list of three components']),
    ('"l1", 0, 0', "0,5, 0,0, 0,0",
     ["23: joints.B.at: a list of 6, [0, 5, 0, 0, 0, 0]; allowed: a list of three components", f"? {POINT}"]),
    ('["l1", 0, 0]', '"l1"', ['23: joints.B.at: "l1"; allowed: a list of three components']),
    ('"l1", 0, 0', '"1,5", 0, 0',
     ['23: joints.B.at[0]: "1,5" has \',\' at character 2; expected a number, a name, an operator or a bracket',
      f"? {POINT}"]),
    ('"l1", 0, 0', '"l1", "tilt", 0', ['23: joints.B.at[1]: "tilt" is an angle; allowed: a length']),
    ('child = "crank"', 'child = "crnk"',
     [f"22: joints.A.child: unknown link 'crnk'; {LINKS}", "? did you mean 'crank'?"]),
    ('child = "crank"', 'child = "ground"',
     ["22: joints.A.child: joins 'ground' to itself; allowed: two different links"]),
    ('axis = "z"', 'axis = "w"',
     ['22: joints.A.axis: "w"; allowed: x, y, z, -x, -y, -z, or a vector such as ["0", "cos(30 deg)", "sin(30 deg)"]']),
    ('axis = "z"', 'axis = [0, 0, "l1 - 40"]',
     ["22: joints.A.axis: an axis of length zero; allowed: a vector that has a direction"]),
    ('axis = "z"', 'axis = "z", child_axis = [0, 0, -2]',
     ["22: joints.A.child_axis: the opposite of `axis`; allowed: any direction but the opposite, from which a "
      "smallest turn to `axis` exists",
      "? turn the child's frame so that child_axis is the axis itself, and leave child_axis out"]),
    ('axis = "z"', 'axis = "z", limits = [10, 10]',
     ['22: joints.A.limits: from "10" to "10"; allowed: [low, high] with low below high']),
    ('"revolute", parent = "ground", child = "crank", axis', '"helical", parent = "ground", child = "crank", axis',
     ["22: joints.A.pitch: missing; this key must be there"]),
    ('"revolute", parent = "ground", child = "crank", axis',
     '"helical", pitch = 0, parent = "ground", child = "crank", axis',
     ["22: joints.A.pitch: pitch 0; allowed: the advance per turn", "? without one it is a revolute"]),
    ('"revolute", parent = "ground", child = "crank", axis = "z"',
     '"universal", parent = "ground", child = "crank", axis = "z"',
     ["22: joints.A.axis: unknown key; allowed here: alias, at, axes, child, child_at, limits, meaning, parent, type",
      "? did you mean 'axes' or 'alias'?", '22: joints.A.axes: "z"; allowed: a list of two axes']),
    ('"revolute", parent = "ground", child = "crank", axis = "z" }\nB',
     '"universal", parent = "ground", child = "crank", axes = ["z", [0, 0, -3]] }\nB',
     ["22: joints.A.axes: two parallel axes; allowed: two that are not",
      "? two parallel axes are one freedom: use a revolute",
      "28: inputs.A: 'A' has 2 components; allowed: A.first or A.second",
      "45: home.A: 1 values; allowed: 2 (first, second)"]),
    ('"revolute", parent = "ground", child = "crank", axis = "z" }\nB',
     '"spherical", parent = "ground", child = "crank", cone = { axis = "z", angle = 181 } }\nB',
     ['22: joints.A.cone.angle: "181"; allowed: above 0, up to half a turn',
      "28: inputs.A: 'A' has 3 components; allowed: A.rx or A.ry or A.rz",
      "45: home.A: 1 values; allowed: 3 (rx, ry, rz)"]),
    ('"l1", 0, 0', '"1e12*l1", 0, 0', ['23: joints.B.at[0]: "1e12*l1" is 4e+13; allowed: numbers up to 1e+12']),
    ("B = -50", "B = 1e13", ['46: home.B: "10000000000000.0" is 1e+13; allowed: numbers up to 1e+12']),
    ("value = 40", f"value = 0x{'f' * 3000}",
     [" a whole number of thousands of digits; numbers within the range of floats"]),
    # names
    ('axis = "z"', 'axis = "z", alias = "R 1"',
     [f'22: joints.A.alias: "R 1" is no name; {NAME}', "? the reader adds the dots in names such as leg1.B"]),
    ("P = { link", "R2 = { link",
     [f"34: points.R2: a joint has the name 'R2' already{FIRST} 23; allowed: another name"]),
    ("P = { link", "A = { link",
     [f"34: points.A: a joint has the name 'A' already{FIRST} 22; allowed: another name"]),
    ("P = { link", "crank = { link",
     [f"34: points.crank: a link has the name 'crank' already{FIRST} 17; allowed: another name"]),
    ("P = { link", "l1 = { link",
     [f"34: points.l1: a parameter has the name 'l1' already{FIRST} 9; allowed: another name"]),
    ("gamma = ", "tilt = ",
     [f"31: angles.tilt: a parameter has the name 'tilt' already{FIRST} 13; allowed: another name"]),
    ("P = { link", "sin = { link",
     [f'34: points.sin: "sin" is a reserved word; {NAME}', "? the reader adds the dots in names such as leg1.B"]),
    ("P = { link", "1P = { link",
     [f'34: points.1P: "1P" is no name; {NAME}', "? the reader adds the dots in names such as leg1.B"]),
    ("P = { link", '"a.b" = { link',
     [f'34: points."a.b": "a.b" is no name; {NAME}', "? the reader adds the dots in names such as leg1.B"]),
    ("g = { value", "l1 = { value",
     ["12: not TOML", "? each name may be given once"]),
    # inputs
    ("[inputs]\nA = {", "[inputs]\nE = {", [f"28: inputs.E: unknown joint 'E'; {JOINTS}"]),
    ("[inputs]\nA = {", "[inputs]\nP = {", [f"28: inputs.P: unknown joint 'P'; {JOINTS}"]),
    ("[inputs]", '[inputs]\norder = ["A", "B"]',
     ["28: inputs.order[1]: 'B' has no entry in [inputs]; allowed: the inputs, each once",
      '? add B = { name = "q" }']),
    ("[inputs]", '[inputs]\norder = ["A", "A"]',
     [f"28: inputs.order[1]: 'A' twice{FIRST} 28; allowed: the inputs, each once"]),
    ("[inputs]", '[inputs]\nB = { name = "q" }\norder = ["A"]',
     ["29: inputs.order: lacks B; allowed: the inputs, each once"]),
    ("[inputs]", '[inputs]\nB = { name = "theta" }',
     [f"29: inputs.A.name: an input has the name 'theta' already{FIRST} 28; allowed: another name"]),
    ("[inputs]", '[inputs]\nR2 = { name = "q1" }\nB = { name = "q2" }',
     [f"29: inputs.B: 'B' is an input already{FIRST} 28; allowed: each joint once"]),
    ("[inputs]", "[inputs]\nB.rotation = { name = 'q' }",
     ["28: inputs.B.rotation: unknown key; allowed here: latex, name, offset, offsets, sign, stroke",
      '? a name with a dot stands in quotes: "leg1.B"', "28: inputs.B.name: missing; this key must be there"]),
    ('[inputs]\nA = { name = "theta", latex = "\\\\theta", stroke = [-180, "180 deg"] }\n', "",
     ["1: inputs: missing; this must be there: a table of the actuated joints"]),
    ('name = "theta"', 'name = "theta", sign = 2', ["28: inputs.A.sign: 2; allowed: 1 or -1"]),
    ('name = "theta"', 'name = "theta", sign = true', ["28: inputs.A.sign: true; allowed: 1 or -1"]),
    ('[-180, "180 deg"]', "[180, -180]",
     ['28: inputs.A.stroke: from "180" to "-180"; allowed: [low, high] with low below high']),
    ('[-180, "180 deg"]', "[180]", ["28: inputs.A.stroke: a list of 1, [180]; allowed: a list [low, high]"]),
    # letters and modes
    ('gamma = "R2"', 'gamma = "R7"', [f"31: angles.gamma: unknown joint 'R7'; {JOINTS}", "? did you mean 'R2'?"]),
    ("gamma = ", "P2 = 3\ngamma = ", ["31: angles.P2: 3; allowed: a text in quotes"]),
    ('P = { link = "coupler"', 'P = { link = "cuopler"',
     [f"34: points.P.link: unknown link 'cuopler'; {LINKS}", "? did you mean 'coupler'?"]),
    ('"sin(R2)"', '"sin(W)"', [f"37: modes.working.s: unknown quantity 'W'; {QUANTITIES}"]),
    ('"sin(R2)"', '"B.q - A.x"',
     [f"37: modes.working.s: unknown quantity 'B.q'; {QUANTITIES}", "? did you mean 'B.z' or 'B.y'?"]),
    ('"sin(R2)"', '"R2 - 90"',
     [f'37: modes.working.s: "R2 - 90": the sum of an angle and a plain number; {MIXED}', f"? {DEG}"]),
    ('"sin(R2)"', '"l1 - l2"',
     ['37: modes.working.s: "l1 - l2" never changes; allowed: a formula of joints and points']),
    ('working = { s = "sin(R2)" }', 'working = { s = "sin(R2)" }\nassembly = { s = "A.x" }',
     ["38: modes.assembly.s: a working sign has this name; allowed: another name",
      "39: modes.default.assembly: missing; allowed: + or - for each of s"]),
    ('working = "-"', 'working = "+-"', ['38: modes.default.working: "+-"; allowed: + or - for each of s']),
    ('working = "-"', 'working = "0"', ['38: modes.default.working: "0"; allowed: + or - for each of s']),
    ('working = "-"', 'working = "-", assembly = "+"',
     ['38: modes.default.assembly: "+"; there are no assembly signs']),
    ('default = { working = "-" }\n', "", ["36: modes.default.working: missing; allowed: + or - for each of s"]),
    # workspace and home
    ('x = [-40, "l2"]', "w = [1, 2]", ["41: workspace.box.w: unknown coordinate of the pose 'w'; there is: x, y"]),
    ('x = [-40, "l2"]', 'x = ["l2", -40]',
     ['41: workspace.box.x: from "l2" to "-40"; allowed: [low, high] with low below high']),
    ("sections = [50]", "sections = 50", ["42: workspace.sections: 50; allowed: a list [ ... ]"]),
    ("B = -50\n", "",
     ["44: home: lacks B; every joint needs a value near one assembled configuration",
      "? add B = 0, or a better guess"]),
    ("B = -50", "B = [1, 2]", ["46: home.B: 2 values; allowed: 1 (rotation)"]),
    ("B = -50", "B = -50\nQ = 3", [f"47: home.Q: unknown joint 'Q'; {JOINTS}"]),
    ("B = -50", "B = -50\nR2 = 3", [f"47: home.R2: 'R2' is given twice{FIRST} 46; allowed: each joint once"]),
    ("B = -50", 'B = "-50 - l1 deg"',
     ['46: home.B: "-50 - l1 deg" has \'deg\' at character 10; expected an operator or the end',
      "? write * between factors: 2*l2"]),
    ("[home]", "[home.leg1]\nB = 3\n[home]",
     [f"44: home.leg1: a table; {NUMBER}", '? a name with a dot stands in quotes: "leg1.B"']),
    ('"60 deg + tilt"', '"60 + tilt"',
     [f'45: home.A: "60 + tilt": the sum of an angle and a plain number; {MIXED}', f"? {DEG}"]),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "expected"), CASES)
def test_a_fault_is_told_exactly(fourbar: str, faults: Faults, old: str, new: str, expected: list[str]) -> None:
    assert old in fourbar
    found = faults(fourbar.replace(old, new, 1))
    wanted = [f"    hint: {line[2:]}" if line.startswith("? ") else f"f.toml:{line}" for line in expected]
    if "not TOML" in wanted[0]:  # the words of the rest are the TOML reader's
        found[0] = found[0][: len(wanted[0])]
    assert found == wanted


def test_all_faults_of_a_file_come_at_once_in_the_order_of_their_lines(fourbar: str, faults: Faults) -> None:
    text = fourbar
    edits = [
        ('unit = "mm"\n', ""),
        ("value = 80", "value = nan"),
        ("value = 100", "value = -100"),
        ('child = "crank"', 'child = "cranc"'),
        ('alias = "R2"', 'allias = "R2"'),
        ('axis = "z" }\n\n[inputs]', "axis = [0, 0, 0] }\n\n[inputs]"),
        ('gamma = "R2"', 'gamma = "R5"'),
        ('working = "-"', 'working = "-+"'),
        ("C = -100\n", ""),
    ]
    for old, new in edits:
        assert old in text
        text = text.replace(old, new, 1)
    found = [line for line in faults(text) if not line.startswith("    ")]
    assert [line.split(": ")[0:2] for line in found] == [
        ["f.toml:1", "unit"],
        ["f.toml:10", "parameters.l3.value"],
        ["f.toml:11", "parameters.g.value"],
        ["f.toml:21", "joints.A.child"],
        ["f.toml:22", "joints.B.allias"],
        ["f.toml:24", "joints.D.axis"],
        ["f.toml:30", "angles.gamma"],
        ["f.toml:37", "modes.default.working"],
        ["f.toml:43", "home"],
    ]


def test_a_broken_entry_is_no_unknown_name(fourbar: str, faults: Faults) -> None:
    """Joint B, its alias, parameter l1 and link crank are all referred to; only their own faults are told."""
    text = fourbar.replace("value = 40", 'value = "("').replace("crank = {}", "crank = 1")
    text = text.replace('parent = "crank"', "parent = 3")
    found = [line.split(": ")[1] for line in faults(text) if not line.startswith("    ")]
    assert found == ["parameters.l1.value", "links.crank", "joints.B.parent"]


@pytest.mark.parametrize("tag", ["3", "[]", "{}", "true", "nan", "1979-05-27", '"Revolute"'])
def test_a_type_that_is_none_is_told(fourbar: str, faults: Faults, tag: str) -> None:
    found = faults(fourbar.replace('type = "revolute"', f"type = {tag}", 1))
    assert found[0].startswith("f.toml:22: joints.A.type: ")
    assert TYPES in found[0]
    assert len([line for line in found if not line.startswith("    ")]) == 1


def test_islands_are_told_each_with_all_that_hangs_on_it(fourbar: str, faults: Faults) -> None:
    text = fourbar.replace("rocker = {}", "rocker = {}\nwall = {}\ndoor = {}\nlost = {}")
    text = text.replace("[joints]", '[joints]\nH = { type = "revolute", parent = "wall", child = "door", axis = "z" }')
    assert faults(text + "H = 0\n") == [
        "f.toml:20: links.wall: 'wall' is not connected to the base, nor is what hangs on it (door); "
        "allowed: one connected graph",
        "    hint: a second base? All links that stand still are one link, the base",
        "f.toml:22: links.lost: 'lost' is not connected to the base; allowed: one connected graph",
    ]


def test_points_that_nearly_coincide_are_no_mechanism(faults: Faults) -> None:
    text = """
format = 1
name = "pin"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "hand", pose = ["x"] }
links = { base = {}, hand = {} }
inputs = { J = { name = "q" } }
home = { J = 0 }
[joints]
J = { type = "revolute", parent = "base", child = "hand", axis = "z", at = [1e-200, 0, 0] }
"""
    assert faults(text) == [
        "f.toml:11: joints: no coordinate of a joint exceeds 1e-200 mm; "
        "allowed: links of at least 1e-09 mm, or all of no size"
    ]


@pytest.mark.parametrize(
    ("table", "count", "most", "line"),
    [("joints", 205, 200, 21), ("links", 405, 400, 15), ("parameters", 4006, 4000, 8), ("points", 402, 400, 33)],
)
def test_more_than_any_mechanism_has_is_refused(
    fourbar: str, faults: Faults, table: str, count: int, most: int, line: int
) -> None:
    own = {"joints": 4, "links": 4, "parameters": 5, "points": 1}[table]
    entry = {
        "joints": '{ type = "revolute", parent = "ground", child = "crank", axis = "z" }',
        "links": "{}",
        "parameters": "{ value = 1 }",
        "points": '{ link = "crank" }',
    }[table]
    entries = "\n".join(f"n{index} = {entry}" for index in range(count - own))
    text = fourbar.replace(f"[{table}]\n", f"[{table}]\n{entries}\n")
    assert faults(text) == [f"f.toml:{line}: {table}: {count} entries; allowed: at most {most}"]


def test_a_hundred_faults_are_told_and_the_rest_counted(fourbar: str, faults: Faults) -> None:
    text = fourbar + "\n".join(f"k{index} = 1" for index in range(130))
    found = [line for line in faults(text) if not line.startswith("    ")]
    assert len(found) == 101
    assert found[0] == f"f.toml:49: home.k0: unknown joint 'k0'; {JOINTS}"
    assert found[-1] == "f.toml: 30 more faults; correct the others first"


def test_long_texts_are_cut(fourbar: str, faults: Faults) -> None:
    (fault,) = faults(fourbar.replace('base = "ground"', f'base = "{"g" * 90_000}"'))
    assert fault == f"f.toml:5: base: unknown link '{'g' * 57}...'; {LINKS}"


@pytest.mark.parametrize("table", ["links", "joints", "home", "inputs", "parameters", "limbs"])
def test_a_table_that_is_none_ends_the_reading(faults: Faults, table: str) -> None:
    assert faults(f"format = 1\n{table} = 3") == [f"f.toml:2: {table}: 3; allowed: a table {{ ... }}"]


def test_an_empty_file_says_what_a_mechanism_needs(faults: Faults) -> None:
    needed = ["format", "name", "unit", "angle", "base", "platform", "links", "joints", "inputs", "home"]
    assert [line.split(": ")[1:3] for line in faults("")] == [[key, "missing; this must be there"] for key in needed]


def test_a_format_is_an_integer(fourbar: str, faults: Faults) -> None:
    for text in ("1.0", '"1"', "true", "[1]", "2", "1e0"):
        assert faults(fourbar.replace("format = 1", f"format = {text}", 1))[0].startswith("f.toml:1: format: ")


@pytest.mark.parametrize("old", ['name = "theta"', 'alias = "R2"', 'name = "fourbar"'])
def test_names_that_are_values_have_100_characters_at_most(fourbar: str, faults: Faults, old: str) -> None:
    assert old in fourbar
    long = f'{old.partition(" = ")[0]} = "{"n" * 101}"'
    found = faults(fourbar.replace(old, long, 1))
    assert any("a name of 101 characters; allowed: at most 100" in line for line in found)
