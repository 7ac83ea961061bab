"""The text of a kernel is worked out as Python would work it out, to the last bit, over every number type."""

import ast
import importlib.util
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import assur
from assur.errors import MechanismFileError
from assur.kinematics import border
from assur.kinematics.modes import sign_axes, sign_names
from assur.model.kernels.faults import LENGTH, STEPS, FormFault
from assur.model.kernels.library import ALGEBRA, BUILTINS, DECLARATIONS
from assur.model.kernels.reading import names_of
from assur.model.registry import load_record
from assur.numerics.intervals.interval import as_interval
from assur.numerics.number_types import Floats, Intervals, Symbols
from assur.numerics.recording.tape import Recorder

FILE = Path("closed_form.py")
ROOT = Path(__file__).parents[3]


def kernel(body, arguments="ns, x"):
    """A function whose body is given."""
    lines = "\n".join(f"    {line}" for line in body.splitlines())
    return names_of(f"def f({arguments}):\n{lines}\n", FILE)["f"]


def leaves(value):
    """Numbers of an answer, in order."""
    if isinstance(value, dict | SimpleNamespace) or hasattr(value, "margins"):
        return [leaf for part in (value if isinstance(value, dict) else vars(value)).values() for leaf in leaves(part)]
    if isinstance(value, tuple | list):
        return [leaf for part in value for leaf in leaves(part)]
    return [np.asarray(value, dtype=float)]


