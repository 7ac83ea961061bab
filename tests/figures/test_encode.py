import hashlib
import os
import subprocess
import sys

import pytest

from assur.errors import UnknownNameError
from assur.figures import catalogue as figures

SCRIPT = """
import hashlib
import assur
from assur.figures import catalogue as figures
figure = figures.draw(assur.load("fivebar"), "model")
digests = [hashlib.sha256(figures.encoded(figure, form, 100)).hexdigest() for form in ("png", "pdf", "svg")]
print(*digests)
"""


def test_the_same_bytes_in_another_process_with_another_hash_seed(capsys):
    exec(SCRIPT, {})
    seed = "2" if os.environ.get("PYTHONHASHSEED") == "1" else "1"
    environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": os.pathsep.join(sys.path)}
    ran = subprocess.run([sys.executable, "-c", SCRIPT], env=environment, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout == capsys.readouterr().out


def test_the_same_bytes_when_drawn_and_encoded_twice(context):
    digests = set()
    for _ in range(2):
        figure = figures.draw(context.record, "structure", context)
        content = [figures.encoded(figure, form, 80) for form in ("png", "pdf", "svg")]
        content += [figures.encoded(figure, form, 80) for form in ("png", "pdf", "svg")]
        assert content[:3] == content[3:]
        digests.add(hashlib.sha256(b"".join(content)).hexdigest())
    assert len(digests) == 1


def test_an_unknown_format(context):
    with pytest.raises(UnknownNameError, match="svg"):
        figures.encoded(figures.draw(context.record, "structure", context), "gif")
