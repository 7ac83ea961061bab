"""What is printed says what was derived: read again and worked out, parsed strictly, compiled, no line too long."""

import json
import re
import shutil
import subprocess
import tomllib
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from tests.helpers.latex_numbers import Reader

from assur.audit.equations import evaluate
from assur.cli.main import main
from assur.derivation.derivation import derive
from assur.derivation.document import document
from assur.derivation.numeric_example import example_branches
from assur.derived_topology import topology
from assur.kinematics.border import inputs_of
from assur.kinematics.home import home_values
from assur.kinematics.position import direct, inverse
from assur.model.formula import parse
from assur.model.registry import load_record

KATEX = Path(__file__).parent / "katex"
QUICK = ("zeng2019",)
DEEP = ("fivebar", "delta_4s", "three_crr", "orthoglide", "tripteron", "three_p2us")
NAMES = [*QUICK, *(pytest.param(name, marks=pytest.mark.deep) for name in DEEP)]


@lru_cache
def printed(name):
    return derive(load_record(name)).printed()


def text_of(name):
    return document(printed(name), topology(load_record(name)))


def letters_of(written, values, branch):
    """LaTeX -> number of every letter at a branch, angles as cosine and sine, rods as vectors too."""
    letters, solution = {}, written.solution
    signs = {root.symbol: written.printed.signs[root.symbol][0] for root in solution.roots}
    turned = {root.symbol: sign for root, sign in zip(solution.roots, branch.signs, strict=True)}
    for symbol, own in written.printed.letters.items():
        if own.function and symbol in values:
            pair = letters.setdefault(own.latex, [0.0, 0.0])
            pair[own.function == "sin"] = own.sense * values[symbol]
        elif symbol in signs:
            letters[signs[symbol]] = turned[symbol]
        elif symbol in values:
            letters[own.latex] = values[symbol]
    for radicand, root in written.printed.radicals.items():
        letters[root.name] = float(radicand.subs(values)) ** 0.5
    for latex in [*letters]:
        stem = re.fullmatch(r"(\w)_\{(\w*)x\}", latex)
        if stem:
            parts = [letters.get(f"{stem[1]}_{{{stem[2]}{axis}}}", 0.0) for axis in "xyz"]
            name = rf"\mathbf{{{stem[1]}}}"
            letters[f"{name}_{{{stem[2]}}}" if stem[2] else name] = np.array(parts)
    return letters


def result_values(own, record, values):
    """What the problem asks for: coordinates of the platform, or inputs that are lengths."""
    solution, symbols = own.written.solution, {symbol.name: symbol for symbol in own.written.printed.letters}
    if own.problem == "direct":
        return {
            symbols[axis]: float(formula.subs(values))
            for axis, formula in zip("xyz", solution.point, strict=True)
            if axis in symbols
        }
    lengths = {driven: solution.loops.lengths.get(driven.coordinate.index) for driven in record.inputs}
    return {symbols[driven.name]: driven.printed(values[own]) for driven, own in lengths.items() if own is not None}


@pytest.mark.parametrize("name", NAMES)
def test_every_printed_formula_holds_at_every_real_branch(name):
    checked = 0
    for own in printed(name).problems:
        written, record = own.written, load_record(name)
        home = written.solution.symbols.witness.home
        given = {symbol: float(value) for symbol, value in home.items()}
        senses = [written.printed.signs[root.symbol][1] for root in written.solution.roots]
        for branch in [branch for branch in example_branches(written.solution, given, senses) if branch.values][:8]:
            values = {**branch.values, **result_values(own, record, branch.values)}
            reader = Reader(letters_of(written, values, branch))
            for part in written.parts():
                for formula in (formula for block in part.blocks if not isinstance(block, str) for formula in block):
                    left, right = reader.value(formula.left), reader.value(" ".join(formula.rows))
                    scale = max(1.0, float(np.max(np.abs(left))))
                    assert np.allclose(left, right, rtol=0, atol=1e-8 * scale), formula.latex
                    checked += 1
    assert checked > 20


