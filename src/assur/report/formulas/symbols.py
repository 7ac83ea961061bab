r"""What the words of the little LaTeX stand for: letters, functions, operators, spaces, accents, tables.

A word is what follows a backslash. `assur.report.formulas.latex` reads them; what is in none of these tables it does
not understand.
"""

from __future__ import annotations

from string import ascii_lowercase, ascii_uppercase

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η", "theta": "θ",
    "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ",
    "tau": "τ", "phi": "φ", "varphi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω", "Gamma": "Γ", "Delta": "Δ",
    "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ", "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω",
}  # fmt: skip
FUNCTIONS = ("sin", "cos", "tan", "cot", "arccos", "arcsin", "arctan", "det", "dim", "sgn", "log", "exp", "deg")
OPERATORS = {
    "angle": "∠", "cdot": "·", "pm": "±", "parallel": "∥", "perp": "⊥", "times": "×", "cup": "∪", "cap": "∩",
    "Diamond": "◇", "partial": "∂", "le": "≤", "ge": "≥", "ne": "≠", "approx": "≈", "in": "∈", "to": "→",
    "equiv": "≡", "ldots": "…", "cdots": "⋯",
}  # fmt: skip
LIMITS = {
    "sum": "<mo>∑</mo>", "prod": "<mo>∏</mo>", "bigcup": "<mo>⋃</mo>", "bigcap": "<mo>⋂</mo>",
    "min": "<mi>min</mi>", "max": "<mi>max</mi>",
}  # fmt: skip
"""What carries its limits under and over it."""

BRACKETS = "()[]{}|"
SIGNS = {"-": "−", "'": "′"}
SPACES = {r"\,": "0.17em", r"\;": "0.28em", r"\ ": "0.33em", r"\quad": "1em", r"\qquad": "2em"}
FRACTIONS = (r"\frac", r"\tfrac", r"\dfrac")
ACCENTS = {
    r"\bar": "¯", r"\dot": "˙", r"\ddot": "¨", r"\hat": "^", r"\tilde": "~", r"\vec": "→", r"\check": "ˇ",
}  # fmt: skip
TABLES = {
    "matrix": ("", ""), "bmatrix": ("", ""), "pmatrix": ("(", ")"), "vmatrix": ("|", "|"), "cases": ("{", ""),
    "aligned": ("", ""),
}  # fmt: skip
"""A table's brackets; those of a `bmatrix` are drawn by the style sheet, as the class `matrix`."""

BOLD = {ord(letter): 0x1D400 + k for k, letter in enumerate(ascii_uppercase + ascii_lowercase)}
"""Letters to their bold ones."""

CLOSE = frozenset("−+±∥⊥")
"""Signs that stand close to what follows where nothing comes before that they could join to it."""

JOINING = "([{=≤≥≠≈∈→,"
"""After these, and after < and >, such a sign has nothing to join."""
