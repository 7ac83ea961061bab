"""Whoever looks up a method of a mechanism, or of an answer that it gives, reads an example that runs."""

import doctest
import importlib
import inspect
import re

import pytest

from assur.kinematics.kinematics import Kinematics
from assur.machine.mechanics import Mechanics
from assur.mechanism import Mechanism
from assur.model.mechanism import MechanismRecord

IMPORTED = re.compile(r"^\s*from (assur[\w.]+) import (\w+)", re.MULTILINE)


def answers() -> list[type]:
    """Classes of assur that the methods of a mechanism are declared to return."""
    classes = []
    for kind in (Mechanism, Mechanics, Kinematics):
        text = inspect.getsource(inspect.getmodule(kind))
        returned = " ".join(re.findall(r"\) -> ([\w.]+):", text))
        for module, name in IMPORTED.findall(text):
            value = getattr(importlib.import_module(module), name)
            if inspect.isclass(value) and name in returned.split():
                classes.append(value)
    return classes


def methods(kind: type) -> list[object]:
    """Public functions that a class defines itself, those of the class among them."""
    own = (value.__func__ if isinstance(value, classmethod) else value for value in vars(kind).values())
    return [
        value
        for value in own
        if inspect.isfunction(value) and value.__name__.isidentifier() and value.__name__[0] != "_"
    ]


def examples(method: object) -> list[doctest.Example]:
    return doctest.DocTestParser().get_examples(inspect.getdoc(method) or "")


@pytest.mark.parametrize("kind", [Mechanism, Mechanics, Kinematics, MechanismRecord, *answers()])
def test_every_public_method_has_an_example_that_is_run(kind):
    without = [method.__qualname__ for method in methods(kind) if not examples(method)]
    assert without == []
    skipped = [method.__qualname__ for method in methods(kind) for each in examples(method) if each.options]
    assert skipped == []


def test_methods_and_answers_are_seen():
    assert {"direct", "forces", "workspace", "page"} <= {
        method.__name__ for kind in Mechanism.__mro__ for method in methods(kind)
    }
    assert {"SolutionSet", "VelocityMap", "Stiffness", "Workspace", "Topology"} <= {kind.__name__ for kind in answers()}
    assert examples(test_methods_and_answers_are_seen) == []
