"""Skeletons: where nodes are, and what is refused, by name and with what to write."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.machine.elasticity.skeletons import skeleton
from assur.model.machine_data import Material, Profile


@pytest.fixture(scope="module")
def zeng():
    return assur.load("zeng2019")


def changed(record, link, **data):
    links = {**record.machine.links, link: replace(record.machine.links[link], **data)}
    return replace(record, machine=replace(record.machine, links=links))


def test_bars_that_cross_are_welded(zeng):
    own = skeleton(changed(zeng, "linkS", rigid=False), "linkS")
    assert len(own.nodes) == 5
    assert len(own.bars) == 4
    np.testing.assert_allclose(own.nodes[4], 0.0, atol=1e-12)


def test_a_joint_beside_a_bar_is_tied_to_the_nearest_point_of_it(zeng):
    own = skeleton(changed(assur.load("zeng2019", l7=20), "linkS", rigid=False, bars=(("C3a", "C3b"),)), "linkS")
    np.testing.assert_allclose(own.nodes[own.ties["D3a"]], 0.0, atol=1e-12)
    assert own.ties["D3a"] == own.ties["D3b"]
    assert len(own.bars) == 2


def test_up_turns_the_section(zeng):
    box = Profile("box", "box", (0.03, 0.01), 3e-4, 2.5e-9, 2.25e-8, 1e-8, up=np.array([0.3, 0.0, 1.0]))
    record = replace(zeng, machine=replace(zeng.machine, profiles={"bar20": box}))
    (bar,) = skeleton(record, "link12").bars
    np.testing.assert_allclose(bar.axes, [[1, 0, 0], [0, 0, -1], [0, 1, 0]], atol=1e-12)
    along = replace(record, machine=replace(record.machine, profiles={"bar20": replace(box, up=np.array([1.0, 0, 0]))}))
    with pytest.raises(UsageError, match="link link12 of zeng2019: up of box is along its bar"):
        skeleton(along, "link12")


def test_what_is_not_known_is_named(zeng):
    with pytest.raises(UsageError, match="link link9 of zeng2019: a profile without a material") as error:
        skeleton(changed(zeng, "link9", material=None), "link9")
    lines = zeng.file.read_text(encoding="utf-8").splitlines()
    number = next(number for number, line in enumerate(lines, 1) if line.startswith("link9"))
    said = f"say it in mechanism.toml, line {number}, [links]: link9 = {{ ..., "
    assert error.value.hint == said + 'material = "steel" }; or rigid = true'
    soft = replace(zeng, machine=replace(zeng.machine, materials={"steel": Material("steel", 7850.0)}))
    with pytest.raises(UsageError, match="material steel of zeng2019: no E and no nu, and link link9 is made of it"):
        skeleton(soft, "link9")
    with pytest.raises(UsageError, match="link link11 of zeng2019: its bars are not known; it has 3 joints"):
        skeleton(changed(zeng, "link11", bars=()), "link11")
    apart = changed(assur.load("zeng2019", l7=20), "linkS", rigid=False)
    with pytest.raises(UsageError, match="link linkS of zeng2019: its bars do not hang together"):
        skeleton(apart, "linkS")
