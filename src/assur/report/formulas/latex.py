r"""The little LaTeX of mechanism files, closed forms and pages, such as `y_{A_1}` or `l_2^2-B^2/4`, as MathML.

Letters, digits, operators, brackets, `_`, `^`, groups, Greek letters, functions, words in `\text{}`, `\mathrm{}` or
`\operatorname{}`, `\mathbf{}`, `\sqrt{}`, `\frac{}{}` and `\frac12`, `\binom{}{}`, `\phantom{}`, `\tag{}`, accents, and
tables between `\begin{bmatrix}` and `\end{bmatrix}`. What is not understood is shown as it stands, as an error.
"""

from __future__ import annotations

import re
from html import escape

from assur.report.formulas.symbols import (
    ACCENTS,
    BOLD,
    BRACKETS,
    CLOSE,
    FRACTIONS,
    FUNCTIONS,
    GREEK,
    JOINING,
    LIMITS,
    OPERATORS,
    SIGNS,
    SPACES,
    TABLES,
)

_TOKEN = re.compile(
    r"\\(?:text|mathrm|operatorname|tag)\{(?:\\.|[^{}\\])*\}|\\(?:begin|end)\{\w+\}|\\[A-Za-z]+|\\[{}_\\,; $%&#]"
    r"|\d+(?:\.\d+)?|\s+|.",
    re.DOTALL,
)
_SIZES = re.compile(r"\\(?:left|right|[bB]igg?[lr]?)(?![A-Za-z])\.?")
"""What only tells the brackets after them how large to be; a full stop is no bracket."""

_WORDS = re.compile(r"\\(text|mathrm|operatorname|tag)\{(.*)\}", re.DOTALL)
_ORDINARY = re.compile(r"</(?:mi|mn|msub|msup|msubsup|mfrac|msqrt|mover|mrow)>$|[)\]}]</mo>$")
_JOINING = re.compile(rf">(?:[{re.escape(JOINING)}]|&[lg]t;)</mo>$")
_FUNCTION = re.compile(rf"(?:<m(?:sub|sup|subsup|under)>)?<mi>(?:{'|'.join([*FUNCTIONS, 'min', 'max'])})</mi>")
ROW = r"\\"
APPLY = '<mo>\u2061</mo><mspace width="0.14em"/>'
THIN = '<mspace width="0.17em"/>'


class _UnreadableError(ValueError):
    """An argument or an end is missing, or one stands where none can."""


def latex_mathml(source: str) -> str:
    r"""MathML of a piece of LaTeX, without the outer <math>; what is not understood is inside <merror>.

    >>> latex_mathml(r"y_{A_1}"), latex_mathml(r"\frac12")
    ('<msub><mi>y</mi><msub><mi>A</mi><mn>1</mn></msub></msub>', '<mfrac><mn>1</mn><mn>2</mn></mfrac>')
    """
    try:
        return _Reader(source).sequence()
    except (_UnreadableError, RecursionError):
        return _as_it_stands(source)


_OF_POINT = re.compile(r"([a-z]+)([A-Z]\d*)")
"""A quantity of a point, as rA."""


def symbol_mathml(latex: str, name: str) -> str:
    r"""MathML of a symbol: of its LaTeX where that is understood, else of its name.

    >>> symbol_mathml(r"\theta_1", "q") == latex_mathml(r"\theta_1"), symbol_mathml(r"\theta_{1", "q")
    (True, '<mi>q</mi>')
    """
    return latex_mathml(latex) if latex != name and is_understood(latex) else name_mathml(name)


def is_understood(latex: str) -> bool:
    r"""Whether a piece of LaTeX is within what is read here.

    >>> is_understood("y_{A_1}"), is_understood(r"\theta_{1"), is_understood("")
    (True, False, False)
    """
    return bool(latex.strip()) and "<merror" not in latex_mathml(latex)


