"""The C of a closed form: compiled without a warning, right by its own test, and equal to Python on many inputs."""

import ctypes
import re
import shutil
import subprocess
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from assur.derivation.derivation import derive
from assur.errors import UsageError
from assur.export.c99 import c99_text
from assur.export.c99_text import identifier
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.kernels.reading import names_of
from assur.model.registry import load_record

GCC = ("gcc", "-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-pedantic")
ROOTS = ("zeng2019", "fivebar", "delta_4s", "three_crr")
POLYNOMIALS = ("planar_3rpr", "planar_3rrr", "three_rps")
PLACES = 100_000
pytestmark = pytest.mark.compiler


UNDECIDED = -3
DERIVED = " derived"
"""Behind a name: its closed form is the derived one."""


@lru_cache
def record_of(name):
    record = load_record(name.removesuffix(DERIVED))
    if not name.endswith(DERIVED):
        return record
    text = derive(record).closed_form()
    return record.with_closed_form(names_of(text, Path("closed_form.py"))["CLOSED_FORM"], text)


@lru_cache
def source(name):
    return c99_text(record_of(name))


def compiled(name, folder, *words):
    name = name.replace(" ", "_")
    path = folder / f"{name}.c"
    path.write_text(source(name.replace("_derived", DERIVED)), encoding="ascii")
    target = folder / f"{name}{'.so' if '-shared' in words else ''}"
    subprocess.run([*GCC, *words, str(path), "-o", str(target), "-lm"], check=True, capture_output=True)
    return target


class Library:
    """The functions of a file, over NumPy arrays."""

    def __init__(self, name, folder):
        self.record = record_of(name)
        self.name = identifier(self.record.name)
        self.c = ctypes.CDLL(str(compiled(name, folder, "-shared", "-fPIC")))
        sizes = dict(line.split()[1:3] for line in source(name).splitlines() if line.startswith("#define"))
        upper = self.name.upper()
        self.most = {problem: int(sizes[f"{upper}_{problem.upper()}_MAX"]) for problem in ("direct", "inverse")}
        m, n, rows, margins, factors, signs = (
            int(sizes[f"{upper}_{part}"]) for part in ("COORDINATES", "INPUTS", "ROWS", "MARGINS", "FACTORS", "SIGNS")
        )
        self.type = np.dtype(
            [("pose", float, m), ("inputs", float, n), ("jp", float, (rows, m)), ("jq", float, (rows, n)),
             ("margins", float, margins), ("factors", float, factors), ("signs", np.int32, signs)], align=True
        )  # fmt: skip
        self.dimensions = ctypes.addressof(ctypes.c_char.in_dll(self.c, f"{self.name}_dimensions"))

    def solve(self, problem, given):
        """Number of solutions (N,), and the solutions (N, most)."""
        function = getattr(self.c, f"{self.name}_{problem}")
        function.argtypes = [ctypes.c_void_p] * 3
        out, count = np.zeros((len(given), self.most[problem]), self.type), np.zeros(len(given), dtype=int)
        given = np.ascontiguousarray(given)
        step, row = given.strides[0], out.strides[0]
        for k in range(len(given)):
            count[k] = function(self.dimensions, given.ctypes.data + k * step, out.ctypes.data + k * row)
        return count, out


@pytest.fixture(scope="module")
def library(request, tmp_path_factory):
    return Library(request.param, tmp_path_factory.mktemp(request.param))


def drawn(record, problem, number):
    """Problems about home and far from it, of which some have no answer: poses (N, m), or inputs (N, n)."""
    home = pose_of(record, home_values(record))
    if problem == "direct":
        home = np.asarray(next(iter(inverse(record, home, method="closed form"))).inputs)
    random = np.random.default_rng(3)
    sizes = np.geomspace(0.01, 4.0, number)[:, None] * np.maximum(np.abs(home), 0.3 * np.max(np.abs(home)))
    return home + sizes * random.uniform(-1.0, 1.0, (number, len(home)))


def test_a_mechanism_without_closed_form_is_refused(tmp_path):
    shutil.copy(load_record("fivebar").file, tmp_path / "mechanism.toml")
    with pytest.raises(UsageError, match="no closed form"):
        c99_text(load_record(tmp_path / "mechanism.toml"))


@pytest.mark.parametrize(
    "name", [*ROOTS, *POLYNOMIALS, "gough_stewart", pytest.param("three_rrc", marks=pytest.mark.deep)]
)
def test_it_compiles_without_a_warning_and_its_own_test_is_fine(name, tmp_path):
    target = compiled(name, tmp_path, f"-D{identifier(name).upper()}_TEST")
    assert subprocess.run([str(target)], check=True, capture_output=True, text=True).stdout == f"{name}: fine\n"


