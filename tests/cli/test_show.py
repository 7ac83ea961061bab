from pathlib import Path

import pytest

import assur
from assur.model.registry import left_out, topology_names
from catalogue import each


def test_list_has_every_mechanism(assur_cli):
    rows = assur_cli("list", "--json").json["mechanisms"]
    assert [row["name"] for row in rows] == list(assur.names())
    assert all({"title", "source", "unit", "angle", "inputs", "coordinates"} <= row.keys() for row in rows)
    out = assur_cli("list").out
    assert all(name in out for name in assur.names())


def test_list_has_every_topology_and_what_is_left_out(assur_cli):
    found = assur_cli("list", "--json").json
    assert [row["name"] for row in found["topologies"]] == list(topology_names())
    assert all(row["title"] and row["source"] and row["limbs"] and row["chains"] for row in found["topologies"])
    out = " ".join(assur_cli("list").out.split())
    assert all(name in out for name in topology_names())
    assert [item["name"] for item in found["left_out"]] == [item.name for item in left_out()]
    assert all(item["reason"] in out for item in found["left_out"])


@pytest.mark.parametrize("name", each())
def test_show_says_what_the_record_holds(assur_cli, name):
    record = assur.load(name)
    data = assur_cli("show", name, "--json").json
    assert {row["name"]: row["value"] for row in data["parameters"]} == {
        key: item.value for key, item in record.parameters.items()
    }
    assert [row["name"] for row in data["joints"]] == list(record.joints)
    assert data["mobility"]["freedoms"] == len(record.inputs)
    assert data["home"]["residual"] < 1e-9
    out = assur_cli("show", name).out
    assert all(joint in out for joint in record.joints)


def test_home_is_at_the_border_in_degrees(assur_cli):
    home = assur_cli("show", "fivebar", "--json").json["home"]["joints"]
    assert home["A1"] == pytest.approx([127.0], abs=2.0)


def test_a_path_is_as_good_as_a_name(assur_cli):
    path = str(assur.load("zeng2019").file)
    assert assur_cli("show", path, "--json").json == assur_cli("show", "zeng2019", "--json").json


def test_set_changes_what_is_shown(assur_cli):
    data = assur_cli("show", "zeng2019", "--set", "l2=300", "--json").json
    assert {row["name"]: row["value"] for row in data["parameters"]}["l2"] == 300.0


def test_joints_with_several_freedoms_are_shown(assur_cli):
    path = Path(__file__).parents[1] / "model" / "file" / "delta.toml"
    home = assur_cli("show", str(path), "--json").json["home"]["joints"]
    assert (len(home["leg1.A"]), len(home["leg1.B1"]), len(home["leg1.C1"])) == (1, 2, 3)
    assert "spherical" in assur_cli("show", str(path)).out


def test_modes_that_the_file_does_not_name_are_those_of_the_joint_graph(assur_cli):
    """Of the planar 3-RPR the file names assembly modes alone."""
    out = " ".join(assur_cli("show", "planar_3rpr").out.split())
    assert "working mode: the signs of leg1, leg2, leg3 leg1 (s1) is +: B1 lies ahead of A1 along P1" in out
    assert "assembly mode: e = sign of" in out
    assert "(s1)" not in assur_cli("show", "fivebar").out


def test_masses_are_shown_with_where_they_come_from(assur_cli, tmp_path):
    text = assur.load("fivebar").file.read_text(encoding="utf-8").partition("# ---- the machine")[0]
    text = text.replace('profile = "bar20", material = "steel", ', "").replace("crank1 = {", "crank1 = { mass = 1e6,")
    text = text.replace("rod1   = {", 'rod1   = { profile = "bar", material = "steel",')
    path = tmp_path / "my.toml"
    path.write_text(text + "[materials]\nsteel = { density = 7850 }\n[profiles]\nbar = { round = 0.02 }\n")
    data = assur_cli("show", str(path), "--masses", "--json").json
    crank, rod = data["links"]
    assert (crank["link"], crank["mass"], crank["source"]) == ("crank1", 1e6, "stated, a point at the origin")
    assert rod["mass"] == pytest.approx(7850 * 3.14159265 * 0.01**2 * 0.194)
    assert (rod["source"], data["lacking"]) == ("bars of bar, steel", ["crank2", "rod2"])
    assert (data["units"]["inertia"], data["gravity"]) == ("kg m2", [0.0, 0.0, -9.81])
    out = assur_cli("show", str(path), "--masses").out
    assert "no mass is stated of crank2, rod2" in out
    assert "crank1 weighs 1e+06 kg; masses are in kg" in out
