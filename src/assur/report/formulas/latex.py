r"""The little LaTeX of mechanism files and closed forms, such as `y_{A_1}` or `l_2^2-B^2/4`, as MathML.

Letters, digits, operators, brackets, `_`, `^`, groups, Greek letters, functions, words in `\text{}` or `\mathrm{}`,
`\mathbf{}`, `\sqrt{}`, `\frac{}{}` and matrices between `\begin{bmatrix}` and `\end{bmatrix}`.
What is not understood is shown as it stands.
"""

from __future__ import annotations

import re
from html import escape
from string import ascii_lowercase, ascii_uppercase

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η", "theta": "θ",
    "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ",
    "tau": "τ", "phi": "φ", "varphi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω", "Gamma": "Γ", "Delta": "Δ",
    "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ", "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω",
}  # fmt: skip
FUNCTIONS = ("sin", "cos", "tan", "cot", "arccos", "arcsin", "arctan", "det", "dim", "sgn")
OPERATORS = {
    "angle": "∠", "cdot": "·", "pm": "±", "parallel": "∥", "perp": "⊥", "times": "×", "cup": "∪", "cap": "∩",
    "Diamond": "◇", "partial": "∂",
}  # fmt: skip
LIMITS = {"sum": "<mo>∑</mo>", "bigcup": "<mo>⋃</mo>", "bigcap": "<mo>⋂</mo>", "min": "<mi>min</mi>"}
"""What carries its limits under and over it."""

BRACKETS = "()[]{}|"
SIGNS = {"-": "−", "'": "′"}
SPACES = {r"\,": "0.17em", r"\;": "0.28em", r"\ ": "0.33em", r"\quad": "1em"}
_TOKEN = re.compile(
    r"\\(?:text|mathrm)\{(?:\\.|[^{}\\])*\}|\\(?:begin|end)\{\w+\}|\\[A-Za-z]+|\\[{}_\\,; ]|\d+(?:\.\d+)?|\s+|.",
    re.DOTALL,
)
_WORDS = re.compile(r"\\(?:text|mathrm)\{(.*)\}", re.DOTALL)
ROW = r"\\"
BOLD = {ord(letter): 0x1D400 + k for k, letter in enumerate(ascii_uppercase + ascii_lowercase)}
"""Letters to their bold ones."""

SIZES = (r"\left", r"\right")
"""What only tells the brackets after them how large to be."""


def latex_mathml(source: str) -> str:
    """MathML of a piece of LaTeX, without the outer <math>.

    >>> latex_mathml(r"y_{A_1}")
    '<msub><mi>y</mi><msub><mi>A</mi><mn>1</mn></msub></msub>'
    """
    tokens = [token for token in _TOKEN.findall(source) if not token.isspace() and token not in SIZES]
    try:
        content, rest = _sequence(tokens, closing="")
    except IndexError:  # an argument is missing
        return f"<mtext>{escape(source)}</mtext>"
    return content if not rest else f"<mtext>{escape(source)}</mtext>"


def name_mathml(name: str) -> str:
    """MathML of a name in the code: Greek letters by name, digits and what follows a `_` as subscript.

    >>> name_mathml("l1"), name_mathml("s_alpha")
    ('<msub><mi>l</mi><mn>1</mn></msub>', '<msub><mi>s</mi><mi>α</mi></msub>')
    """
    head, _, tail = name.partition("_")
    if head in FUNCTIONS and tail:
        return f'<mrow><mi>{head}</mi><mo>\u2061</mo><mspace width="0.14em"/>{_argument(tail)}</mrow>'
    letters = head.rstrip("0123456789")
    digits = head[len(letters) :]
    below = (f"<mn>{digits}</mn>" if digits else "") + (name_mathml(tail) if tail else "")
    base = f"<mi>{GREEK.get(letters, escape(letters))}</mi>"
    if not below:
        return base
    return f"<msub>{base}{below if not (digits and tail) else f'<mrow>{below}</mrow>'}</msub>"


def _argument(name: str) -> str:
    parts = name.split("_minus_")
    inner = "<mo>−</mo>".join(name_mathml(part) for part in parts)
    return inner if len(parts) == 1 else f"{bracket('(')}{inner}{bracket(')')}"


def _sequence(tokens: list[str], closing: str) -> tuple[str, list[str]]:
    """Everything up to a closing token, and what is left after it."""
    parts: list[str] = []
    while tokens and tokens[0] != closing:
        parts.append("")
        parts[-1], tokens = _scripted(tokens)
    if closing:
        tokens = tokens[1:]
    return "".join(parts), tokens