@pytest.mark.parametrize("name", [name for name in assur.names() if load_record(name).closed_form])
def test_every_built_in_closed_form_gives_the_bits_that_python_gives(name):
    record = load_record(name)
    path = record.folder / "closed_form.py"
    spec = importlib.util.spec_from_file_location("as_python", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    rng, ns = np.random.default_rng(5), Floats()
    poses = border.pose_components(record, rng.normal(size=(3, len(record.platform.pose))) * 100)
    signs = sign_axes(sign_names(record, "inverse"))
    answers = []
    with np.errstate(all="ignore"):
        for form in (record.closed_form, module.CLOSED_FORM):
            branch = form.inverse(ns, record.values, poses, signs)
            parts = [branch]
            kernels = (form.joints, form.factors, form.jacobians, form.quantities or form.factors)
            parts += [kernel(ns, record.values, branch.core) for kernel in kernels]
            answers.append(leaves(parts))
    assert len(answers[0]) > 20
    for ours, theirs in zip(*answers, strict=True):
        np.testing.assert_array_equal(ours, theirs)


@pytest.mark.parametrize(
    ("body", "value"),
    [
        ("return x + 1", 4.0),
        ("return x**2 + x**-1 - x**0", 9 + 1 / 3 - 1),
        ("a, (b, *c) = 1, (2, 3, 4)\nreturn a + b * x + c[1]", 11.0),
        ("total = 0\nfor k, part in enumerate((x, x), 1):\n    total += k * part\nreturn total", 9.0),
        ("return sum(k * x for k in range(4) if k != 2)", 12.0),
        ("return {f'q{k}': k * x for k in (1, 2)}['q2']", 6.0),
        ("rows = [x]\nrows.append(2)\nreturn len(rows) * rows[-1]", 4),
        ("core = SimpleNamespace(a=x)\nreturn getattr(core, 'a') + core.a", 6.0),
        ("if 'a' in {'a': 1} and not None is None:\n    return 1\nelif 2 > 1 >= 1:\n    return 2\nreturn 3", 2),
        ("return (1, 2, 3)[1:][0] if x is not None else 0", 2),
        ("k = 5\nrow = tuple(k for k in (1, 2))\nreturn k + row[0]", 6),
        ("return dict(a=1, **{'b': 2})['b'] - (+1)", 1),
        ("return [a * b for a in (1, 2) for b in (3, 4)][3] % 5 // 2", 1),
    ],
)
def test_what_a_text_means_is_what_it_means_in_python(body, value):
    text = "from types import SimpleNamespace\n" + "def f(ns, x):\n" + "\n".join("    " + t for t in body.split("\n"))
    python = {}
    exec(text, python)
    assert names_of(text, FILE)["f"](Floats(), 3.0) == python["f"](Floats(), 3.0) == value


def test_small_powers_work_in_every_number_type():
    cube = kernel("return x**3 + ns.sqrt(x**2)")
    assert cube(Floats(), np.array([2.0, 3.0])).tolist() == [10.0, 30.0]
    assert cube(Intervals(), as_interval(2.0)).contains(10.0)
    recorder = Recorder()
    tape = recorder.tape({"y": cube(recorder, recorder.varying("x"))})
    assert tape.evaluate([2.0], [])["y"] == 10.0
    import sympy

    x = sympy.Symbol("x", positive=True)
    assert cube(Symbols(), x) == x**3 + x


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("import os\n", 1, "import os"),
        ("from os import system\n", 1, "an import of os"),
        ("from assur.numerics.vectors import np\n", 1, "'np' of assur.numerics.vectors"),
        ("from assur.numerics import intervals\n", 1, "'intervals'"),
        ("from .. import secrets\n", 1, "an import of .."),
        ("x = 1\nx.__class__\n", 2, "__class__"),
        ("def f(ns):\n    return ns.sqrt.__self__\n", 2, "__self__"),
        ("def f(ns):\n    return f.__globals__\n", 2, "__globals__"),
        ("f = lambda: 0\n", 1, "a lambda"),
        ("class A:\n    pass\n", 1, "a class"),
        ("@print\ndef f():\n    return 1\n", 2, "a decorator"),
        ("def f():\n    while True:\n        pass\n", 2, "while"),
        ("def f():\n    def g():\n        return 1\n    return g\n", 2, "a function inside another"),
        ("def f(*args):\n    return args\n", 1, "stars among the arguments"),
        ("def f():\n    yield 1\n", 2, "yield"),
        ("def f():\n    import os\n", 2, "import inside a function"),
        ("def f():\n    global g\n", 2, "global"),
        ("def f():\n    try:\n        pass\n    except ValueError:\n        pass\n", 2, "try"),
        ("def f():\n    with open('x') as g:\n        pass\n", 2, "with"),
        ("def f():\n    return open('x', 'w')\n", 2, "the name 'open'"),
        ("eval('1')\n", 1, "eval"),
        ("exec('1')\n", 1, "exec"),
        ("def f():\n    return __import__('os')\n", 2, "__import__"),
        ("def f(x=print):\n    return x\n", 1, "print"),
        ("x = f'{1!r}'\n", 1, "a format"),
        ("x = f'{1:>1000000000}'\n", 1, "a format"),
        ("x = {1, 2}\n", 1, "a set"),
        ("x = (y := 1)\n", 1, ":="),
        ("x = b'1'\n", 1, "bytes"),
        ("x = 1j\n", 1, "complex"),
        ("x = ...\n", 1, "ellipsis"),
        ("def f(core):\n    core.x = 1\n", 2, "an attribute"),
        ("del x\n", 1, "del"),
        ("__all__ = 1\n", 1, "__all__"),
        ("async def f():\n    return 1\n", 1, "async"),
        ("x = 1 if True else print\n", 1, "print"),
        ("x = ~1\n", 1, "~"),
        ("x = 1 @ 2\n", 1, "MatMult"),
        ("return 1\n", 1, "return"),
    ],
)
def test_what_does_not_fit_the_form_is_told_with_its_line(text, line, words):
    with pytest.raises(FormFault) as fault:
        names_of(text, FILE)
    assert words in fault.value.reason
    assert fault.value.line == line


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("return x.T", "'T' of a number"),
        ("return x.tofile('/tmp/never')", "'tofile' of a number"),
        ("return x.ctypes.data", "'ctypes' of a number"),
        ("return x[0]", "an entry of a number"),
        ("return x > 0", "is compared with"),
        ("return 1 if x else 2", "a condition on a number"),
        ("return abs(x)", "abs of a number"),
        ("return x**0.5", "to the power 0.5"),
        ("return x**1000000", "to the power"),
        ("return 2**x", "to the power"),
        ("return ns.apply", "'apply'"),
        ("return 'a'.format", "'format' of a text"),
        ("return ().count", "'count' of a tuple"),
        ("return [].__len__()", ""),
        ("return f(ns, x)", "call each other too deep"),
        ("return 9**9**9", "to the power"),
        ("y = 3\nfor k in range(99):\n    y = y * y\nreturn y", "a whole number of"),
        ("return 'ab' * 100000000", "entries in one"),
        ("return (0,) * 10**9", ""),
        ("return range(10**9)", "entries in one"),
        ("y = [0]\nfor a in range(1999):\n    for b in range(1999):\n        y = [a, b]\nreturn y", "steps"),
        ("y = (1,)\nfor k in range(99):\n    y = y + y\nreturn y", "entries in one"),
        ("y = 'a'\nfor k in range(99):\n    y = f'{y}{y}'\nreturn y", "entries in one"),
        ("y = ()\nfor k in range(99):\n    y = (y, y)\nreturn {y: 1}", "as a key"),
        ("y = ()\nfor k in range(99):\n    y = (y, y)\nreturn y == y", "is compared with"),
        ("y = ()\nfor k in range(99):\n    y = (y, y)\nreturn dot(y, y)", "numbers"),
        ("return dot(('a', 'b', 'c'), (10**9, 1, 1))", "a text is given"),
        ("return dot(((1,), (1,), (1,)), (10**9, 1, 1))", "over a million"),
        ("return combinations(range(99), 9)", "entries in one"),
        ("return product(range(99), range(99))", "entries in one"),
        ("return x / 0", "ZeroDivisionError"),
        ("a, b = x", "is taken apart"),
        ("return y", "the name 'y'"),
        ("z = z + 1\nreturn z", "before it has a value"),
        ("TOP.append(1)", "'append' of a tuple"),
        ("TABLE['a'] = 1", "is given a value"),
        ("return SimpleNamespace(__class__=1)", "a record with a name"),
        ("return getattr(ns, '__class__')", "'__class__'"),
        ("return getattr(x, 'tofile')", "'tofile'"),
        ("return Margin(1, 2, 3, 4)", "name of Margin is a number"),
        ("return Margin('a\\x1b[2J', '1', 'm', unit=1)", "name of Margin is a text"),
        ("return Margin(bogus=1)", "bogus"),
        ("return sum((1, 'a'))", "a number + a text"),
        ("return f(ns)", "is not given 'x'"),
        ("return f(ns, x, x)", "3 arguments"),
        ("return (lambda_)(x)", "the name 'lambda_'"),
        ("return x(1)", "a number is called"),
    ],
)
def test_what_goes_too_far_in_a_call_is_an_error_of_the_file(body, words):
    head = (
        "from types import SimpleNamespace\nfrom itertools import combinations, product\n"
        "from assur.numerics.vectors import dot\nfrom assur.model.closed_form import Margin\nTOP = [1]\nTABLE = {}\n"
    )
    text = head + "def f(ns, x):\n" + "\n".join("    " + line for line in body.split("\n"))
    with pytest.raises((MechanismFileError, FormFault)) as error:
        names_of(text, FILE)["f"](Floats(), 3.0)
    assert words in str(error.value)