def test_a_dimension_may_have_the_name_of_a_keyword_of_c(tmp_path):
    folder = load_record("fivebar").file.parent
    for name in ("mechanism.toml", "closed_form.py"):
        text = (folder / name).read_text(encoding="utf-8")
        (tmp_path / name).write_text(re.sub(r"\bl1\b", "short", text), encoding="utf-8")
    source_file, target = tmp_path / "own.c", tmp_path / "own"
    source_file.write_text(c99_text(load_record(tmp_path)), encoding="ascii")
    subprocess.run([*GCC, "-DFIVEBAR_TEST", str(source_file), "-o", str(target), "-lm"], check=True)
    assert subprocess.run([str(target)], check=True, capture_output=True, text=True).stdout == "fivebar: fine\n"


@pytest.mark.parametrize(
    "library",
    [*ROOTS, *(pytest.param(name + DERIVED, marks=pytest.mark.deep) for name in ("zeng2019", "linear_delta_4s"))],
    indirect=True,
)
@pytest.mark.parametrize("problem", ["direct", "inverse"])
def test_branches_of_roots_are_python_s_on_many_inputs(library, problem):
    record = library.record
    given = drawn(record, problem, PLACES)
    count, out = library.solve(problem, given)
    answer = (direct if problem == "direct" else inverse)(record, given, method="closed form")
    own = answer.poses if problem == "direct" else answer.inputs
    exists = answer.exists & np.all(np.isfinite(own), axis=-1)
    assert np.any(count > 0)
    assert np.any(count == 0) or np.all(answer.exists)  # some have no answer, or all have all
    assert np.mean(count == np.count_nonzero(exists, axis=-1)) > 0.9999  # where a margin is rounding they may differ
    same = np.flatnonzero(count == np.count_nonzero(exists, axis=-1))
    field = out["pose" if problem == "direct" else "inputs"]
    listed = np.arange(out.shape[1]) < count[:, None]
    scale = max(1.0, float(np.max(np.abs(given))))
    worst = np.abs(field[same][listed[same]] - own[same][exists[same]])
    assert np.max(worst) < 1e-9 * scale


@pytest.mark.parametrize(
    "library",
    [*POLYNOMIALS, *(pytest.param(name + DERIVED, marks=pytest.mark.deep) for name in ("planar_3rrr", "three_rps"))],
    indirect=True,
)
def test_roots_of_polynomials_are_python_s_where_none_are_double(library):
    record, number = library.record, 2_000
    given = drawn(record, "direct", number)
    count, out = library.solve("direct", given)
    answer = direct(record, given, method="closed form")
    exists = answer.exists
    equal = count == np.count_nonzero(exists, axis=-1)
    assert np.mean(equal) > 0.995
    for k in np.flatnonzero(equal)[:500]:
        ours, theirs = out["pose"][k][: count[k]], answer.poses[k][exists[k]]
        gaps = np.max(np.abs(ours[:, None] - theirs[None]), axis=-1)
        assert count[k] == 0 or np.max(np.min(gaps, axis=1)) < 1e-5 * max(1.0, np.max(np.abs(theirs)))


@pytest.mark.parametrize("library", ["zeng2019"], indirect=True)
def test_where_the_platform_moves_by_itself_no_number_of_solutions_is_told(library):
    """B = yA1 - l3 - yA2 vanishes, by which the formulas divide."""
    second = 12.0
    count, _ = library.solve("direct", np.array([[second + library.record.values.l3, second, 0.0]]))
    assert [*count] == [UNDECIDED]


@pytest.mark.deep
@pytest.mark.parametrize("library", ["three_rps" + DERIVED], indirect=True)
def test_where_roots_are_double_no_fewer_solutions_are_told(library):
    """Legs of equal lengths have eight poses, of which two at a time share the angle of a leg."""
    count, _ = library.solve("direct", np.array([[250.0, 250.0, 250.0], [250.0, 251.0, 250.0], [250.0, 250.0, 280.0]]))
    assert [*count] == 3 * [UNDECIDED]


@pytest.mark.parametrize("library", ["zeng2019", "delta_4s"], indirect=True)
def test_velocities_are_those_of_differences(library):
    """Jp v = Jq dq along a small step of the pose, in the same working mode."""
    given = drawn(library.record, "inverse", 200)[:40]
    step = 1e-6 * np.max(np.abs(given))
    count, out = library.solve("inverse", given)
    checked = 0
    for k in np.flatnonzero(count):
        moved = given[k] + step * np.array([0.6, -0.5, 0.7])
        number, near = library.solve("inverse", moved[None])
        if number[0] != count[k]:
            continue
        for first, second in zip(out[k][: count[k]], near[0][: number[0]], strict=True):
            left, right = (
                first["jp"] @ (second["pose"] - first["pose"]),
                first["jq"] @ (second["inputs"] - first["inputs"]),
            )
            size = step * max(np.max(np.abs(first["jp"])), np.max(np.abs(first["jq"])))
            assert np.max(np.abs(left - right)) < 1e-3 * size + 1e-12
            checked += 1
    assert checked > 20


def test_what_is_no_number_is_an_error(tmp_path):
    count, _ = Library("fivebar", tmp_path).solve("direct", np.array([[np.nan, 0.0], [1e70, 0.0]]))
    assert count.tolist() == [-1, -1]