def _scripted(tokens: list[str]) -> tuple[str, list[str]]:
    """One item with its sub- and superscript."""
    base, rest = ("<mrow></mrow>", tokens) if tokens[0] in "_^" else _item(tokens)
    scripts: dict[str, str] = {}
    while rest and rest[0] in "_^" and rest[0] not in scripts:
        mark = rest[0]
        scripts[mark], rest = _item(rest[1:])
    below, above = scripts.get("_", ""), scripts.get("^", "")
    function = base.removeprefix("<mi>").removesuffix("</mi>") in FUNCTIONS
    under, over = ("munder", "mover") if base in LIMITS.values() else ("msub", "msup")
    if below and above:
        tag = "munderover" if under == "munder" else "msubsup"
        base = f"<{tag}>{base}{below}{above}</{tag}>"
    elif below or above:
        tag = under if below else over
        base = f"<{tag}>{base}{below or above}</{tag}>"
    argument = function and bool(rest) and rest[0] != "("
    return (f'{base}<mo>\u2061</mo><mspace width="0.14em"/>' if argument else base), rest


def _item(tokens: list[str]) -> tuple[str, list[str]]:
    token, rest = tokens[0], tokens[1:]
    if token == "{":
        inner, rest = _sequence(rest, "}")
        return _row(inner), rest
    if token == r"\begin{bmatrix}":
        return _matrix(rest)
    if token == r"\sqrt":
        inner, rest = _item(rest)
        return f"<msqrt>{inner}</msqrt>", rest
    if token == r"\mathbf":
        inner, rest = _item(rest)
        return _bold(inner), rest
    if token == r"\frac":
        above, rest = _item(rest)
        below, rest = _item(rest)
        return f"<mfrac>{above}{below}</mfrac>", rest
    return _symbol(token), rest


def _bold(mathml: str) -> str:
    """Letters upright and bold, as those of vectors are.

    >>> _bold("<mi>u</mi>") == "<mi>\U0001d42e</mi>"
    True
    """
    return re.sub(r"<mi>([A-Za-z])</mi>", lambda found: f"<mi>{found[1].translate(BOLD)}</mi>", mathml)


def _matrix(tokens: list[str]) -> tuple[str, list[str]]:
    """The rows of a matrix up to its end, and what is left after it."""
    rows = [[""]]
    while tokens[0] != r"\end{bmatrix}":
        if tokens[0] == ROW:
            rows.append([""])
            tokens = tokens[1:]
        elif tokens[0] == "&":
            rows[-1].append("")
            tokens = tokens[1:]
        else:
            part, tokens = _scripted(tokens)
            rows[-1][-1] += part
    cells = "".join("<mtr>" + "".join(f"<mtd>{cell}</mtd>" for cell in row) + "</mtr>" for row in rows)
    return f'<mrow class="matrix"><mtable>{cells}</mtable></mrow>', tokens[1:]


def _symbol(token: str) -> str:
    if said := _WORDS.fullmatch(token):
        words = re.sub(r"\\(.)", r"\1", said[1])
        return f"<mtext>{escape(words)}</mtext>"
    if token in SPACES:
        return f'<mspace width="{SPACES[token]}"/>'
    word = token.lstrip("\\")
    if token[0] == "\\":
        if word in BRACKETS and word:
            return bracket(word)
        if word in LIMITS:
            return LIMITS[word]
        if word in GREEK or word in FUNCTIONS:
            return f"<mi>{GREEK.get(word, word)}</mi>"
        return f"<mo>{OPERATORS[word]}</mo>" if word in OPERATORS else f"<mtext>{escape(token)}</mtext>"
    if token[0].isdigit():
        return f"<mn>{token}</mn>"
    if token in BRACKETS:
        return bracket(token)
    return f"<mi>{escape(token)}</mi>" if token.isalpha() else f"<mo>{SIGNS.get(token, escape(token))}</mo>"


def bracket(symbol: str) -> str:
    """A bracket that neither grows nor takes space."""
    return f'<mo stretchy="false" lspace="0" rspace="0">{symbol}</mo>'


def _row(inner: str) -> str:
    """A group as one element."""
    single = re.fullmatch(r"<(\w+)>[^<]*</\1>", inner) or re.fullmatch(r"<(msub|msup)>(?:(?!<\1>).)*</\1>", inner)
    return inner if single else f"<mrow>{inner}</mrow>"