def test_an_error_in_a_call_names_the_line():
    with pytest.raises(MechanismFileError) as error:
        kernel("y = x\nreturn y.real")(Floats(), 3.0)
    assert error.value.problems[0].line == 3


def test_what_never_ends_in_python_ends():
    with pytest.raises(MechanismFileError, match=f"more than {STEPS} steps"):
        kernel("y = 0\nfor a in range(1000):\n    for b in range(1000):\n        y = y + 1\nreturn y")(Floats(), 1.0)


@pytest.mark.parametrize(
    "text",
    [
        "x = " + "(" * 250 + ")" * 250,
        "x = " + "(" * 100 + "1" + ",)" * 100,
        "x = " + "-" * 5000 + "1",
        "x = 1" + " + 1" * 5000,
        "x = 1" + " + 1" * 200_000,
        "x = " + "[" * 90 + "]" * 90,
        "def f(x):\n    return x" + ".a" * 9000,
        "\n".join(["if 1:"] + [" " * k + "if 1:" for k in range(1, 60)] + [" " * 60 + "x = 1"]),
        "x = 1\n" * 20_000,
        "x = '" + "a" * 300_000 + "'",
        "\x00",
        "x = (",
        "x = " + "9" * 5000,
    ],
)
def test_texts_that_are_nested_or_long_beyond_measure_are_refused(text):
    with pytest.raises((MechanismFileError, FormFault)):
        names_of(text, FILE)


