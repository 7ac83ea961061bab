"""`assur sweep`: what single problems say, at every place of a grid; what is refused."""

import dataclasses
import json
import re
import shutil
from collections import namedtuple
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.cli.sweep_grid import asked
from assur.errors import UnknownNameError
from assur.model.registry import load_record
from assur.performance.indices import indices

PLANE = ("--along", "x=-120:120:9", "--along", "z=250:550:11", "--at", "y=10")
PAGE = Path(__file__).parents[2] / "docs" / "kinematics.md"


def load(folder, name):
    return np.load(folder / f"{name}.npy", mmap_mode="r")


def places(data):
    """Every place of a grid from what the answer says of it: index, then values by name."""
    axes = [np.linspace(item["low"], item["high"], item["count"]) for item in data["along"]]
    names = [item["name"] for item in data["along"]]
    for index in np.ndindex(*(len(axis) for axis in axes)):
        yield index, data["at"] | {name: float(axis[k]) for name, axis, k in zip(names, axes, index, strict=True)}


def test_every_pose_has_the_inputs_and_the_status_that_it_has_alone(assur_cli, tmp_path):
    run = assur_cli("sweep", "zeng2019", *PLANE, "-o", str(tmp_path), "--json")
    assert (run.code, run.err) == (0, "")
    data, inputs, status = run.json, load(tmp_path, "inputs"), load(tmp_path, "status")
    assert (inputs.shape, status.shape, data["mode"], data["at"]) == ((3, 9, 11), (9, 11), "++-++", {"y": 10.0})
    seen = set()
    for index, place in list(places(data))[::7]:
        alone = assur_cli("inverse", "zeng2019", *(repr(place[n]) for n in "xyz"), "--mode", "++-++", "--json").json
        names = data["files"]["status"]["meaning"].removeprefix("status: ").split(", ")
        assert f"{status[index]} {alone['status']}" in names
        if alone["solutions"]:
            assert inputs[(slice(None), *index)].tolist() == pytest.approx(alone["solutions"][0]["inputs"], rel=1e-12)
        else:
            assert np.isnan(inputs[(slice(None), *index)]).all()
        seen.add(alone["status"])
    assert {"regular", "unreachable"} <= seen
    reached = int(np.isfinite(inputs[0]).sum())
    assert data["counts"]["by_modes"] == {"0": 99 - reached, "1": reached}
    assert sum(data["counts"]["by_status"].values()) == 99


@pytest.mark.parametrize("mechanism", ["fivebar", "zeng2019"])
def test_every_row_of_inputs_has_the_poses_that_it_has_alone(assur_cli, tmp_path, mechanism):
    along = {"fivebar": ("theta1=10:170:5", "theta2=-20:150:6"), "zeng2019": ("yA1=-200:300:3", "yA2=-300:200:4")}
    held = ("--at", "yA3=-24.6776") if mechanism == "zeng2019" else ("--set", "l2=100")
    words = (word for text in along[mechanism] for word in ("--along", text))
    asked = ("sweep", mechanism, "--problem", "direct", *words, *held, "--keep", "poses,exists,status")
    data = assur_cli(*asked, "-o", str(tmp_path), "--json").json
    poses, exists, status = (load(tmp_path, name) for name in ("poses", "exists", "status"))
    counts: dict[str, int] = {}
    for index, place in places(data):
        given = [place[name] for name in ("theta1", "theta2", "yA1", "yA2", "yA3") if name in place]
        alone = assur_cli("direct", mechanism, *map(repr, given), *held[:2] * (held[0] == "--set"), "--json").json
        here = exists[(slice(None), *index)]
        modes = [mode for mode, real in zip(data["modes"], here, strict=True) if real]
        assert modes == [item["mode"] for item in alone["solutions"]]
        found = [poses[(k, slice(None), *index)].tolist() for k in np.flatnonzero(here)]
        np.testing.assert_allclose(found, [item["pose"] for item in alone["solutions"]] or found, rtol=1e-9, atol=1e-9)
        assert np.isnan(poses[(~here, slice(None), *index)]).all()
        named = [status_name(data, value) for value in status[(here, *index)]]
        assert named == [item["status"] for item in alone["solutions"]]
        counts[str(len(modes))] = counts.get(str(len(modes)), 0) + 1
    assert data["counts"]["by_modes"] == counts
    assert len(counts) > 1


def status_name(data, value):
    return dict(text.split() for text in data["files"]["status"]["meaning"].removeprefix("status: ").split(", "))[
        str(int(value))
    ]


