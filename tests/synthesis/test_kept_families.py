import signal
import subprocess
import sys

import pytest

from assur.cache import kept
from assur.errors import Interrupted
from assur.results.json_text import plain
from assur.synthesis import plans
from assur.synthesis.answers import answers
from assur.synthesis.kept_families import KIND
from assur.synthesis.question import question
from assur.synthesis.synthesis import synthesis

ASKED = {"motion": "3T", "max_joints": 2}
KILLED = f"""
import os, signal
from assur.synthesis import plans
from assur.synthesis.question import question
from assur.synthesis.synthesis import synthesis

original, calls = plans.assemble, []

def deadly(*arguments):
    calls.append(1)
    if len(calls) == 4:
        os.kill(os.getpid(), signal.SIGKILL)
    return original(*arguments)

plans.assemble = deadly
synthesis(question(**{ASKED}))
"""


@pytest.fixture
def calls(monkeypatch):
    """What `assemble` is called with."""
    original, made = plans.assemble, []

    def counted(*arguments):
        made.append(arguments)
        return original(*arguments)

    monkeypatch.setattr(plans, "assemble", counted)
    return made


def test_a_killed_search_goes_on_with_what_it_found(calls, monkeypatch, tmp_path):
    killed = subprocess.run([sys.executable, "-c", KILLED], check=False)
    assert killed.returncode == -signal.SIGKILL
    resumed = synthesis(question(**ASKED))
    rest = len(calls)
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "other"))
    anew = synthesis(question(**ASKED))
    assert (resumed.kept, anew.kept) == (3, 0)
    assert rest == len(calls) - rest - 3 == 1
    assert plain(answers(resumed)) == plain(answers(anew))


def test_what_ctrl_c_ended_goes_on_and_is_asked_again_at_once(calls):
    def pressed(done, whole):
        if len(calls) == 2:
            raise KeyboardInterrupt

    with pytest.raises(Interrupted) as stop:
        synthesis(question(**ASKED), step=pressed)
    assert len(stop.value.answer.families) == 2
    whole = synthesis(question(**ASKED))
    assert whole.kept == 2
    count = len(calls)
    again = synthesis(question(**ASKED))
    assert len(calls) == count
    assert plain(answers(again)) == plain(answers(whole))
    others = synthesis(question(**{**ASKED, "coupling": (0, 1)}))
    assert others.kept == 0, "another question"


@pytest.mark.parametrize(
    "asked",
    [
        {"motion": "2R", "parasitic": True, "symmetric": True, "actuators": "leg"},
        pytest.param({"motion": "3R", "symmetric": True}, marks=pytest.mark.deep),
    ],
)
def test_motions_with_a_place_are_kept_with_their_points_and_rows(asked):
    first, again = synthesis(question(**asked)), synthesis(question(**asked))
    assert again.kept > 0
    assert plain(answers(again)) == plain(answers(first))


def test_what_is_damaged_is_looked_at_anew(calls):
    synthesis(question(**ASKED))
    count = len(calls)
    (entry,) = (entry for entry in kept() if entry.kind == KIND)
    for path in entry.files:
        path.write_bytes(b"no database" * 100)
    assert synthesis(question(**ASKED)).kept == 0
    assert len(calls) == 2 * count


def test_what_others_could_have_written_is_not_read():
    synthesis(question(**ASKED))
    (entry,) = (entry for entry in kept() if entry.kind == KIND)
    for path in entry.files:
        path.chmod(0o666)
    assert synthesis(question(**ASKED)).kept == 0
