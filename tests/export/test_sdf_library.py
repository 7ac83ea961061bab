"""libsdformat 12 itself reads the SDF file, and has nothing to say against it."""

import subprocess
import sys
from ctypes.util import find_library
from functools import cache

import pytest

from assur.export.sdf import VERSION, sdf

pytestmark = pytest.mark.sdf
CHECK = "import ctypes, sys; sys.exit(ctypes.CDLL(sys.argv[1]).cmdCheck(sys.argv[2].encode()))"


@cache
def library():
    return find_library("sdformat12")


def said(path):
    """What `sdf --check` prints on either stream; the library's own function, so that its program need not be there."""
    ran = subprocess.run(
        [sys.executable, "-S", "-c", CHECK, library(), str(path)], capture_output=True, text=True, check=False
    )
    return ran.stdout + ran.stderr


def test_it_is_read_without_an_error(record, tmp_path):
    path = tmp_path / "it.sdf"
    path.write_text(sdf(record))
    assert said(path) == "Valid.\n"


@pytest.mark.parametrize("record", ["fivebar"], indirect=True)
@pytest.mark.parametrize(
    ("old", "new"), [(f'version="{VERSION}"', 'version="1.10"'), ("<parent>base</parent>", "<parent>none</parent>")]
)
def test_a_newer_version_and_a_link_that_is_not_there_are_errors(record, tmp_path, old, new):
    path = tmp_path / "it.sdf"
    text = sdf(record)
    assert old in text
    path.write_text(text.replace(old, new))
    assert "Error" in said(path)
