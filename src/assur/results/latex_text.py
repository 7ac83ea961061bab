r"""Words as LaTeX sets them: special characters, signs and powers of prose; mathematics between dollar signs stays."""

from __future__ import annotations

import re

_SPECIAL = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
_SPECIAL |= {sign: "\\" + sign for sign in "&%$#_{}"}
_NAMES = """alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi pi rho sigma tau phi chi psi omega
Delta Theta Lambda Xi Pi Sigma Phi Psi Omega"""
_GREEK = dict(zip("αβγδεζηθκλμνξπρστφχψωΔΘΛΞΠΣΦΨΩ", _NAMES.split(), strict=True))
MATHEMATICAL = {sign: f"^{{{power}}}" for sign, power in zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-", strict=True)}
MATHEMATICAL |= {sign: f"_{{{power}}}" for sign, power in zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True)}
MATHEMATICAL |= {sign: f"_{{{name}}}" for sign, name in zip("ᵢⱼᵣₖₘₙ", "ijrkmn", strict=True)}
MATHEMATICAL |= {sign: f"\\{name}" for sign, name in _GREEK.items()}
MATHEMATICAL |= {
    "\N{MINUS SIGN}": "-",
    "\N{MICRO SIGN}": r"\mu",
    "·": r"\cdot",
    "±": r"\pm",
    "∓": r"\mp",
    "°": r"^\circ",
}
MATHEMATICAL |= {"\N{MULTIPLICATION SIGN}": r"\times", "\N{PRIME}": "'", "≤": r"\le", "≥": r"\ge", "≠": r"\ne"}
MATHEMATICAL |= {
    "∓": r"\mp",
    "∥": r"\parallel",
    "⊥": r"\perp",
    "◇": r"\diamond",
    "√": r"\surd",
    "∞": r"\infty",
    "→": r"\to",
}
MATHEMATICAL |= {"∪": r"\cup", "∩": r"\cap", "∈": r"\in", "≈": r"\approx", "<": "<", ">": ">", "|": "|"}
"""Signs that stand in prose -> the same in mathematics, without dollar signs."""

_WORDS = {"\N{EN DASH}": "--", "…": r"\dots{}", "\u202f": r"\,", "\u00a0": "~", "\u2009": r"\,"}
_WORDS |= {"‘": "`", "’": "'", "“": "``", "”": "''", "\N{EM DASH}": "---"}
_WORDS |= {chr(0x245F + number): rf"\textcircled{{{number}}}" for number in range(1, 21)}
_LATIN = "\u017f"
"""The last of the letters that LaTeX reads as they are."""

_DOTTED = re.compile("(\\w)\N{COMBINING DOT ABOVE}")
"""A rate."""

_RUNS = re.compile(r"\$\$")
_BARE = re.compile(r"([_^])(\\[A-Za-z]+)(?![A-Za-z{])")
"""An index that is one command, which only braces make safe."""

_POWERS = re.compile(r"\}\^\{")


def prose(text: str) -> str:
    r"""Words in LaTeX, for amsmath; mathematics between dollar signs goes through, its signs as commands.

    >>> prose("50 % of l_2, 2·10$^{7}$ mm², κ = 1")
    '50 \\% of l\\_2, 2$\\cdot $10$^{7}$ mm$^{2}$, $\\kappa $ = 1'
    >>> prose("10⁻³ and $−α_\\min$")
    '10$^{-3}$ and $-\\alpha _{\\min}$'
    """
    parts = re.split(r"\$([^$]*)\$", text)
    return "".join(escaped(part) if k % 2 == 0 else f"${mathematics(part)}$" for k, part in enumerate(parts))


def escaped(text: str) -> str:
    r"""The same of words without mathematics in them.

    >>> escaped("q\u0307 and σᵣ"), escaped("② ∓b")
    ('$\\dot{q}$ and $\\sigma _{r}$', '\\textcircled{2} $\\mp $b')
    """
    parts = _DOTTED.split(text)
    joined = "".join(rf"$\dot{{{part}}}$" if k % 2 else "".join(map(_sign, part)) for k, part in enumerate(parts))
    joined = _RUNS.sub("", joined)
    return _POWERS.sub("", joined)


def mathematics(latex: str) -> str:
    """LaTeX of mathematics with commands for the signs that are none of its own."""
    known = {sign: name for sign, name in MATHEMATICAL.items() if sign not in "<>|"}
    whole = _BARE.sub(r"\1{\2}", latex)
    return "".join(_ended(known[sign]) if sign in known else sign for sign in whole)


def letter(name: str) -> str:
    r"""A name of a file as a letter with an index; what is none as upright words.

    >>> letter("l2"), letter("wB"), letter("betaC"), letter("alpha"), letter("rise"), letter("theta_1"), letter("C_w")
    ('l_{2}', 'w_{B}', '\\beta_{C}', '\\alpha', '\\mathrm{rise}', '\\theta_{1}', 'C_{w}')
    """
    patterns = r"([A-Za-z]+?)_?(\d+\w?)", r"([a-z]+)_?([A-Z]\d*)", r"([A-Za-z])_([a-z])"
    match = next(filter(None, (re.fullmatch(pattern, name) for pattern in patterns)), None)
    stem, index = match.groups() if match else (name, "")
    known = stem in _GREEK.values()
    plain = f"\\{stem}" if known else stem if len(stem) == 1 else rf"\mathrm{{{stem.replace('_', ' ')}}}"
    return f"{plain}_{{{index}}}" if index else plain


def _sign(sign: str) -> str:
    if sign in MATHEMATICAL:
        return f"${_ended(MATHEMATICAL[sign])}$"
    known = _SPECIAL.get(sign) or _WORDS.get(sign)
    return known or (sign if sign <= _LATIN else rf"\texttt{{U+{ord(sign):04X}}}")


def _ended(command: str) -> str:
    """A command with a space after it, so that no letter runs into its name."""
    return command + " " if re.search(r"\\[A-Za-z]+$", command) else command