def name_mathml(name: str) -> str:
    """MathML of a name in the code: Greek letters by name; as subscripts digits, a point and what follows a `_`.

    >>> name_mathml("l1"), name_mathml("s_alpha")
    ('<msub><mi>l</mi><mn>1</mn></msub>', '<msub><mi>s</mi><mi>α</mi></msub>')
    >>> name_mathml("alphaA"), name_mathml("rA")
    ('<msub><mi>α</mi><mi>A</mi></msub>', '<msub><mi>r</mi><mi>A</mi></msub>')
    """
    of_point = _OF_POINT.fullmatch(name)
    if of_point and (len(of_point[1]) == 1 or of_point[1] in GREEK):
        name = f"{of_point[1]}_{of_point[2]}"
    head, _, tail = name.partition("_")
    if head in FUNCTIONS and tail:
        return f"<mrow><mi>{head}</mi>{APPLY}{_argument(tail)}</mrow>"
    letters = head.rstrip("0123456789")
    digits = head[len(letters) :]
    below = (f"<mn>{digits}</mn>" if digits else "") + (name_mathml(tail) if tail else "")
    base = f"<mi>{GREEK.get(letters, escape(letters))}</mi>"
    if not below:
        return base
    return f"<msub>{base}{below if not (digits and tail) else f'<mrow>{below}</mrow>'}</msub>"


def bracket(symbol: str) -> str:
    """A bracket that neither grows nor takes space."""
    return f'<mo stretchy="false" lspace="0" rspace="0">{symbol}</mo>'


def close(sign: str) -> str:
    """A sign without space about it, as that of what is negative."""
    return f'<mo lspace="0" rspace="0">{sign}</mo>'


def _argument(name: str) -> str:
    parts = name.split("_minus_")
    inner = "<mo>−</mo>".join(name_mathml(part) for part in parts)
    return inner if len(parts) == 1 else f"{bracket('(')}{inner}{bracket(')')}"


class _Reader:
    """Reads tokens one by one; what is left is a stack with the next one on top."""

    def __init__(self, source: str) -> None:
        tokens = _TOKEN.findall(_SIZES.sub("", source))
        self.left: list[str] = [token for token in tokens if not token.isspace()][::-1]

    @property
    def next(self) -> str:
        """The token that comes next, "" at the end."""
        return self.left[-1] if self.left else ""

    def take(self) -> str:
        """The next token, which must be there."""
        if not self.left:
            raise _UnreadableError
        return self.left.pop()

    def sequence(self, *closing: str) -> str:
        """Everything up to one of the closing tokens, which stays; without any, up to the end."""
        parts: list[str] = []
        while self.left and self.next not in closing:
            parts.append(_spaced(self.scripted(), parts[-1] if parts else ""))
        return "".join(parts)

    def scripted(self) -> str:
        """One item with its sub- and superscript."""
        base = "<mrow></mrow>" if self.next in ("_", "^") else self.atom(self.take())
        scripts: dict[str, str] = {}
        while self.next in ("_", "^") and self.next not in scripts:
            mark = self.take()
            scripts[mark] = self.argument()
        below, above = scripts.get("_", ""), scripts.get("^", "")
        function = base.removeprefix("<mi>").removesuffix("</mi>") in FUNCTIONS
        under, over = ("munder", "mover") if base in LIMITS.values() else ("msub", "msup")
        if below and above:
            tag = "munderover" if under == "munder" else "msubsup"
            base = f"<{tag}>{base}{below}{above}</{tag}>"
        elif below or above:
            tag = under if below else over
            base = f"<{tag}>{base}{below or above}</{tag}>"
        return base + APPLY if function and self.left and self.next not in ("(", ")", "}", "&", ROW) else base

    def argument(self) -> str:
        """What a command or a script takes: a group or one sign, of a number its first digit, as in TeX."""
        token = self.take()
        if token[0].isdigit() and len(token) > 1:
            self.left += _TOKEN.findall(token[1:])[::-1]
            token = token[0]
        return self.atom(token)

    def atom(self, token: str) -> str:
        """What a token begins."""
        if token == "{":
            return _row(self.group("}"))
        if token.startswith(r"\begin"):
            return self.table(token.removeprefix(r"\begin{").removesuffix("}"))
        if token == "}" or token.startswith(r"\end"):
            raise _UnreadableError
        if token == r"\sqrt":
            return f"<msqrt>{self.argument()}</msqrt>"
        if token == r"\mathbf":
            return _bold(self.argument())
        if token == r"\phantom":
            return f"<mphantom>{self.argument()}</mphantom>"
        if token in FRACTIONS:
            return f"<mfrac>{self.argument()}{self.argument()}</mfrac>"
        if token == r"\binom":
            over = f'<mfrac linethickness="0">{self.argument()}{self.argument()}</mfrac>'
            return f"<mrow><mo>(</mo>{over}<mo>)</mo></mrow>"
        if token in ACCENTS:
            return f'<mover accent="true">{self.argument()}<mo stretchy="false">{ACCENTS[token]}</mo></mover>'
        return _symbol(token)

    def group(self, closing: str) -> str:
        """What stands before a closing token, which must come."""
        inner = self.sequence(closing)
        self.take()
        return inner

    def table(self, name: str) -> str:
        """The rows of a table up to its end."""
        if name not in TABLES:
            raise _UnreadableError
        end, rows = rf"\end{{{name}}}", [[""]]
        while True:
            rows[-1][-1] = self.sequence("&", ROW, end)
            separator = self.take()
            if separator == end:
                break
            if separator == ROW:
                rows.append([])
            rows[-1].append("")
        cells = "".join("<mtr>" + "".join(f"<mtd>{cell}</mtd>" for cell in row) + "</mtr>" for row in rows if any(row))
        opening, closing = (f"<mo>{sign}</mo>" if sign else "" for sign in TABLES[name])
        class_ = "matrix" if name == "bmatrix" else "table" if name == "matrix" else name
        return f'<mrow class="{class_}">{opening}<mtable>{cells}</mtable>{closing}</mrow>'


