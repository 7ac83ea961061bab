"""Certificates of several mechanisms, made once, and how one is edited so that its checksum fits again."""

import copy
import hashlib
import json
from dataclasses import replace
from functools import lru_cache

import pytest

from assur.certificates.certificate import certificate
from assur.certificates.paths import path_certificate
from assur.model.registry import load_record
from assur.workspace.aspects.aspects import aspects
from assur.workspace.certified.boxes import Boxes

CASES = {
    "paper": ("zeng2019", {}),
    "strokes": ("zeng2019", {"strokes": {"yA1": (-300, 300)}, "held": {"y": 200.0}}),
    "angle": ("planar_3rpr", {"strokes": {"rho1": (0, 12), "rho2": (0, 12)}, "gap": 2.0}),
    "held angle": ("planar_3rpr", {"strokes": {"rho1": (0, 12), "rho2": (1, 9)}, "held": {"phi": 0.3}, "gap": 0.05}),
    "angular strokes": ("fivebar", {"strokes": {"theta1": (0.5, 2.5)}, "gap": 0.05}),
    "half angles": (
        "gough_stewart",
        {
            "held": {"x": 0.0, "y": 0.0, "z": 0.9, "phi": 0.1},
            "box": {"theta": (-0.6, 0.6), "psi": (-0.6, 0.6)},
            "strokes": {"l1": (0.5, 1.0), "l3": (0.5, 1.25)},
            "most": 30,
        },
    ),
    "box": ("zeng2019", {"kind": "box", "box": {"x": (-20, 0), "y": (0, 10), "z": (400, 420)}}),
    "box in part": ("zeng2019", {"kind": "box", "box": {"x": (-20, 0), "z": (440, 460)}, "gap": 1e-2}),
}

PATHS = {
    "path": ("zeng2019", {}, (-40.0, -100.0, 250.0), (60.0, 100.0, 300.0)),
    "path in one box": ("fivebar", {"mode": "-+"}, (-60.0, 150.0), (60.0, 220.0)),
    "path, angle held": (
        "planar_3rpr",
        {"held": {"phi": 0.3}, "strokes": {"rho1": (0, 12), "rho2": (1, 9)}},
        (-6.0, -1.5),
        (-4.0, -9.0),
    ),
}


@lru_cache
def found_path(case):
    """Mechanism, aspects and path."""
    name, asked, start, end = PATHS[case]
    record = load_record(name)
    found = aspects(record, **asked)
    path = found.path(start, end)
    return record, found, straightened(path) if case == "path in one box" else path


def straightened(path):
    """Straight from one end to the other, in the one box about all boxes."""
    low, high = path.boxes.low.min(axis=1), path.boxes.high.max(axis=1)
    return replace(path, points=path.points[[0, -1]], boxes=Boxes(low[:, None], high[:, None]))


@lru_cache
def made(case):
    if case in PATHS:
        return path_certificate(*found_path(case))
    name, asked = CASES[case]
    return certificate(load_record(name), **{"most": 150, **asked})


def sealed(document):
    """The document as bytes, its checksum put right: what a forger would hand in."""
    rest = {key: value for key, value in document.items() if key != "sha256"}
    text = json.dumps(rest, sort_keys=True, separators=(",", ":"))
    return json.dumps({**rest, "sha256": hashlib.sha256(text.encode()).hexdigest()}).encode()


@pytest.fixture(params=[*CASES, *PATHS])
def case(request):
    return request.param


@pytest.fixture
def made_of():
    return made


@pytest.fixture
def path_of():
    return found_path


@pytest.fixture
def forged():
    """Edit a copy of a certificate's data by a function, with a checksum that fits."""

    def edit(case, change):
        document = copy.deepcopy(made(case).to_json())
        change(document)
        return sealed(document)

    return edit
