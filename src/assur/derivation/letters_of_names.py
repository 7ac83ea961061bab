"""Names of a file in LaTeX: of dimensions, joints, inputs and links, of signs and of words."""

from __future__ import annotations

import re
from collections.abc import Container, Mapping

from assur.model.mechanism import Input
from assur.results.latex_text import letter
from assur.topology.latex import name as joint_latex

SHIFTED = {"^": r"\wedge", "~": r"\sim"}
"""Characters that words have and text in LaTeX does not."""

_SPECIAL = re.compile(r"([&%$#_{}])")
_NUMBERED = re.compile(r"(\D*?)_?(\d+)_?([A-Za-z_]*)(\d*)")


def input_letter(driven: Input) -> str:
    """The file's LaTeX of an input, else its name as a letter."""
    return driven.latex if driven.latex != driven.name else letter(driven.name)


def joint_letter(name: str) -> str:
    r"""A joint's name as a letter; of a repeated limb's the limb's number comes first.

    >>> joint_letter("B3a"), joint_letter("leg1.A"), joint_letter("leg2.B1"), joint_letter("leg1.Pa")
    ('B_{3a}', 'A_{1}', 'B_{2,1}', '\\mathrm{Pa}_{1}')
    """
    limb = re.fullmatch(r"[A-Za-z_]+(\d+)\.([A-Za-z]+)(\w*)", name)
    if not limb:
        return joint_latex(name)
    number, part, further = limb.groups()
    return joint_latex(part) + f"_{{{number}{',' + further if further else ''}}}"


def defined(name: str) -> str:
    """A name that the derivation gives: a letter, an axis, the number of its set."""
    plain = name.rstrip("_")
    match = re.fullmatch(r"([A-Za-z])([xyz]?)(\d*)", plain)
    if match is None:
        return rf"\mathrm{{{plain}}}"
    stem, axis, number = match.groups()
    stem = rf"\bar{{{stem}}}" if plain != name else stem  # another quantity has the name without
    return f"{stem}_{{{number}{axis}}}"


def kind_of(name: str) -> tuple[str, str]:
    """What a link is, and its number: of a repeated limb the limb's."""
    match = _NUMBERED.fullmatch(name)
    if match is None:
        return name, ""
    before, number, after, further = match.groups()
    return f"{before} {after if len(after) > 1 else ''}{further}", number


def plain(text: str) -> str:
    r"""Words of a file in LaTeX.

    >>> plain("height of B_i, 50 %")
    'height of B\\_i, 50 \\%'
    """
    escaped = _SPECIAL.sub(r"\\\1", text.replace("\\", "/"))
    escaped = re.sub(r"[<>|^~]", lambda match: f"${SHIFTED.get(match[0], match[0])}$", escaped)
    return escaped.encode("ascii", "replace").decode("ascii")


def plain_with_joints(text: str, joints: Container[str]) -> str:
    r"""Words of a file in LaTeX, with the letters of joints.

    >>> plain_with_joints("leg1.B lies ahead of leg1.A.", {"leg1.A", "leg1.B"})
    '$B_{1}$ lies ahead of $A_{1}$.'
    """
    parts = re.split(r"([A-Za-z]\w*(?:\.\w+)*)", text)
    return "".join(f"${joint_letter(part)}$" if part in joints else plain(part) for part in parts)


def sign_formula(text: str, letters_of: Mapping[str, str]) -> str:
    r"""What a file says of a sign, as mathematics: coordinates of points; parameters and angles by their letters.

    >>> sign_formula("C1.z - B1.z > 0", {}), sign_formula("sin(D3a - D1) > 0", {"D3a": r"\beta", "D1": r"\alpha"})
    ('z_{C_{1}} - z_{B_{1}} > 0', '\\sin(\\beta - \\alpha) > 0')
    >>> sign_formula("sin(D1) > 0", {"D1": r"\alpha"})
    '\\sin \\alpha > 0'
    >>> sign_formula("l2*cos(30 deg) - C1.x > 0", {"l2": "l_{2}"})
    'l_{2}\\cos 30^{\\circ} - x_{C_{1}} > 0'
    """
    in_degrees = re.sub(r"(\d) deg\b", r"\1^{\\circ}", text)
    plain_text = re.sub(r"\b(sin|cos|tan)\(([\w.]+(?:\^{\\circ})?)\)", r"\1 \2", in_degrees)

    def letters(match: re.Match[str]) -> str:
        function, joint, axis, name = match.groups()
        if function:
            return rf"\{function}{'(' if match[0].endswith('(') else ' '}"
        if axis:
            return f"{axis}_{{{joint_letter(joint)}}}"
        return letters_of.get(name, rf"\theta_{{{joint_letter(name)}}}")

    pattern = r"\b(sin|cos|tan)[( ]|\b([A-Za-z][\w.]*)\.([xyz])\b|(?<!\\)\b([A-Za-z][\w.]*)"
    return re.sub(pattern, letters, plain_text).replace("*", "")