def test_angles_are_in_the_unit_of_the_file(assur_cli, tmp_path):
    words = ("--along", "x=-20:20:3", "--along", "y=150:200:2", "--mode", "-+")
    data = assur_cli("sweep", "fivebar", *words, "-o", str(tmp_path), "--json").json
    alone = assur_cli("inverse", "fivebar", "20", "200", "--mode", "-+", "--json").json
    assert load(tmp_path, "inputs")[:, 2, 1].tolist() == pytest.approx(alone["solutions"][0]["inputs"], rel=1e-12)
    assert data["files"]["inputs"]["units"] == ["deg", "deg"]
    assert abs(alone["solutions"][0]["inputs"][0]) > 10.0


def test_all_modes_stand_beside_one_another(assur_cli, tmp_path):
    words = ("--along", "x=-20:20:3", "--along", "y=150:300:4")
    every = assur_cli("sweep", "fivebar", *words, "--mode", "all", "-o", str(tmp_path / "all"), "--json").json
    assert every["files"]["inputs"]["axes"] == ["mode", "input", "x", "y"]
    assert load(tmp_path / "all", "inputs").shape == (4, 2, 3, 4)
    assert "every branch" in every["how"]
    for k, mode in enumerate(every["modes"]):
        one = assur_cli("sweep", "fivebar", *words, "--mode", mode, "-o", str(tmp_path / mode), "--json").json
        assert "this mode alone" in one["how"]
        for name in ("inputs", "status"):
            np.testing.assert_array_equal(load(tmp_path / "all", name)[k], load(tmp_path / mode, name))


def test_what_the_jacobians_say_is_that_of_single_poses(assur_cli, tmp_path):
    keep = ("--keep", "det_jp,det_jq", "--keep", "condition_index,smallest,factors")
    data = assur_cli("sweep", "zeng2019", *PLANE, *keep, "-o", str(tmp_path), "--json").json
    assert list(data["files"]) == ["det_jp", "det_jq", "condition_index", "smallest", "factors"]
    checked = 0
    for index, place in list(places(data))[::7]:
        pose = [place[name] for name in "xyz"]
        alone = assur_cli("singularity", "zeng2019", "--pose", *map(repr, pose), "--json").json
        if alone["kind"] == "unreachable":
            assert all(np.isnan(load(tmp_path, name)[..., *index]).all() for name in data["files"])
            continue
        checked += 1
        assert 1.0 / load(tmp_path, "condition_index")[index] == pytest.approx(alone["condition"], rel=1e-7)
        assert load(tmp_path, "det_jp")[index] == pytest.approx(alone["det_jp"], rel=1e-12)
        assert load(tmp_path, "det_jq")[index] == pytest.approx(alone["det_jq"], rel=1e-12)
        assert data["files"]["factors"]["rows"] == list(alone["factors"])
        assert load(tmp_path, "factors")[:, *index].tolist() == pytest.approx(
            list(alone["factors"].values()), rel=1e-12
        )
        smallest = min(indices(assur.load("zeng2019"), pose).velocity_factors)
        assert load(tmp_path, "smallest")[index] == pytest.approx(smallest, rel=1e-7)
    assert checked > 3


def test_a_person_is_told_what_it_takes_and_how_to_read_it(assur_cli, tmp_path):
    folder = tmp_path / "new" / "deep"
    run = assur_cli("sweep", "zeng2019", *PLANE, "-o", str(folder))
    assert run.err == f"99 poses, by NumPy: 2.5 kB in {folder}\n"
    assert "zeng2019, inverse problem, working mode ++-++: 99 problems" in run.out
    assert f"numpy.load('{folder}/inputs.npy', mmap_mode=\"r\")" in run.out
    names: dict[str, object] = {"numpy": np}
    exec(run.out.splitlines()[-1].strip(), names)
    assert names["values"].shape == (3, 9, 11)  # type: ignore[attr-defined]  # an array
    assert sorted(path.name for path in folder.iterdir()) == ["inputs.npy", "state.json", "status.npy", "sweep.json"]


def test_a_disk_that_is_too_small_is_told_before_anything_is_written(assur_cli, tmp_path, monkeypatch):
    usage = namedtuple("usage", "total used free")
    monkeypatch.setattr(shutil, "disk_usage", lambda _: usage(10**9, 10**9 - 1000, 1000))
    for folder in (tmp_path, tmp_path / "new" / "deep"):
        run = assur_cli("sweep", "zeng2019", *PLANE, "-o", str(folder))
        assert run.code == 2
        assert "the answer takes" in run.err
        assert run.err.endswith("hint: keep less of it, or take fewer places\n")
        assert not list(tmp_path.iterdir())


