"""Which links turn: read off the paper's mechanism, and refused with the reason where links turn about more."""

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.joint_graph.frames import frames
from assur.kinematics.home import home_values
from assur.kinematics.loops.hinges import NoAssemblyError, NotCirclesError, Stiff
from assur.kinematics.loops.orientations import turnings
from assur.model.registry import load_record
from assur.numerics import rotations

BOTH = ("Pa1", "Pa2")


def _locked(name: str) -> dict[int, float]:
    record = load_record(name)
    return {index: float(home_values(record)[index]) for index in record.input_indices}


def test_link_11_and_the_platform_of_the_papers_mechanism_do_not_turn() -> None:
    (found,) = turnings(load_record("zeng2019"), _locked("zeng2019"), None, parallel=BOTH)
    still = {link for link, group in found.items() if group.circle is None}
    assert still == {"base", "slider1", "slider2", "slider3", "linkS", "link11", "platform"}
    about = {link: np.argmax(np.abs(group.axis)) for link, group in found.items() if group.axis is not None}
    assert about == {"link9": 0, "link10": 0, "link4a": 0, "link4b": 0, "link12": 1, "link7a": 1, "link7b": 1}
    assert found["link4a"].circle == found["link4b"].circle != found["link9"].circle


@pytest.mark.parametrize("name", ["zeng2019", "fivebar", "orthoglide", "delta_4s"])
def test_orientations_at_home_are_on_their_circles(name: str) -> None:
    record = load_record(name)
    placed = frames(record, home_values(record))
    for link, group in turnings(record, _locked(name), None, parallel=tuple(record.generalised))[0].items():
        turned = placed[link][0] @ group.rotation.T
        if group.line is not None:
            assert group.axis is None
        elif group.axis is None:
            np.testing.assert_allclose(turned, np.eye(3), atol=1e-9)
        elif group.hinge is None:
            np.testing.assert_allclose(turned @ group.axis, group.axis, atol=1e-9)
        else:  # Rot(u, psi) Rot(v, phi): u . (the hinge carried along) stays zero
            assert abs(group.axis @ turned @ group.hinge) < 1e-9


def test_a_crossed_first_parallelogram_tilts_the_platform_and_link_11_together() -> None:
    (found,) = turnings(load_record("zeng2019"), _locked("zeng2019"), None, parallel=("Pa2",))
    assert found["platform"].circle == found["linkS"].circle == found["link11"].circle is not None
    assert found["link12"].rod is not None
    assert found["link7a"].rod == found["link7b"].rod != found["link12"].rod


def test_with_both_crossed_links_turn_about_two_directions() -> None:
    with pytest.raises(NotCirclesError, match="turns about more than one direction"):
        turnings(load_record("zeng2019"), _locked("zeng2019"), None, parallel=())


def test_parallelograms_of_ball_joints_keep_the_platform_from_turning() -> None:
    record = load_record("delta_4s")
    (found,) = turnings(record, _locked("delta_4s"), None, parallel=tuple(record.generalised))
    assert found["platform"].circle is None
    balls = [found[f"leg{k}.rod{side}"].ball for k in (1, 2, 3) for side in (1, 2)]
    assert balls == [0, 0, 1, 1, 2, 2]


def test_a_platform_on_three_ball_joints_is_known_by_their_centres() -> None:
    (found,) = turnings(load_record("three_rps"), _locked("three_rps"), None, parallel=())
    assert (found["platform"].triangle, found["platform"].circle) == (0, None)
    (held,) = turnings(
        load_record("three_rps"), _locked("three_rps"), Stiff("base", "platform", np.eye(3)), parallel=()
    )
    assert held["platform"].corners is None


def test_parallelograms_with_universal_joints_keep_the_platform_from_turning() -> None:
    record = load_record("three_p2us")
    (found,) = turnings(record, _locked("three_p2us"), None, parallel=tuple(record.generalised))
    assert found["platform"].circle is None
    assert [found[f"leg{k}.rod{side}"].rod for k in (1, 2, 3) for side in (1, 2)] == [0, 0, 1, 1, 2, 2]


def test_a_link_between_two_axes_is_refused_by_name() -> None:
    with pytest.raises(NotCirclesError, match="bar1 turns about more than one direction"):
        turnings(load_record("h4_robot"), _locked("h4_robot"), None, parallel=())


def test_a_tilted_platform_contradicts_its_joints() -> None:
    tilted = rotations.about_axis(np.array([1.0, 0.0, 0.0]), np.asarray(0.1))
    with pytest.raises(NoAssemblyError):
        turnings(
            load_record("zeng2019"), {}, Stiff("base", load_record("zeng2019").platform.link, tilted), parallel=BOTH
        )


def _bennett(first: float) -> tuple[str, float]:
    """A Bennett linkage whose first angle is so much at home, all links drawn in their places there; its second one."""
    a, alpha, b = 100.0, np.radians(40.0), 80.0
    beta = np.arcsin(b * np.sin(alpha) / a)
    second = 2.0 * np.arctan(np.sin((beta + alpha) / 2) / np.sin((beta - alpha) / 2) / np.tan(first / 2))
    links, joints = ("base", "crank", "coupler", "rocker"), ""
    turned, place = np.eye(3), np.zeros(3)
    sides = ((first, a, alpha), (second, b, beta), (-first, a, alpha), (-second, b, beta))
    for k, (angle, length, twist) in enumerate(sides):
        at, axis = place.tolist(), turned[:, 2].tolist()
        joints += f'J{k} = {{ type = "revolute", parent = "{links[k]}", child = "{links[(k + 1) % 4]}", '
        joints += f"at = {at}, child_at = {at}, axis = {axis} }}\n"
        turned = turned @ rotations.about_axis(np.array([0.0, 0.0, 1.0]), np.asarray(angle))
        place = place + length * turned[:, 0]
        turned = turned @ rotations.about_axis(np.array([1.0, 0.0, 0.0]), np.asarray(twist))
    assert np.allclose(place, 0, atol=1e-9)
    assert np.allclose(turned, np.eye(3), atol=1e-12)
    text = 'format = 1\nname = "bennett"\ntitle = "A Bennett linkage"\nunit = "mm"\nangle = "deg"\nbase = "base"\n'
    text += 'platform = { link = "coupler", point = [30, 20, 10], pose = ["x"] }\n[links]\n'
    text += "".join(f"{link} = {{}}\n" for link in links) + f"[joints]\n{joints}"
    text += '[inputs]\nJ0 = { name = "q" }\n[home]\n' + "".join(f"J{k} = 0\n" for k in range(4))
    return text, float(second)


def test_a_bennett_linkage_has_one_assembly_at_each_angle_that_of_bennetts_relation(tmp_path: Path) -> None:
    start = np.radians(70.0)
    text, second = _bennett(start)
    path = tmp_path / "bennett.toml"
    path.write_text(text, encoding="utf-8")
    mechanism = assur.load(path)
    for turned in np.radians([-50.0, 15.0, 100.0]):
        answer = mechanism.direct([turned])
        assert (len(answer), answer.complete) == (1, True)
        assert "2 ways in which links that do not turn can stand" in answer.right
        off = answer.joints[0][1] - (_bennett(start + turned)[1] - second)
        assert abs(rotations.nearest_turn(np.asarray(off))) < 1e-8
