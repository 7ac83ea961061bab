"""What links weigh, against integrals done by hand or by sums over many small parts."""

from dataclasses import replace

import numpy as np
import pytest

from assur.errors import UsageError
from assur.machine.masses.link_masses import all_masses, masses
from assur.model.machine_data import LinkData, MachineData, Material, Profile
from assur.model.registry import load_record
from catalogue import each

STEEL = Material("steel", 7850.0, 210e9, 0.3)
BAR = Profile("bar", "round", (0.02,), np.pi * 1e-4, 7.854e-9, 7.854e-9, 1.5708e-8)


def with_data(name, links, **others):
    data = MachineData({"steel": STEEL}, {"bar": BAR}, links=links, **others)
    return replace(load_record(name), machine=data)


def test_a_bar_of_a_profile_weighs_density_times_volume_and_turns_as_a_cylinder():
    body = masses(with_data("fivebar", {"rod1": LinkData(profile="bar", material="steel")})).bodies["rod1"]
    length, radius = 0.194, 0.01
    mass = 7850 * np.pi * radius**2 * length
    assert body.mass == pytest.approx(mass)
    np.testing.assert_allclose(body.centre, [length / 2, 0, 0])
    own = mass * radius**2 / 2
    np.testing.assert_allclose(np.diag(body.inertia), [own, mass * length**2 / 12, mass * length**2 / 12], rtol=1e-4)


def test_bars_that_a_file_names_add_up_as_sums_over_small_parts():
    data = {"linkS": LinkData(kg_per_m=2.0, bars=(("C3a", "C3b"), ("C3a", "D3b")))}
    record = with_data("zeng2019", data)
    body = masses(record).bodies["linkS"]
    ends = [(record.joints[a], record.joints[b]) for a, b in data["linkS"].bars]
    points, weights = [], []
    for first, second in ends:
        a = first.child_at / 1e3
        b = (second.child_at if second.child == "linkS" else second.at) / 1e3
        share = (np.arange(20000) + 0.5) / 20000
        points.append(a + share[:, None] * (b - a))
        weights.append(np.full(20000, 2.0 * np.linalg.norm(b - a) / 20000))
    cloud, weight = np.concatenate(points), np.concatenate(weights)
    centre = weight @ cloud / weight.sum()
    away = cloud - centre
    tensor = np.einsum("n,nk,nk->", weight, away, away) * np.eye(3) - np.einsum("n,ni,nj->ij", weight, away, away)
    assert body.mass == pytest.approx(weight.sum())
    np.testing.assert_allclose(body.centre, centre, atol=1e-9)
    np.testing.assert_allclose(body.inertia, tensor, atol=1e-9)


def test_a_mass_is_a_point_and_spread_over_the_bars_of_a_profile():
    links = {"rod1": LinkData(mass=3.0), "rod2": LinkData(mass=3.0, profile="bar", material="steel")}
    bodies = masses(with_data("fivebar", links)).bodies
    assert (bodies["rod1"].mass, bodies["rod1"].centre.tolist(), bodies["rod1"].inertia.any()) == (
        3.0,
        [0, 0, 0],
        False,
    )
    np.testing.assert_allclose(bodies["rod2"].centre, [0.097, 0, 0])
    assert bodies["rod2"].inertia[2, 2] == pytest.approx(3.0 * 0.194**2 / 12)


def test_a_payload_hangs_on_the_platform():
    record = with_data("fivebar", {"rod1": LinkData(kg_per_m=1.0)}, payload=LinkData(mass=2.0))
    known = masses(record)
    body = known.carried("rod1")["rod1"]
    assert body.mass == pytest.approx(2.194)
    assert body.centre[0] == pytest.approx((0.194 * 0.097 + 2.0 * 0.194) / 2.194)  # at P
    assert known.total == pytest.approx(2.194)


def test_what_is_not_said_is_told():
    with pytest.raises(UsageError, match="fivebar: no mass of crank1, crank2, rod2") as caught:
        all_masses(with_data("fivebar", {"rod1": LinkData(mass=1.0)}))
    assert caught.value.exit_code == 2
    with pytest.raises(UsageError, match=r"slider1 of zeng2019: its bars are not known; it has 1 joints"):
        masses(with_data("zeng2019", {"slider1": LinkData(kg_per_m=1.0)}))
    with pytest.raises(UsageError, match="made of steel, but its sizes are not known"):
        masses(with_data("fivebar", {"rod1": LinkData(material="steel")}))


def test_a_material_without_density_leaves_its_links_without_mass():
    record = load_record("zeng2019")
    steel = replace(record.machine.materials["steel"], density=None)
    bare = replace(record, machine=replace(record.machine, materials={"steel": steel}))
    assert set(masses(bare).lacking) == {name for name, data in record.machine.links.items() if data.profile}
    assert set(masses(bare).bodies) == {"slider1", "slider2", "slider3", "platform"}
    with pytest.raises(UsageError, match="no mass of link9") as error:
        all_masses(bare)
    assert error.value.hint.endswith("[materials]: steel = { ..., density = 7850 }, in kg/m3")


def test_a_mass_beyond_reason_is_noted():
    assert masses(with_data("fivebar", {"rod1": LinkData(mass=1e6)})).notes == (
        "rod1 weighs 1e+06 kg; masses are in kg",
    )


def test_numbers_in_other_units_are_noted():
    """Grams for a cubic centimetre, gigapascals, millimetres, kilogram millimetres squared."""
    record = load_record("fivebar")
    steel, bar = record.machine.materials["steel"], record.machine.profiles["bar20"]
    machine = replace(
        record.machine,
        materials={"steel": replace(steel, density=7.85, elasticity=210.0)},
        profiles={"bar20": replace(bar, sizes=(20.0,))},
        payload=LinkData(mass=1.0, inertia=np.diag([200.0, 200.0, 200.0])),
    )
    said = " ".join(masses(replace(record, machine=machine)).notes)
    for words in ("7.85 kg/m3", "E = 210 Pa", "20 m wide", "the payload has the inertia 200 kg m2"):
        assert words in said


@pytest.mark.parametrize("name", each())
def test_nothing_of_built_in_mechanisms_looks_like_another_unit(name):
    assert masses(load_record(name)).notes == ()


@pytest.mark.parametrize("name", each())
def test_built_in_mechanisms_know_what_they_weigh_and_what_drives_them(name):
    record = load_record(name)
    assert all_masses(record).bodies.keys() == record.links.keys() - {record.base}
    drives = [record.machine.actuators[record.coordinate_label(item.coordinate)] for item in record.drives]
    assert all(item.stiffness and item.force and item.speed for item in drives)
    assert any(word in record.file.read_text(encoding="utf-8") for word in ("machine: assumed", "else is assumed"))