@pytest.mark.parametrize("name", [*NAMES, "planar_3rrr", pytest.param("three_rrc", marks=pytest.mark.deep)])
def test_the_table_of_branches_is_that_of_the_solvers(name):
    record = load_record(name)
    for own in printed(name).problems:
        solve = direct if own.problem == "direct" else inverse
        inside = [np.radians(value.value) if value.unit == "deg" else value.value for value in own.example.given]
        answer = solve(record, np.array(inside), method="closed form")
        solved = {s.mode: getattr(s, "pose" if own.problem == "direct" else "inputs") for s in answer}
        if own.written.solution.eliminant is not None:  # roots have numbers, and solutions letters
            ours = sorted([value.value for value in branch.values] for branch in own.example.branches)
            theirs = sorted([[*pose[:-1], np.degrees(pose[-1])] if record.platform.pose[-1] == "phi" else [*pose]
                             for pose in solved.values()])  # fmt: skip
            assert np.allclose(ours, theirs, atol=1e-7 * max(1.0, np.max(np.abs(theirs))))
            continue
        tabled = {
            branch.mode: [np.radians(v.value) if v.unit == "deg" else v.value for v in branch.values]
            for branch in own.example.branches
            if branch.values
        }
        assert tabled.keys() == {mode.rstrip("abcdefgh") for mode in solved}
        for mode, values in solved.items():
            assert np.allclose(tabled[mode], values, atol=1e-7 * max(1.0, np.max(np.abs(values))))


def test_the_document_has_its_parts_in_their_order():
    text = text_of("zeng2019")
    parts = ("Nomenclature", r"\Delta_{1} = +1", r"\kappa = 1", "link 11 hangs on base", "Set 1: link 9 and link 10",
             r"2l_{2}\cos\gamma &= H_{1}", "$B_{1}$ and $B_{2}$ are too far apart for link 9 and link 10 to meet",
             r"H_{1} \ne 0", r"so that $\gamma$ may have any value", "Set 2: link 4a", r"l_{6}\cos\theta_{4} &= -H_{2}",
             "Set 3: link 12 and link 7a", r"\cos\alpha &= \frac{", "There are 8 branches", "${+}{+}{+}$",
             r"\section{Velocities and singular configurations}", "= 0$: link 12 and parallelogram $")  # fmt: skip
    places = [text.index(part) for part in parts]
    assert places == sorted(places)
    assert r"z_{C_{1}} - z_{B_{1}} > 0" in text
    assert "k13" not in text


def formulas_in(text):
    displays = re.findall(r"\\begin\{(?:align\*?|gather)\}.*?\\end\{(?:align\*?|gather)\}", text, re.DOTALL)
    body = re.sub(r"\\begin\{(?:align\*?|gather)\}.*?\\end\{(?:align\*?|gather)\}", "", text, flags=re.DOTALL)
    return [*displays, *re.findall(r"\$([^$]+)\$", body)]


@pytest.mark.node
def test_katex_reads_every_formula_strictly(tmp_path):
    shutil.copytree(KATEX, tmp_path / "katex")
    words = ["install", "--prefer-offline", "--ignore-scripts", "--no-package-lock", "--no-audit", "--no-fund"]
    done = subprocess.run(
        ["npm", *words], cwd=tmp_path / "katex", capture_output=True, text=True, timeout=120, check=False
    )
    if done.returncode:
        pytest.skip(f"NOT CHECKED: whether KaTeX reads the formulas; npm cannot install: {done.stderr[-500:]}")
    formulas = sorted({formula for name in (*QUICK, "planar_3rrr") for formula in formulas_in(text_of(name))})
    assert len(formulas) > 100
    read = subprocess.run(
        ["node", "strict.cjs"], cwd=tmp_path / "katex", input=json.dumps(formulas), capture_output=True, text=True,
        timeout=120, check=True,
    )  # fmt: skip
    assert json.loads(read.stdout) == []