def test_a_note_of_somebody_else_is_left_alone(assur_cli, tmp_path):
    (tmp_path / "sweep.json").write_text("mine")
    run = assur_cli("sweep", "zeng2019", *PLANE, "-o", str(tmp_path))
    assert (run.code, "already there" in run.err) == (2, True)
    assert [path.read_text() for path in tmp_path.iterdir()] == ["mine"]


def test_limits_left_out_are_those_of_the_file_in_its_units(assur_cli, tmp_path):
    words = ("--along", "x=2", "--along", "phi=3", "--at", "y=0")
    data = assur_cli("sweep", "planar_3rrr", *words, "-o", str(tmp_path / "a"), "--json").json
    box = assur.load("planar_3rrr").box
    assert [(item["name"], item["unit"]) for item in data["along"]] == [("x", "mm"), ("phi", "deg")]
    assert [(item["low"], item["high"]) for item in data["along"]] == [
        pytest.approx(tuple(box["x"])),
        pytest.approx(tuple(np.degrees(box["phi"]))),
    ]
    words = ("--along", "z=2", "--along", "theta=-90:90:3", "--at", "psi=0", "--keep", "exists,status")
    assert assur_cli("sweep", "three_rps", *words, "-o", str(tmp_path / "b")).code == 0
    words = ("--problem", "direct", "--along", "d1=2", "--along", "d2=2", "--at", "d3=200")
    data = assur_cli("sweep", "three_upu", *words, "-o", str(tmp_path / "c"), "--json").json
    assert [(item["low"], item["high"]) for item in data["along"]] == [(180.0, 320.0)] * 2


def test_a_redundant_input_is_no_coordinate_of_a_grid_and_the_hint_says_why():
    record = load_record("planar_3rrr")
    more = dataclasses.replace(record, redundant_inputs=(dataclasses.replace(record.inputs[0], name="q4"),))
    with pytest.raises(UnknownNameError) as refused:
        asked(more, "direct", (), ("q4=0",))
    assert refused.value.hint.startswith("q4 is redundant: it follows")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("zeng2019 --along x=3 --along y=3", "z: neither varied nor held"),
        ("zeng2019 --along x=3 --along y=3 --along z=1", "--along z: 1 places"),
        ("zeng2019 --along x=3 --along y=3 --along z=3 --at z=0", "z both varies and is held"),
        ("zeng2019 --along x=0:3 --along y=3 --along z=3", "'0:3' is not LOW:HIGH:COUNT"),
        ("zeng2019 --along x=9:3:4 --along y=3 --along z=3", "turned round or empty"),
        ("zeng2019 --along x=1:2:many --along y=3 --along z=3", "count: 'many' is not a whole number"),
        ("zeng2019 --along w=3", "unknown coordinate of this grid of zeng2019 'w'"),
        ("zeng2019 --along x=3 --along x=4", "x is given twice"),
        ("zeng2019 --problem direct --along yA1=3", "zeng2019 states no limits of yA1"),
        ("zeng2019 --along x=3 --along y=3 --at z=300 --mode ++", "unknown working mode of zeng2019 '++'"),
        ("zeng2019 --along x=3 --along y=3 --at z=300 --keep volume", "unknown quantity of the inverse problem"),
        (
            "zeng2019 --along x=3 --along y=3 --at z=300 --keep det_jp --mode all",
            "only the inverse problem in one mode, in closed form, has this",
        ),
        ("zeng2019 --along x=3 --along y=3 --at z=300 --threads -1", "no number of threads"),
        ("zeng2019 --dimension l9=1:2:3", "unknown dimension of zeng2019 'l9'"),
        (
            "zeng2019 --dimension l2=250:300",
            "'250:300' is not LOW:HIGH:COUNT\nhint: for example --dimension l2=250:300:51",
        ),
        ("zeng2019 --dimension l2=51", "'51' is not LOW:HIGH:COUNT"),
        ("zeng2019 --dimension l2=250:300:51 --set l2=300", "l2 both varies and is held"),
        ("zeng2019 --dimension l2=250:300:51 --at x=0", "y, z: neither varied nor held"),
        ("zeng2019 --dimension l2=250:300:51 --certify", "proves none\nhint: `assur workspace --certify`"),
        ("gough_stewart --along x=3", "no grid over quaternions"),
        ("three_rps --along z=3 --along theta=0:95:3 --at psi=0", "theta is between -90 and 90 deg"),
        (
            "planar_3rpr --problem direct --along rho1=1:2:3 --at rho2=1 --at rho3=1",
            "no closed direct solution by signs (it has one polynomial)\nhint: `assur direct` solves one problem",
        ),
    ],
)
def test_what_cannot_be_swept_is_refused_with_a_hint(assur_cli, tmp_path, words, message):
    run = assur_cli("sweep", *words.split(), "-o", str(tmp_path / "new"))
    assert (run.code, run.out) == (2, "")
    assert message in run.err
    assert not (tmp_path / "new").exists()


