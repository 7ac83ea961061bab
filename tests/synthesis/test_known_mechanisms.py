from assur.model.topologies import load_topology
from assur.synthesis.isomorphism import limb_key, mechanism_key
from assur.synthesis.known_mechanisms import known_mechanisms
from assur.synthesis.required import MOTIONS
from assur.topology.notation import parse_chain


def test_every_mechanism_is_there_once():
    found = [name for names in known_mechanisms(MOTIONS["3T"]).values() for name in names]
    assert len(found) == len(set(found))
    assert {"tripteron", "three_upu", "delta_4s", "gough_stewart", "h4_robot", "zeng2019"} <= set(found)


def test_a_topology_is_recognised_however_its_limbs_are_turned():
    found = known_mechanisms(MOTIONS["3T"])
    rrc = limb_key(parse_chain("R[z] R[z] C[z]"), MOTIONS["3T"], (0,))
    assert found[mechanism_key([rrc] * 3)] == ("three_rrc",)
    assert mechanism_key([rrc] * 2) not in found
    assert mechanism_key([limb_key(parse_chain("R[z] R[z] C[z]"), MOTIONS["3T"], (2,))] * 3) not in found


def test_the_driven_joint_of_a_file_is_read():
    assert load_topology("three_upu").actuate == ()
    upu = limb_key(parse_chain("U[x,y] P[x] U[y,x]"), MOTIONS["3T"], (1,))
    assert known_mechanisms(MOTIONS["3T"])[mechanism_key([upu] * 3)] == ("three_upu",)
