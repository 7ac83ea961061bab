"""The bill of materials: every link and every joint is in it, alike ones together, and the table can be read back."""

import csv
import dataclasses
import io

import pytest

import assur
from assur.export.cad.bill import bill, bill_csv
from assur.machine.masses.link_masses import masses
from assur.model.machine_data import LinkData, MachineData
from assur.results.answers.files import BillRow
from assur.scene.bodies import bodies, fused
from catalogue import each


@pytest.mark.parametrize("name", each())
def test_every_link_and_joint_is_in_it(name):
    record = assur.load(name)
    rows = bill(record)
    made = [link for row in rows if row.kind == "make" for link in row.names]
    assert sorted(made) == sorted(body.link for body in bodies(record) if body.fused)
    bought = {joint for row in rows if row.kind == "buy" for joint in row.names}
    assert bought == set(record.joints)
    assert all(row.count == len(row.names) for row in rows)
    drives = sum(row.count for row in rows if "drive" in row.what)
    assert drives == len(record.inputs)


def test_alike_links_are_one_row():
    rows = {row.names: row for row in bill(assur.load("zeng2019"))}
    assert rows["link4a", "link4b", "link7a", "link7b"].count == 4
    assert "230 from hole to hole" in rows["link4a", "link4b", "link7a", "link7b"].what
    assert ("link9", "link10") in rows
    other = {row.names for row in bill(assur.load("delta_4s"))}
    assert ("leg1.arm", "leg2.arm", "leg3.arm") in other


def test_lengths_and_volumes_are_in_mm():
    record = assur.load("delta_4s")
    row = next(row for row in bill(record) if "leg1.rod1" in row.names)
    body = next(item for item in bodies(record) if item.link == "leg1.rod1")
    assert row.volume == pytest.approx(1e9 * fused(body).volume(), abs=0.1)
    assert row.what == "2 of bar d 5.081 x 149.3, bar d 9.484 x 945.4, ball d 9.484"  # 1244 mm from ball to ball


def test_joints_are_named_in_plain_words():
    names = ("three_upu", "delta_4s", "zeng2019", "three_crr")
    words = " ".join(row.what for name in names for row in bill(assur.load(name)))
    wanted = ("universal joint", "telescopic slide", "ball joint, ball d", "rail with carriage", "slides and turns")
    for part in (*wanted, "bearing: pin d", "stroke 140 mm"):
        assert part in words


def test_the_table_reads_back():
    rows = bill(assur.load("fivebar"))
    read = list(csv.reader(io.StringIO(bill_csv(rows))))
    assert read[0][:2] == ["kind", "count"]
    assert [row[3].split() for row in read[1:]] == [list(row.names) for row in rows]
    assert bill_csv([BillRow("buy", 'a "b", c', 1, ("A",))]).splitlines()[1] == 'buy,1,"a ""b"", c",A,,'


def test_links_are_alike_where_they_weigh_the_same():
    record = assur.load("delta_4s")
    (arms,) = [row for row in bill(record) if "leg1.arm" in row.names]
    assert (arms.count, arms.mass) == (3, pytest.approx(masses(record).bodies["leg1.arm"].mass))
    links = {**record.machine.links, "leg2.arm": LinkData(mass=9.0)}
    other = bill(dataclasses.replace(record, machine=dataclasses.replace(record.machine, links=links)))
    assert {row.names: row.mass for row in other if "leg2.arm" in row.names} == {("leg2.arm",): 9.0}
    assert bill_csv(other).splitlines()[0].endswith("mass of one in kg")
    assert all(row.mass is None for row in bill(dataclasses.replace(record, machine=MachineData())))