@pytest.fixture(scope="module")
def drafted(tmp_path_factory):
    """A mechanism without a closed form."""
    from assur.cli.main import main

    path = tmp_path_factory.mktemp("drafted") / "hybrid.toml"
    chains = ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "R[z] R[z] C[z]")
    words = (word for text in chains for word in ("--chain", text))
    assert main(["new", str(path), *words, "--coordinates"]) == 0
    return str(path)


def test_without_a_closed_form_home_s_mode_is_followed(assur_cli, drafted, tmp_path):
    """Against a search for every mode of single poses."""
    words = (drafted, "--along", "x=-20:40:4", "--along", "y=-100:80:4", "--at", "z=320")
    data = assur_cli("sweep", *words, "--keep", "inputs,exists,status", "-o", str(tmp_path / "o"), "--json").json
    assert data["mode"] == "home"
    assert "one that is not reached so is undecided" in data["how"]
    inputs, exists, status = (load(tmp_path / "o", name) for name in ("inputs", "exists", "status"))
    assert set(data["counts"]["by_status"]) == {"regular", "undecided"}
    names = dict(text.split() for text in data["files"]["status"]["meaning"].removeprefix("status: ").split(", "))
    assert [names[str(k)] == "undecided" for k in status.ravel()] == (~exists).ravel().tolist()
    assert np.isnan(inputs[:, ~exists]).all()
    record = assur.load(drafted)
    some = [(index, place) for index, place in places(data) if exists[index]][::4]
    assert len(some) > 1
    for index, place in some:
        every = record.inverse([place[name] for name in "xyz"]).inputs
        units = np.array([1.0, 1.0, np.pi / 180])
        assert np.min(np.abs(every - inputs[(slice(None), *index)] * units).max(axis=-1)) < 1e-8


@pytest.mark.parametrize(
    ("name", "dimension", "at", "kinds"),
    [
        ("zeng2019", "l2=240:320:5", ("x=-15", "y=10", "z=456"), {"regular", "unreachable"}),
        ("drafted", "J_x=-1500:-220:5", ("x=10", "y=20", "z=320"), {"regular"}),
        ("bare", "g=30:430:5", ("x=0", "y=200"), {"regular", "undecided", "no_mechanism"}),
    ],
)
def test_a_row_of_a_dimension_is_what_set_says(assur_cli, drafted, tmp_path, name, dimension, at, kinds):
    """With a closed form and without: the single problem of the mechanism with that dimension."""
    bare = tmp_path / "bare.toml"
    bare.write_text((Path(assur.__file__).parent / "mechanisms" / "fivebar" / "mechanism.toml").read_text())
    mechanism = {"drafted": drafted, "bare": str(bare)}.get(name, name)
    words = ("sweep", mechanism, "--dimension", dimension, "--at", ",".join(at), "-o", str(tmp_path / "o"))
    data = assur_cli(*words, "--json").json
    inputs, status = load(tmp_path / "o", "inputs"), load(tmp_path / "o", "status")
    parameter, given = dimension.partition("=")[0], [place.partition("=")[2] for place in at]
    assert [(item["name"], item["unit"]) for item in data["along"]] == [(parameter, "mm")]
    assert parameter not in data["dimensions"]
    of_mode = () if data["mode"] == "home" else ("--mode", data["mode"])
    seen = []
    for index, place in places(data):
        changed = ("--set", f"{parameter}={place[parameter]!r}")
        alone = assur_cli("inverse", mechanism, *given, *changed, *of_mode, "--json").json
        seen.append(status_name(data, status[index]))
        if seen[-1] == "no_mechanism":
            assert data["counts"]["refused"][alone["error"]["message"]] == 1
        elif seen[-1] in ("unreachable", "undecided"):
            assert alone["solutions"] == []
            assert np.isnan(inputs[(slice(None), *index)]).all()
        else:
            row = inputs[(slice(None), *index)]
            (own,) = [one for one in alone["solutions"] if np.abs(np.subtract(one["inputs"], row)).max() < 1e-6]
            assert (own["status"], own["home"]) == (seen[-1], True)
    assert set(seen) == kinds
    assert sum(data["counts"]["refused"].values()) == seen.count("no_mechanism")