def _spaced(markup: str, before: str) -> str:
    """A sign close to what it belongs to, a thin space before a function, none about a slash."""
    sign = markup.removeprefix("<mo>").removesuffix("</mo>")
    if sign == "/" or (sign in CLOSE and (not before or _JOINING.search(before))):
        return close(sign)
    return THIN + markup if _FUNCTION.match(markup) and _ORDINARY.search(before) else markup


def _bold(mathml: str) -> str:
    """Letters upright and bold, as those of vectors are.

    >>> _bold("<mi>u</mi>") == "<mi>\U0001d42e</mi>"
    True
    """
    return re.sub(r"<mi>([A-Za-z])</mi>", lambda match: f"<mi>{match[1].translate(BOLD)}</mi>", mathml)


def _symbol(token: str) -> str:
    if said := _WORDS.fullmatch(token):
        words = escape(re.sub(r"\\(.)", r"\1", said[2]))
        return f'<mspace width="2em"/><mtext>({words})</mtext>' if said[1] == "tag" else f"<mtext>{words}</mtext>"
    if token in SPACES:
        return f'<mspace width="{SPACES[token]}"/>'
    if token in BRACKETS:
        return bracket(token)
    if token[0] == "\\":
        return _command(token)
    if token[0].isdigit():
        return f"<mn>{token}</mn>"
    return f"<mi>{escape(token)}</mi>" if token.isalpha() else f"<mo>{SIGNS.get(token, escape(token))}</mo>"


def _command(token: str) -> str:
    word = token[1:]
    if word in ("{", "}"):
        return bracket(word)
    if word in ("$", "%", "&", "#", "_"):
        return f"<mi>{escape(word)}</mi>"
    if word in LIMITS:
        return LIMITS[word]
    if word in GREEK or word in FUNCTIONS:
        return f"<mi>{GREEK.get(word, word)}</mi>"
    return f"<mo>{OPERATORS[word]}</mo>" if word in OPERATORS else _as_it_stands(token)


def _as_it_stands(source: str) -> str:
    return f"<merror><mtext>{escape(source)}</mtext></merror>"


def _row(inner: str) -> str:
    """A group as one element."""
    single = re.fullmatch(r"<(\w+)>[^<]*</\1>", inner) or re.fullmatch(r"<(msub|msup)>(?:(?!<\1>).)*</\1>", inner)
    return inner if single else f"<mrow>{inner}</mrow>"
