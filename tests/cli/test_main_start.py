"""`import assur` is light, and what it names is found where it lives."""

import subprocess
import sys

import pytest

import assur
import assur.errors
import assur.mechanism


@pytest.mark.parametrize("name", assur.__all__)
def test_public_names_are_found_and_offered(name):
    home = assur.errors if name.endswith("Error") else assur.mechanism
    assert getattr(assur, name) is getattr(home, name)
    assert name in dir(assur)


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="module 'assur' has no attribute 'laod'"):
        assur.laod  # noqa: B018


def test_import_alone_loads_no_numpy():
    code = "import sys, assur; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], timeout=60, check=False).returncode == 0
