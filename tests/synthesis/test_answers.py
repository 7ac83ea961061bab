import pytest

import assur
from assur.model.topologies import load_topology
from assur.results.json_text import plain
from assur.synthesis.answers import answers, skeletons


def test_answers_are_plain_data(small):
    data = plain(answers(small))
    assert data["asked"] == {
        "motion": "3T",
        "rows": [],
        "limbs": 3,
        "max_joints": 3,
        "coupling": None,
        "symmetric": False,
        "actuators": "base",
        "max_members": 3,
        "parasitic": False,
        "idle": False,
        "passive_slides": True,
        "joint_kinds": [],
        "novelty": "",
        "redundant": 0,
    }
    assert data["found"] == len(data["mechanisms"]) == len(small.designs)
    assert data["limb_types"]["with_motion"] == sum(data["limb_types"]["by_poc"].values()) == len(small.limbs)
    assert [item["rank"] for item in data["mechanisms"]] == list(range(1, data["found"] + 1))


def test_a_mechanism_says_all_of_itself(small):
    crr = next(item for item in plain(answers(small))["mechanisms"] if item["names"] == ["three_crr"])
    poc = {"text": "t³ r¹(∥C1)", "t": 3, "r": 1, "dim": 4, "dependent": 0}
    assert crr["chains"] == ["C[x] R[x] R[x]", "C[y] R[y] R[y]", "C[z] R[z] R[z]"]
    assert crr["actuate"] == ["1.1", "2.1", "3.1"]
    assert crr["limbs"][0] == {
        "text": "C[x] R[x] R[x]",
        "symbolic": crr["limbs"][0]["symbolic"],
        "poc": poc,
        "freedoms": 4,
        "route": "both",
    }
    assert crr["poc"] == {"text": "t³ r⁰", "t": 3, "r": 0, "dim": 3, "dependent": 0}
    assert (crr["dof"], crr["xi"], crr["delta"], crr["coupling_degree"]) == (3, [5, 4], [1, -1], 1)
    assert crr["redundant_constraints"] == {"collapsed": 3, "joint_graph": 3}
    assert (crr["joint_kinds"], crr["passive_slides"], crr["drives_on_base"]) == (["R", "C"], 0, 3)
    assert crr["decoupling"] == [[True, False, False], [False, True, False], [False, False, True]]
    assert (crr["outputs"], crr["zeros"]) == (["x", "y", "z"], 6)
    assert (crr["joints"], crr["symmetric"], crr["mode"], crr["route"]) == (9, True, "home", "both")


def test_only_the_best_are_listed_where_asked(small):
    data = plain(answers(small, 4))
    assert len(data["mechanisms"]) == 4
    assert data["found"] == len(small.designs)
    assert data["mechanisms"] == plain(answers(small))["mechanisms"][:4]


@pytest.mark.parametrize("name", ["three_crr", "three_upu"])
def test_a_skeleton_is_read_back_as_the_same_mechanism(small, in_legs, tmp_path, name):
    found = small if name == "three_crr" else in_legs
    design = next(item for item in found.designs if name in item.names)
    file, text = list(skeletons(found).items())[found.designs.index(design)]
    path = tmp_path / file
    path.write_text(text, encoding="utf-8")
    described = load_topology(path)
    assert described.declared.xi == design.xi
    assert described.mode == design.mode == ("home" if name == "three_crr" else "translation")
    topology = assur.topology(path)
    assert (topology.dof, topology.xi, topology.coupling_degree) == (3, design.xi, design.coupling_degree)
    assert topology.redundant_constraints == design.redundant
    assert topology.actuation.verdict == "valid"


def test_files_are_numbered_so_that_they_sort(small):
    names = list(skeletons(small))
    assert names == sorted(names)
    assert names[0].startswith("3t-")
    assert len(set(names)) == len(small.designs)
    assert list(skeletons(small, 2)) == names[:2]


def test_families_and_mechanisms_name_each_other(of_two_limbs):
    data = plain(answers(of_two_limbs))
    assert [family["rank"] for family in data["families"]] == list(range(1, len(data["families"]) + 1))
    listed = {rank: family["rank"] for family in data["families"] for rank in family["listed"]}
    assert {item["rank"]: item["family"] for item in data["mechanisms"]} == listed
    assert all(family["members"] >= len(family["listed"]) > 0 for family in data["families"])
