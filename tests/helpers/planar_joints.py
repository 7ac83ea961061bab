"""Mechanisms with planar joints, and the same ones with a P, a P and an R for each."""

HEAD = """
format = 1
name = "{name}"
unit = "mm"
angle = "deg"
base = "base"
platform = {{ link = "platform", pose = [{pose}] }}

[parameters]
R = {{ value = 300.0, meaning = "radius of the base" }}
r = {{ value = 100.0, meaning = "radius of the platform" }}
h = {{ value = 200.0, meaning = "height of the platform at home" }}
l = {{ value = 170.0, meaning = "length of cranks and rods" }}

[links]
base = {{}}
platform = {{}}
{links}
{joints}
[limbs.leg]
repeat = {{ about = "z", count = 3 }}
{limb}
"""

UPRIGHT = """
[limbs.leg.links]
crank = {}
rod = {}
LINKS
[limbs.leg.joints]
A = { type = "revolute", parent = "base", child = "crank", axis = "z", at = ["R", 0, 0] }
JOINTS
B = { type = "revolute", parent = "rod", child = "platform", axis = "z", child_at = ["r", 0, 0] }
[limbs.leg.home]
A = 3
HOME
B = 0
[inputs]
"leg1.A" = { name = "a1" }
"leg2.A" = { name = "a2" }
"leg3.A" = { name = "a3" }
"leg1.DRIVEN" = { name = "z1" }
"""
"""3-RER: a plane about the vertical that a hinge turns, its normal y at home; the height of one of them is driven."""

FLAT = """
[limbs.leg.links]
puck = {}
LINKS
[limbs.leg.joints]
JOINTS
B = { type = "revolute", parent = "puck", child = "platform", axis = "y", at = [0, 0, "h"], child_at = ["r", 0, 0] }
[limbs.leg.home]
HOME
B = 0
[limbs.leg.inputs]
"DRIVEN" = { name = "q" }
"""
"""3-ER: three pucks on the ground carry the platform; each is driven to the side."""

CRANKS = """
[limbs.leg.links]
crank = {}
rod = {}
[limbs.leg.joints]
A = { type = "revolute", parent = "base", child = "crank", at = ["R", 0, 0], axis = "z" }
B = { type = "revolute", parent = "crank", child = "rod", at = ["l", 0, 0], axis = "z" }
C = { type = "revolute", parent = "rod", child = "platform", at = ["l", 0, 0], child_at = ["r", 0, 0], axis = "z" }
[limbs.leg.inputs]
A = { name = "q" }
[limbs.leg.home]
A = 126
B = 108
C = 126
"""
"""Planar 3-RRR, whose platform a planar joint carries."""


def three_rer(*, planar: bool) -> str:
    """3-RER, or 3-RPPRR."""
    links, joints, home = _between("crank", "rod", "zxy", 'at = ["r - R", 0, "h"]', planar, "[0, 0, 0]", "000")
    text = _filled(UPRIGHT, links, joints, home, "E.first" if planar else "P")
    return HEAD.format(name="upright", pose='"x", "y", "z", "phi"', links="", joints="", limb=text)


def three_er(*, planar: bool) -> str:
    """3-ER, or 3-PPRR."""
    values = ['"r - R"', "0", "0"]
    links, joints, home = _between("base", "puck", "xyz", 'at = ["R", 0, 0]', planar, f"[{', '.join(values)}]", values)
    text = _filled(FLAT, links, joints, home, "E.second" if planar else "Q")
    return HEAD.format(name="flat", pose='"x", "y", "phi"', links="", joints="", limb=text)


def table(*, planar: bool) -> str:
    """3-RRR on a table: a planar joint, or a P, a P and an R, between base and platform."""
    links, joints, home = _between("base", "platform", "xyz", "at = [0, 0, 0]", planar, "[0, 0, 0]", "000")
    extra = f"[joints]\n{joints}\n[home]\n{home}\n"
    return HEAD.format(name="table", pose='"x", "y", "phi"', links=links, joints=extra, limb=CRANKS)


def _between(
    parent: str, child: str, axes: str, at: str, planar: bool, home: str, values: list[str] | str
) -> tuple[str, str, str]:
    """Links, joints and home of a planar joint whose slides are along the first two of three axes, or of P, P, R."""
    if planar:
        joint = f'E = {{ type = "planar", parent = "{parent}", child = "{child}", axis = "{axes[2]}", {at} }}'
        return "", joint, f"E = {home}"
    links = ["out", "side"]
    rows = [
        f'P = {{ type = "prismatic", parent = "{parent}", child = "out", axis = "{axes[0]}", {at} }}',
        f'Q = {{ type = "prismatic", parent = "out", child = "side", axis = "{axes[1]}" }}',
        f'T = {{ type = "revolute", parent = "side", child = "{child}", axis = "{axes[2]}" }}',
    ]
    home = "\n".join(f"{name} = {value}" for name, value in zip("PQT", values, strict=True))
    return "\n".join(f"{name} = {{}}" for name in links), "\n".join(rows), home


def _filled(text: str, links: str, joints: str, home: str, driven: str) -> str:
    for word, own in (("LINKS", links), ("JOINTS", joints), ("HOME", home), ("DRIVEN", driven)):
        text = text.replace(word, own)
    return text
