"""Links restore what was shown, and refuse what they cannot be."""

import numpy as np
import pytest

import assur
from assur.errors import AssurError, UsageError
from assur.view.link import Viewpoint, query, restored
from assur.view.snapshot import start, with_dial, with_parameter, with_values


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "gough_stewart", "three_rps"])
def test_pose_mode_dimensions_and_camera_come_back(name):
    record = assur.load(name)
    first = next(item for item in record.parameters.values() if item.unit == record.unit)
    before = with_dial(with_parameter(start(record), first.name, 1.002 * first.value), 0, start(record).pose[0])
    viewpoint = Viewpoint((1.5, -2.0, 0.1), (0.0, 1e-3, 7.0), (0.0, 0.0, 1.0))
    after, seen = restored(record, "http://127.0.0.1:1/token/?" + query(before, viewpoint))
    assert after.values == pytest.approx(before.values, abs=1e-12)
    assert dict(after.record.overrides) == dict(before.record.overrides)
    assert after.modes == before.modes
    assert seen == viewpoint


def test_another_mode_comes_back():
    here = start(assur.load("fivebar"))
    other = with_values(here, here.record.direct(here.inputs, "-").joints[0])
    assert restored(here.record, query(other))[0].modes == other.modes


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("mechanism=zeng2019", "a link of zeng2019, not of fivebar"),
        ("at=1,2,3", "3 numbers where 5"),
        ("at=1,2,3,4,nan", "5 finite ones"),
        ("at=1,2,3,4,inf", "5 finite ones"),
        ("at=1,2,3,4,__import__", "where numbers are wanted"),
        ("at=0.3,0.3,0.3,0.3,0.3", "no assembly"),
        ("set=l9:3", "unknown parameter"),
        ("set=l1", "where numbers are wanted"),
        ("set=l1:-4", "cannot be -4"),
        ("camera=1,2,3", "3 numbers where 9"),
        ("garbage", "no link of a view: 'garbage'"),
        ("http://127.0.0.1:1/token/", "no link of a view"),
        ("at=" + "1," * 5000, "at most 6000"),
    ],
)
def test_what_is_no_link_of_this_mechanism_is_refused(text, said):
    with pytest.raises(AssurError, match=said):
        restored(assur.load("fivebar"), text)


def test_an_empty_link_is_home():
    record = assur.load("fivebar")
    snapshot, viewpoint = restored(record, "")
    assert np.array_equal(snapshot.values, start(record).values)
    assert viewpoint is None


def test_a_refusal_names_the_command_for_the_other_mechanism():
    with pytest.raises(UsageError) as caught:
        restored(assur.load("fivebar"), "mechanism=zeng2019")
    assert caught.value.hint == "assur view zeng2019"