def test_inputs_are_swept_without_a_closed_form_too(assur_cli, drafted, tmp_path):
    """Crossed with a dimension; against a search for every assembly of single inputs."""
    along = ("--along", "q1=-20:40:4", "--along", "q3=-10:30:3", "--at", "q2=5", "--dimension", "J_y=170:200:2")
    asked = ("sweep", drafted, "--problem", "direct", *along, "--keep", "poses,exists,status")
    data = assur_cli(*asked, "-o", str(tmp_path / "o"), "--json").json
    assert (data["mode"], data["files"]["poses"]["axes"]) == ("home", ["coordinate", "J_y", "q1", "q3"])
    poses, exists, status = (load(tmp_path / "o", name) for name in ("poses", "exists", "status"))
    for index, place in list(places(data))[::4]:
        if not exists[index]:
            assert (status_name(data, status[index]), np.isnan(poses[(0, *index)])) == ("undecided", True)
            continue
        given = (repr(place[name]) for name in ("q1", "q2", "q3"))
        alone = assur_cli("direct", drafted, *given, "--set", f"J_y={place['J_y']!r}", "--json").json
        away = [np.abs(np.subtract(one["pose"], poses[(slice(None), *index)])).max() for one in alone["solutions"]]
        own = alone["solutions"][int(np.argmin(away))]
        assert (min(away) < 1e-6, own["status"]) == (True, status_name(data, status[index]))
    assert 4 < exists.sum() < 24


def test_a_dimension_alone_is_swept_at_home(assur_cli, drafted, tmp_path):
    words = ("sweep", drafted, "--dimension", "J_y=160:180:3", "-o", str(tmp_path / "o"), "--json")
    data = assur_cli(*words).json
    assert data["at"] == pytest.approx({"x": 0.0, "y": 0.0, "z": 300.0})
    np.testing.assert_allclose(load(tmp_path / "o", "inputs"), 0.0, atol=1e-9)  # a draft is drawn at home


def test_shards_of_what_is_followed_are_the_whole_to_the_byte(assur_cli, drafted, tmp_path):
    words = (drafted, "--along", "x=-20:60:9", "--along", "y=-40:60:11", "--along", "z=300:340:6")
    assert assur_cli("sweep", *words, "-o", str(tmp_path / "alone")).code == 0
    folders = [str(tmp_path / f"part-{k}") for k in (1, 2)]
    for k, folder in enumerate(folders, start=1):
        assert assur_cli("sweep", *words, "--shard", f"{k}/2", "-o", folder, "--threads", str(k)).code == 0
    assert assur_cli("sweep", "--merge", *folders, "-o", str(tmp_path / "joined")).code == 0
    alone, joined = ({one.name: one.read_bytes() for one in (tmp_path / at).iterdir()} for at in ("alone", "joined"))
    assert alone == joined


@pytest.mark.parametrize(
    ("words", "message", "told"),
    [
        (
            ("--along", "x=0:1:3", "--at", "y=0,z=320", "--mode", "2"),
            "follows home's mode, not '2'",
            "leave the",
        ),
        (
            ("--along", "x=0:1:3", "--at", "y=0,z=320", "--keep", "det_jp"),
            "unknown quantity",
            "in closed form, has this",
        ),
    ],
)
def test_what_needs_a_closed_form_is_refused(assur_cli, drafted, tmp_path, words, message, told):
    run = assur_cli("sweep", drafted, *words, "-o", str(tmp_path / "new"))
    assert (run.code, message in run.err, told in run.err) == (2, True, True)
    assert not (tmp_path / "new").exists()


def test_the_numbers_of_the_page_are_those_of_a_single_pose(assur_cli):
    text = PAGE.read_text(encoding="utf-8")
    (shown,) = re.findall(r"inputs\[:, 50, 40\].*?\n(\[.*?\])\n", text)
    alone = assur_cli("inverse", "zeng2019", "-10", "0", "380", "--mode", "++-++", "--json").json
    assert json.loads(shown) == pytest.approx(alone["solutions"][0]["inputs"], abs=5e-5)