@pytest.mark.latex
@pytest.mark.parametrize("name", [*QUICK, "planar_3rpr", "planar_3rrr"])
def test_the_document_compiles_and_no_line_is_longer_than_its_column(name, tmp_path):
    (tmp_path / "d.tex").write_text(text_of(name), encoding="ascii")
    done = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "d.tex"], cwd=tmp_path, capture_output=True,
        timeout=120, check=False,
    )  # fmt: skip
    said = done.stdout.decode("utf-8", "replace")
    assert done.returncode == 0, said[-2000:]
    assert [line for line in said.splitlines() if line.startswith("Overfull")] == []


def test_the_page_on_the_seed_shows_formulas_of_its_document():
    page = (Path(__file__).parents[2] / "docs" / "derivations" / "zeng2019_derived.md").read_text(encoding="utf-8")
    shown = re.findall(r"\$\$\n(.*?)\n\$\$", page, re.DOTALL)
    printed_lines = {
        line.strip().removesuffix("\\\\").strip() for line in text_of("zeng2019").replace(" &=", " =").splitlines()
    }
    assert len(shown) == 10
    assert [formula for formula in shown if formula not in printed_lines] == []


def test_the_letters_of_the_page_on_the_seed_are_those_of_the_paper():
    """Derived quantities at an assembly, beside the paper's by the folder's own definitions, on the joint graph."""
    page = (Path(__file__).parents[2] / "docs" / "derivations" / "zeng2019_derived.md").read_text(encoding="utf-8")
    said = re.findall(r"`(\w+) = ([^`]+)`", page.partition("## Beside the paper")[2])
    assert len(said) == 9
    record = load_record("zeng2019")
    equations = tomllib.loads((record.file.parent / "reference" / "equations.toml").read_text(encoding="utf-8"))
    letters = {name: parse(text) for name, text in equations["definitions"].items()}
    own = printed("zeng2019").problems[0].written
    given = {symbol: float(value) for symbol, value in own.solution.symbols.witness.home.items()}
    senses = [own.printed.signs[root.symbol][1] for root in own.solution.roots]
    branches = [branch for branch in example_branches(own.solution, given, senses) if branch.values]
    solutions = {solution.mode: solution for solution in direct(record, inputs_of(record, home_values(record)))}
    order = printed("zeng2019").problems[0].order
    checked = 0
    for branch in branches:
        mode = "".join("+" if sign > 0 else "-" for _, sign in sorted(zip(order, branch.signs, strict=True)))
        values = np.array([*solutions[mode].joints.values()])
        derived = {symbol.name: value for symbol, value in branch.values.items()}
        for name, text in said:
            theirs = float(evaluate(record, parse(text), values, 0 * values, letters))
            assert abs(derived[name] - theirs) < 1e-8 * max(1.0, abs(theirs)), (name, text)
            checked += 1
    assert checked == 9 * 4


@pytest.mark.deep
def test_the_example_of_rods_oblique_to_their_hinges_is_an_answer_of_the_joint_graph(tmp_path):
    """The cranks' angles follow from where the rods point."""
    file, target = tmp_path / "own.toml", tmp_path / "own.tex"
    assert main(["new", str(file), "--limb", "R[y] P(4R)[x] R[y] R[y]"]) == 0
    assert main(["derive", str(file), "--latex", str(target)]) == 5
    text = target.read_text(encoding="ascii")
    pose = [float(value) for value in re.findall(r"\$[xyz] = (-?[\d.]+)\$ mm", text)]
    lines = re.findall(r"^\$\{.*", text, re.MULTILINE)
    rows = [[float(value) for value in re.findall(r"\$(-?\d+\.\d+)\$", line)] for line in lines]
    answer = np.degrees(inverse(load_record(file), pose).inputs).reshape(-1, 3)
    for row in rows:
        assert np.min(np.linalg.norm(answer - row, axis=1)) < 1e-3
    assert len(rows) == 16  # of 64, as many as a table has
