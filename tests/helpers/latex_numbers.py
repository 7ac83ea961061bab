"""Formulas in LaTeX worked out in numbers and vectors, by a reader that shares nothing with what wrote them."""

import math
import re

import numpy as np


class Reader:
    """Reads one side of a formula; `letters` are LaTeX -> a number, a vector (3,), or (cosine, sine) of an angle."""

    def __init__(self, letters):
        self.letters, self.names = letters, sorted(letters, key=len, reverse=True)

    def value(self, latex):
        self.left = latex.strip()
        total = self.sum()
        assert not self.left, f"{self.left} is left of {latex}"
        return total

    def take(self, pattern):
        self.left = re.sub(r"^(?:\s|\\,)+", "", self.left)
        match = re.match(pattern, self.left)
        if match:
            self.left = self.left[match.end() :]
        return match

    def sum(self):
        sign = -1.0 if self.take("-") else 1.0
        total = sign * self.product()
        while match := self.take(r"[+-]"):
            part = self.product()
            total = total + part if match[0] == "+" else total - part
        return total

    def product(self):
        total = self.power()
        while True:
            if self.take(r"\\times"):
                total = np.cross(total, self.power())
            elif self.take(r"\\cdot"):
                total = np.dot(total, self.power())
            elif re.match(r"(?:\s|\\,)*(?:$|[-+)}|,]|\\right)", self.left):
                return total
            else:
                total = total * self.power()

    def power(self):
        base = self.factor()
        if match := self.take(r"\^\{(-?\d+)(?:/(\d+))?\}"):
            power = int(match[1]) / int(match[2] or 1)
            return np.dot(base, base) if np.ndim(base) else base**power
        return base

    def factor(self):
        if match := self.take(r"\d+(?:\.\d+)?"):
            return float(match[0])
        if self.take(r"\\frac"):
            above, below = self.group(), self.group()
            return above / below
        if self.take(r"\\sqrt"):
            return math.sqrt(self.group())
        if match := self.take(r"(?:\\left)?[(|]"):
            parts = [self.sum()]
            while self.take(","):
                parts.append(self.sum())
            assert self.take(r"(?:\\right)?[)|]")
            return parts[0] if len(parts) == 1 else np.array(parts)
        if match := self.take(r"\\(cos|sin)(?:\^\{(\d+)\})?\s*"):
            return self.letter()[match[1] == "sin"] ** int(match[2] or 1)
        return self.letter()

    def group(self):
        assert self.take(r"\{")
        inner = self.sum()
        assert self.take(r"\}")
        return inner

    def letter(self):
        name = next((name for name in self.names if self.left.startswith(name)), None)
        assert name, f"no letter at {self.left}"
        self.left = self.left[len(name) :]
        return self.letters[name]