def test_nothing_is_kept_from_call_to_call():
    names = names_of(
        "SEEN = {'n': [1]}\ndef f(ns, x):\n    rows = SEEN['n']\n    rows.append(x)\n    return rows\n", FILE
    )
    with pytest.raises(MechanismFileError, match="'append' of a tuple"):
        names["f"](Floats(), 1.0)
    hidden = "for k in range(1):\n    table = {'n': []}\n    get = table.get\ndef f(ns, x):\n    return get('n')\n"
    with pytest.raises(MechanismFileError, match="'get' of a table"):  # it would keep the table, with a list to fill
        names_of(hidden, FILE)
    text = "from types import SimpleNamespace\ndef f(ns, x):\n    return SimpleNamespace(rows=[x, [x]], a={'b': [1]})\n"
    made = names_of(text, FILE)["f"](Floats(), 1.0)
    assert made.rows == (1.0, (1.0,))
    assert dict(made.a) == {"b": (1,)}


def test_the_docs_list_what_may_be_used():
    page = (ROOT / "docs/closed-form.md").read_text(encoding="utf-8")
    for module, names in ALGEBRA.items():
        row = next(line for line in page.splitlines() if line.startswith(f"| `assur.numerics.{module}` |"))
        assert row.split("|")[2].replace("`", "").strip().split(", ") == list(names)
    declared = next(line for line in page.splitlines() if line.startswith("| `assur.model.closed_form` |"))
    assert declared.split("|")[2].replace("`", "").strip().split(", ") == list(DECLARATIONS)
    functions = next(line for line in page.splitlines() if line.startswith("| functions of Python |"))
    assert set(BUILTINS) - {"abs"} == {part.split("`")[1] for part in functions.split("|")[2].split(", ")}
    assert f"{STEPS} steps" in page
    assert f"{LENGTH} entries" in page


def test_the_built_in_files_use_a_small_part_of_the_budget():
    source = (ROOT / "src/assur/mechanisms/h4_robot/closed_form.py").read_text(encoding="utf-8")
    assert sum(1 for _ in ast.walk(ast.parse(source))) < 30_000 / 4


@pytest.mark.parametrize("body", ["rows.append(1.0)", "rows[0] = 5.0", "table['a'] = 5.0", "table['a'].append(1.0)"])
def test_what_a_kernel_is_given_is_not_changed(body):
    rows, table = [1.0, 2.0], {"a": [1.0]}
    kernel = names_of(f"def f(ns, rows, table):\n    {body}\n    return 0.0\n", FILE)["f"]
    with pytest.raises(MechanismFileError):
        kernel(Floats(), rows, table)
    assert (rows, table) == ([1.0, 2.0], {"a": [1.0]})


def test_a_loop_of_the_file_reads_what_it_gave_before():
    assert names_of("total = 0\nfor k in range(5):\n    total = total + k\n", FILE)["total"] == 10


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("t = (x,)\nfor k in range(60):\n    t = (t, t)\nreturn t", "more than 20000 parts"),
        ("t = (1,)\nfor k in range(60):\n    t = (t, t)\nreturn SimpleNamespace(a=t)", "more than 20000 parts"),
        ("t = SimpleNamespace(a=x)\nfor k in range(60):\n    t = SimpleNamespace(a=t, b=t)\nreturn t", "20000 parts"),
        ("return unknowns(20_000)", "count of unknowns"),
        ("return coefficients_of(unknowns(1)[0], 10**6)", "count of coefficients_of"),
        ("return half_angle({}, degree=10**6)", "degree of half_angle"),
        ("t = (x,) * 900\nfor k in range(100):\n    multiply(t, t)\nreturn x", f"more than {STEPS} steps"),
        ("a, b, c, d = unknowns(4)\nreturn ((a + b + c + d)**16)**4", f"more than {STEPS} steps"),
        ("a, b, c, d = unknowns(4)\ny = (a + b + c + d)**8\nreturn y**16", "product of polynomials"),
    ],
)
def test_what_doubles_or_multiplies_ends(body, words):
    lines = ["from types import SimpleNamespace", "from assur.numerics.polynomials import half_angle, multiply"]
    lines += ["from assur.numerics.expanded import coefficients_of, unknowns", "def f(ns, x):"]
    text = "\n".join([*lines, *("    " + line for line in body.splitlines())])
    with pytest.raises(MechanismFileError, match=words):
        names_of(text, FILE)["f"](Floats(), 1.0)


def test_what_the_file_doubles_at_its_top_ends():
    for text in (
        "t = (1,)\nfor k in range(60):\n    t = (t, t)\n",
        "def f(x=0x1" + "0" * 90_000 + "):\n    return x\n",
    ):
        with pytest.raises(MechanismFileError, match=r"parts|bits"):
            names_of(text, FILE)
