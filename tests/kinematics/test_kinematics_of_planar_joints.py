"""Planar joints against a P, a P and an R in their place: every answer is the same, joint value by joint value."""

import json

import numpy as np
import pytest

import assur
from assur.cli.main import main
from assur.export.bodies import bodies
from assur.export.mjcf import mjcf, printed
from assur.export.sdf import sdf
from assur.joint_graph.frames import frames, screws
from assur.kinematics.closure import assemble
from assur.scene.bodies import bodies as solids
from planar_joints import table, three_er, three_rer

MADE = {"3-RER": three_rer, "3-ER": three_er, "table": table}


@pytest.fixture(scope="module")
def pairs(tmp_path_factory):
    """Each mechanism with planar joints, and the same with single ones, as paths."""
    folder = tmp_path_factory.mktemp("planar")
    found = {}
    for name, text in MADE.items():
        for planar in (True, False):
            path = folder / f"{name}-{planar}.toml"
            path.write_text(text(planar=planar), encoding="utf-8")
            found[name, planar] = path
    return found


@pytest.fixture(scope="module")
def mechanisms(pairs):
    return {key: assur.load(path) for key, path in pairs.items()}


@pytest.mark.parametrize("name", MADE)
def test_frames_and_screws_are_those_of_single_joints(mechanisms, name):
    one, other = mechanisms[name, True], mechanisms[name, False]
    away = 0.1 * np.random.default_rng(1).normal(size=(4, len(one.home_values)))
    values = assemble(one, one.home_values + away).values  # which link hangs on which may differ where loops are open
    placed, single = (frames(item, values) for item in (one, other))
    for link in one.links:
        for part in (0, 1):
            assert placed[link][part] == pytest.approx(single[link][part], abs=1e-10)
    assert screws(one, values) == pytest.approx(screws(other, values), abs=1e-9)


@pytest.mark.parametrize("name", MADE)
def test_poses_and_inputs_are_the_same(mechanisms, name):
    one, other = mechanisms[name, True], mechanisms[name, False]
    sizes = np.array([0.05 if item.coordinate.kind == "angle" else 12.0 for item in one.inputs])
    home = np.array([one.home_values[item.coordinate.index] for item in one.inputs])
    inputs = home + sizes * np.array([0.8, -0.6, 0.4, 1.0])[: len(home)]
    found = [item.direct(inputs) for item in (one, other)]
    first, second = (item.poses[item.exists] for item in found)
    assert len(first) == 2
    assert first == pytest.approx(second, abs=1e-7)
    assert found[0].complete == found[1].complete
    assert found[0].status.tolist() == found[1].status.tolist()
    back = [item.inverse(first[0]) for item in (one, other)]
    asked, same = (
        np.array(sorted(item.inputs[item.exists].round(7).tolist())) for item in back
    )  # letters have no order
    assert asked == pytest.approx(same, abs=1e-6)
    assert np.min(np.max(np.abs(asked - inputs), axis=1)) < 1e-6


def test_the_table_of_a_planar_mechanism_changes_nothing_and_its_list_is_complete(mechanisms):
    """All roots of the loops, the planar joint's lengths among the unknowns: they are the platform's x and y."""
    body = mechanisms["table", True]
    found = body.direct(np.radians([125.0, 110.0, 120.0]))
    assert found.complete
    place = [item.index for item in body.coordinates if item.joint == "E"]
    assert found.joints[found.exists][:, place] == pytest.approx(found.poses[found.exists], abs=1e-9)


@pytest.mark.parametrize("name", MADE)
def test_the_topology_is_the_same(pairs, capsys, name):
    said = []
    for planar in (True, False):
        assert main(["topology", str(pairs[name, planar]), "--json"]) == 0
        said.append(json.loads(capsys.readouterr().out))
    one, other = said
    assert [one["poc"][key] for key in ("t", "r", "dim")] == [other["poc"][key] for key in ("t", "r", "dim")]
    assert one["dof"] == other["dof"]
    for first, second in zip(one["poc"]["directions"], other["poc"]["directions"], strict=True):
        spans = [np.linalg.pinv(np.array(item["axes"])) @ np.array(item["axes"]) for item in (first, second)]
        assert spans[0] == pytest.approx(spans[1], abs=1e-9)


@pytest.mark.parametrize("name", MADE)
def test_exports_have_the_same_elementary_joints(mechanisms, name):
    one, other = mechanisms[name, True], mechanisms[name, False]
    models = [bodies(item) for item in (one, other)]
    kinds = [sorted(step.kind for step in model.steps.values()) for model in models]
    assert kinds[0] == kinds[1]
    texts = [(sdf(item), mjcf(item)) for item in (one, other)]
    for kind in ("prismatic", "revolute"):
        assert texts[0][0].count(f'type="{kind}"') == texts[1][0].count(f'type="{kind}"')
    assert texts[0][1].count("<joint") == texts[1][1].count("<joint")


@pytest.mark.parametrize("name", MADE)
def test_an_engine_finds_the_same(mechanisms, name):
    """MuJoCo reads the export: at values of ours all frames and all loops are where they are here."""
    mujoco = pytest.importorskip("mujoco")
    body = mechanisms[name, True]
    model = mujoco.MjModel.from_xml_string(mjcf(body))
    data = mujoco.MjData(model)
    built = bodies(body)
    start = body.home_values + 0.02 * np.random.default_rng(3).normal(size=len(body.home_values))
    values = assemble(body, start).values
    for step in printed(body, built).steps.values():
        data.qpos[model.joint(step.name).qposadr[0]] = step.value(values)
    mujoco.mj_forward(model, data)
    placed = frames(body, values)
    for link in body.links:
        rotation, origin = placed[link]
        shown = data.body(link)
        assert shown.xpos == pytest.approx(built.metre * origin, abs=1e-9)
        assert shown.xmat.reshape(3, 3) == pytest.approx(rotation, abs=1e-9)
    assert np.max(np.abs(data.efc_pos[: model.neq * 3])) < 1e-9


def test_a_puck_slides_on_a_table_that_is_solid(mechanisms):
    made = {item.link: item for item in solids(mechanisms["3-ER", True])}
    roles = {part.role for item in made.values() for part in item.fused}
    assert {"table", "puck"} <= roles


def test_limits_of_a_planar_joint_are_those_of_its_components(pairs, tmp_path):
    text = pairs["table", True].read_text(encoding="utf-8")
    old = 'child = "platform", axis = "z", at = [0, 0, 0] }'
    assert old in text
    path = tmp_path / "limited.toml"
    new = old.replace(" }", ", limits = { second = [-1, 1], rotation = [-10, 10] } }")
    path.write_text(text.replace(old, new), encoding="utf-8")
    assert assur.load(path).joints["E"].limits == (None, (-1.0, 1.0), pytest.approx(tuple(np.radians([-10, 10]))))
