"""The names of modes tell solutions apart, and are kept along every regular path."""

import re
from functools import cache

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.frames import frames
from assur.joint_graph.tree import joint_graph
from assur.kinematics.border import inputs_of
from assur.kinematics.closing_blocks import distinguishing
from assur.kinematics.closing_blocks.ball_ends import ball_ended_values, with_ball_ends
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.kinematics.closing_blocks.distinguishing import _Solutions, _solved, _solving, distinguishing_signs
from assur.kinematics.closure import assemble, closure_error, closure_jacobian
from assur.kinematics.home import home_values
from assur.kinematics.modes import lettered, mode_texts
from assur.kinematics.named_signs import named_signs
from assur.kinematics.naming import sign_meanings
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.starts import by_chance
from assur.kinematics.still import otherwise
from assur.kinematics.turns import lasting_relations
from assur.model.registry import load_record
from assur.numerics.rotations import about_axis, from_vector, to_vector
from regular_walks import changes
from screw_mechanisms import TRIPOD, loaded

CROSSED = 0.01
"""Share of the usual distance from a singularity at which a sign changes that changes there: the place is known to
some 1e-5 of a step, and the smallest singular value may fall steeply."""

QUICK = ["fivebar", "zeng2019", "tsai_platform", "planar_3rpr"]
DEEP = [
    "delta_4s", "gough_stewart", "h4_robot", "linear_delta_4r", "linear_delta_4s", "orthoglide", "planar_3rrr",
    "three_crr", "three_p2us", "three_rps", "three_rrc", "three_rrrp4r", "three_upu", "tripteron",
]  # fmt: skip


@pytest.mark.parametrize("problem", ["direct", "inverse"])
def test_starts_by_chance_have_the_turns_of_home(problem, tmp_path, monkeypatch):
    """A nut that begins some turns elsewhere on its shaft leads to no assembly of this mechanism."""
    met = []

    def met_from(record, starts, **asked):
        met.append((record, starts, assemble(record, starts, **asked).closed))
        return assemble(record, starts, **asked)

    monkeypatch.setattr(distinguishing, "assemble", met_from)
    distinguishing_signs(loaded(tmp_path, TRIPOD), problem)
    record, starts, closed = met[0]
    assert len(lasting_relations(record)) == 3
    assert np.max(np.abs((starts - home_values(record)) @ lasting_relations(record).T)) < 1e-9
    assert np.mean(closed) > 0.5


def signs_of(record, problem, values):
    screws = ScrewColumns(with_ball_ends(record), ball_ended_values(record, values))
    signs = [sign.signs(screws) for sign in distinguishing_signs(record, problem)]
    return np.array(signs, dtype=int).reshape(len(signs), len(values)).T


@pytest.mark.parametrize("problem", ["direct", "inverse"])
@pytest.mark.parametrize(
    ("name", "walks", "steps"),
    [
        *((name, 8, 40) for name in QUICK),
        *(pytest.param(name, 50, 200, marks=pytest.mark.deep) for name in [*QUICK, *DEEP]),
    ],
)
def test_a_name_changes_at_singularities_alone(name, problem, walks, steps):
    """Judged by the singular values of the whole closure, not by the blocks' own determinants."""
    record = load_record(name)
    shares = changes(record, problem, lambda values: signs_of(record, problem, values), walks, steps)
    assert np.max(shares, initial=0.0) < CROSSED


def test_a_fixed_minor_of_the_closure_changes_at_regular_configurations():
    """So the walks would notice a name that is not kept: the minor is one of full rank at home."""
    record = load_record("tsai_platform")
    passive = [k for k in range(len(record.coordinates)) if k not in record.input_indices]
    at_home = closure_jacobian(record, home_values(record))[:, passive]
    rows: list[int] = []
    for row in range(len(at_home)):
        if np.linalg.matrix_rank(at_home[[*rows, row]], tol=1e-6) > len(rows):
            rows.append(row)

    def minor(values):
        return np.sign(np.linalg.det(closure_jacobian(record, values)[:, rows][:, :, passive]))[:, None]

    assert np.max(changes(record, "direct", minor, 24, 100), initial=0.0) > 30 * CROSSED


@pytest.mark.parametrize(
    ("name", "problem", "given", "modes"),
    [
        ("fivebar", "inverse", [10.0, 220.0], 4),
        ("fivebar", "direct", [2.2, 0.9], 2),
        ("zeng2019", "inverse", [-15.4714, 9.6849, 456.3315], 8),
        ("zeng2019", "direct", [162.6907, -143.3209, -24.6776], 4),
        ("planar_3rrr", "inverse", [0.1, 0.05, 0.05], 8),
        ("three_rps", "inverse", [800.0, 0.1, 0.05], 2),
        ("orthoglide", "inverse", [10.0, 5.0, -20.0], 8),
    ],
)
def test_they_tell_the_solutions_apart_as_the_closed_form_does(name, problem, given, modes):
    """As many names as solutions, and as many solutions as the closed form has there."""
    record = load_record(name)
    found = (direct if problem == "direct" else inverse)(record, given)
    signs = signs_of(record, problem, found.joints[found.exists])
    assert len(np.unique(signs, axis=0)) == len(signs) == modes


def kinds_of_branches(problem):
    """How many branches of zeng2019 there are by the closed form, and kinds by it, by signs, and by both together."""
    record = load_record("zeng2019")
    closed = assemble(record, by_chance(record, 1000, np.random.default_rng(3)), far=True)
    values = closed.values[closed.closed]
    values = values[[not other for other in otherwise(record, values)]]
    inputs, written = inputs_of(record, values), named_signs(record, problem, values)
    # B of Eq. (9) is of the inputs alone: at given ones its sign tells no branches apart
    asked = np.sign(inputs[:, :1] - record.parameters["l3"].value - inputs[:, 1:2])[:, : int(problem == "direct")]
    named = signs_of(record, problem, values)
    regular = np.all(named != 0, axis=1)
    kinds = [
        len(np.unique(np.hstack([*own, asked])[regular], axis=0)) for own in ((written,), (named,), (written, named))
    ]
    return len(np.unique(written[regular], axis=0)), kinds


@pytest.mark.parametrize(("problem", "branches"), [("inverse", 32), ("direct", 8)])
def test_they_tell_every_branch_apart_that_there_is_anywhere(problem, branches):
    """At one pose eight of the paper's 32 are real at most; who knows the name knows that of the closed form."""
    every, kinds = kinds_of_branches(problem)
    assert every == branches
    assert kinds[1] == kinds[2]


@pytest.mark.xfail(strict=False, reason="which signs are chosen depends on starts by chance, and so on rounding")
@pytest.mark.parametrize("problem", ["inverse", "direct"])
def test_names_are_one_for_one_those_of_the_closed_form(problem):
    """An open defect: on processors with other rounding one sign more is chosen."""
    _, kinds = kinds_of_branches(problem)
    assert kinds[0] == kinds[1] == kinds[2]


def test_solutions_of_one_sign_get_letters():
    """A cusp: between the assemblies of a 3-RPR of one sign lies no singularity on some way."""
    record = load_record("planar_3rpr")
    found = direct(record, [300.0, 300.0, 300.0])
    texts = mode_texts(signs_of(record, "direct", found.joints[found.exists]).astype(np.int8))
    assert sorted(lettered(texts, np.ones(len(texts), dtype=bool))) == ["+a", "+b", "-a", "-b"]


@pytest.mark.parametrize("problem", ["direct", "inverse"])
@pytest.mark.parametrize("name", [*QUICK, *(pytest.param(name, marks=pytest.mark.deep) for name in DEEP)])
def test_home_reads_plus_and_what_looks_alike_bears_one_name(name, problem):
    record = load_record(name)
    home = home_values(record)
    assert np.all(signs_of(record, problem, home[None]) == 1)
    (values,) = _solved(record, problem, home[None])
    answer = _Solutions.of(ScrewColumns(record, values), ())
    names = signs_of(record, problem, values)
    regular = np.all(names != 0, axis=1)
    for number in np.unique(answer.solution):
        assert len(np.unique(names[regular & (answer.solution == number)], axis=0)) <= 1


def test_limbs_that_close_by_themselves_stand_in_all_their_ways_together_however_few_are_met():
    """Of long limbs few starts close all at once: two assemblies are met here, of which each limb has its own way."""
    record = load_record("gough_stewart")
    home = home_values(record)
    asking, answers = _solving(record, "inverse", home), []
    next(asking)
    met = np.stack([home, home + 1.0])
    while not answers:
        try:
            asking.send(met)
            met = met[:0]
        except StopIteration as end:
            answers.append(end.value)
    assert len(np.unique(answers[0], axis=0)) > 2**6 / 2


@pytest.mark.deep
@pytest.mark.parametrize("own", ["6-HUS"], indirect=True)
def test_half_a_turn_of_any_rod_about_its_line_leaves_the_name(own):
    """Each has a universal joint at one end: both ways in which it stands look alike, whichever the others' are."""
    home, slices = home_values(own), joint_graph(own).slices
    rows = []
    for limb in own.chains.values():
        middle, last = limb.serial[1:]
        row = home.copy()
        row[slices[middle]] = [np.pi, np.pi] + home[slices[middle]] * [1.0, -1.0]
        before, after = (_turned_by(own.joints[middle], values[slices[middle]]) for values in (home, row))
        row[slices[last]] = to_vector(after.T @ before @ from_vector(home[slices[last]]))
        rows.append(row)
    turned = np.array(rows)
    assert np.max(closure_error(own, turned)) < 1e-6
    assert np.allclose(pose_of(own, turned), pose_of(own, home), rtol=0, atol=1e-6)
    assert np.all(signs_of(own, "inverse", turned) == 1)
    assert len(distinguishing_signs(own, "inverse")) == 6


def _turned_by(joint, values):
    """Orientation (3, 3) of a universal joint's child in its parent."""
    return about_axis(joint.axes[0], values[0]) @ about_axis(joint.axes[1], values[1])


def test_where_no_solution_is_regular_nothing_differs():
    """Some factor may vanish at every solution that is met; the answer then has no names, but is one."""
    nothing = _Solutions(np.zeros((0, 5)), np.zeros(0, dtype=int), np.zeros((0, 3), dtype=np.int8))
    assert nothing.alike.shape == (0, 3)
    signs = np.array([[1, 1], [1, -1], [1, 1], [-1, 1]], dtype=np.int8)
    alike = _Solutions(np.zeros((4, 5)), np.array([0, 0, 1, 1]), signs).alike
    assert sorted(alike.tolist()) == [[False, False], [False, True], [True, False]]


def test_the_order_of_a_file_decides_no_name(tmp_path):
    """Limbs, links and joints the other way round: the same signs in the same order, of the same sentences."""
    path = tmp_path / "own.toml"
    branches = "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"
    assert main(["new", str(path), "--chain", branches, "--chain", "R[z] R[z] C[z]"]) == 0
    text = path.read_text().partition("\n[modes]")[0] + "\n"
    path.write_text(text)
    head, *tables = re.split(r"(?m)^(?=\[)", text)
    turned = [_turned(table) if re.match(r"\[(limbs\.\w+\.)?(joints|links)\]", table) else table for table in tables]
    other_path = tmp_path / "other.toml"
    other_path.write_text(head + "".join(turned[:3] + turned[:2:-1]))
    record, other = load_record(str(path)), load_record(str(other_path))
    assert list(record.joints) != list(other.joints)
    labels = [record.coordinate_label(item) for item in record.coordinates]
    order = [labels.index(other.coordinate_label(item)) for item in other.coordinates]
    values = assemblies_by_chance(record)[:40]
    for problem in ("direct", "inverse"):
        assert sign_meanings(record, problem) == sign_meanings(other, problem)
        assert signs_of(record, problem, values).tolist() == signs_of(other, problem, values[:, order]).tolist()


def _turned(table):
    """A table of a file with its lines the other way round."""
    head, *lines = table.strip().splitlines()
    return "\n".join([head, *reversed(lines)]) + "\n\n"


OWN = {
    "H4": ["H4"],
    "3UPS&UP": ["3UPS&UP"],
    "3-RRR": ["3-RRR", "spherical"],
    "3-SPR": ["3-SPR"],
    "2UPR-RPU": ["2UPR-RPU"],
    "2UPR-2RPU": ["2UPR-2RPU"],
    "Exechon": ["Exechon"],
    "6-RUS": ["6-RUS"],
    "Tsai": ["Tsai"],
    "Orthoglide": ["Orthoglide"],
    "3-PRPaR": ["3-PRPaR", "upright rails"],
    "3-RUU": ["3-RUU"],
    "six bars": ["--chain", "R[z] R[z] R[z]", "--chain", "R[z] R[z]"],
    "eight bars": ["--chain", "{R[z] R[z] | R[z] R[z]} R[z] R[z]", "--chain", "R[z] R[z]"],
    "2T1R hybrid": ["--chain", "{P[z] R[y] R[y] | P[z] R[y] R[y]} R[z]", "--chain", "P[x] R[y] R[y] R[z]"],
    "hybrid on a ball": ["--chain", "{P[y] R[x] R[x] | P[y] R[x] R[x]}", "--chain", "P[y] U[x,y] S"],
    "five bars and a parallelogram": ["--chain", "R[z] P(4R)[z] R[z]", "--chain", "R[z] R[z]"],
    "cylinders": ["--chain", "R[z] C[x]", "--chain", "C[y] C[1,1,1]", "--actuate", "1.1"],
    "a cylinder and hinges": ["--chain", "C[z] R[x] R[x]", "--chain", "P[y] R[x] R[x]"],
    "slides on cranks": ["--limb", "R[z] R[z] P[x]", "--count", "3"],
    "slides and universals": ["--limb", "P[z] U U", "--count", "3"],
    "ball screws": ["--limb", "{R[z]@O H[z]@O | P[z]} R[x] S"],
    "6-HUS": ["--limb", "H[z] U S", "--count", "6"],
}
SHORT = ["six bars", "2T1R hybrid", "hybrid on a ball", "slides on cranks"]


@pytest.fixture(scope="module")
def drafts(tmp_path_factory):
    """Drafts of one's own by name, their `[modes]` left out."""

    @cache
    def draft(name):
        path = tmp_path_factory.mktemp("drafts") / "own.toml"
        assert main(["new", str(path), *OWN[name]]) == 0
        head, *tables = re.split(r"(?m)^(?=\[)", path.read_text())
        path.write_text(head + "".join(table for table in tables if not table.startswith("[modes]")))
        return load_record(str(path))

    return draft


@pytest.fixture
def own(request, drafts):
    return drafts(request.param)


@pytest.mark.parametrize("problem", ["direct", "inverse"])
@pytest.mark.parametrize(
    ("own", "walks", "steps"),
    [
        *((name, 6, 30) for name in SHORT),
        *(pytest.param(name, 10, 60, marks=pytest.mark.deep) for name in OWN),
    ],
    indirect=["own"],
)
def test_a_name_of_a_draft_changes_at_singularities_alone(own, problem, walks, steps):
    shares = changes(own, problem, lambda values: signs_of(own, problem, values), walks, steps)
    assert np.max(shares, initial=0.0) < CROSSED


@pytest.mark.parametrize("own", ["Tsai", pytest.param("3-RUU", marks=pytest.mark.deep)], indirect=True)
def test_a_limb_whose_screws_span_no_one_space_has_a_sign_at_those_that_leave_a_joint_at_rest(own):
    """The knee of an overconstrained limb: a P(4R) in it may stand on either side, what looks alike bears one name."""
    signs = distinguishing_signs(own, "inverse")
    assert [{name.partition(".")[0] for name in sign.joints} for sign in signs] == [{"leg1"}, {"leg2"}, {"leg3"}]


@pytest.mark.parametrize(
    ("own", "names"),
    [
        ("Exechon", (2, 32)),
        pytest.param("Tsai", (2, 8), marks=pytest.mark.deep),
    ],
    indirect=["own"],
)
def test_overconstrained_mechanisms_have_as_many_names_as_their_loops_tell(own, names):
    """Two limbs that stay in one plane close in a loop of their own; a limb's flip is a direct factor, too."""
    home = home_values(own)
    solutions = direct(own, inputs_of(own, home) + 0.01), inverse(own, pose_of(own, home) + 0.01)
    told = [signs_of(own, one.problem, one.joints[one.exists]) for one in solutions]
    assert tuple(len(np.unique(signs, axis=0)) for signs in told) == names


@pytest.mark.parametrize("own", ["2UPR-RPU"], indirect=True)
def test_what_moves_in_a_plane_that_turns_has_a_sign_for_either(own):
    """Two U-P-R legs and the place of the third one along x are a triad in a plane through the x axis, whose angle is
    that of a triangle then: the legs' own determinant, and the side of the triangle, are the two signs."""
    screws = ScrewColumns(own, assemblies_by_chance(own))
    axis, foot, tip = (screws.centre(name) for name in ("a1.A", "b1.E", "b1.G"))
    (column,) = (item.index for item in own.coordinates if item.joint == "a1.A")
    turned = screws.values[:, column]
    up = np.stack([np.zeros_like(turned), -np.sin(turned), np.cos(turned)], axis=-1)

    def in_plane(point):
        return np.stack([point[:, 0], np.einsum("ni,ni->n", point - axis, up)], axis=-1)

    places = frames(own, screws.values)["platform"]
    ends = [in_plane(places[0] @ own.joints[name].child_at + places[1]) for name in ("a1.D", "a2.D")]
    legs = [end - in_plane(screws.centre(name)) for end, name in zip(ends, ("a1.B", "a2.B"), strict=True)]
    lines = [*zip(legs, ends, strict=True), (np.broadcast_to([1.0, 0.0], legs[0].shape), in_plane(tip))]
    rows = [np.column_stack([way, at[:, 0] * way[:, 1] - at[:, 1] * way[:, 0]]) for way, at in lines]
    expected = np.cross(tip - axis, foot - axis)[:, 0], np.linalg.det(np.stack(rows, axis=1))
    signs = signs_of(own, "direct", screws.values).T
    assert len(signs) == 2
    for sign, value in zip(signs, expected, strict=True):
        assert {*sign} == {-1, 1}
        assert np.all(sign == np.sign(value * value[0]))


@pytest.mark.deep
@pytest.mark.parametrize("own", ["H4"], indirect=True)
def test_every_limb_of_rods_on_balls_has_a_sign_of_its_own(own):
    """Of starts by chance hardly one closes there; each arm is in front of its rods or behind them, four arms are."""
    assert len(distinguishing_signs(own, "inverse")) == 4


@pytest.mark.deep
@pytest.mark.parametrize("own", ["3UPS&UP"], indirect=True)
def test_a_leg_that_holds_the_platforms_point_is_named_by_its_stroke_and_by_how_it_is_turned(own):
    """Of the four ways in which the passive leg reaches a point the whole determinant tells two."""
    solutions = inverse(own, pose_of(own, home_values(own)) + 0.01)
    signs = signs_of(own, "inverse", solutions.joints[solutions.exists])
    assert len(np.unique(signs, axis=0)) == len(signs) == 2**5


@pytest.mark.deep
@pytest.mark.parametrize("own", ["ball screws"], indirect=True)
def test_a_leg_on_a_screw_has_a_sign_as_one_on_a_slide_has(own):
    """Three legs, and the platform that they hold to three coordinates."""
    signs = distinguishing_signs(own, "inverse")
    limbs = [{name.partition(".")[0] for name in sign.joints} for sign in signs]
    assert sorted(map(len, limbs)) == [1, 1, 1, 4]


@pytest.mark.parametrize("own", ["cylinders"], indirect=True)
def test_three_cylindrical_joints_are_told_apart_by_their_slides(own):
    """Turns and slides have the same axes, so that the determinant of all six is a square."""
    (sign,) = distinguishing_signs(own, "direct")
    values = assemblies_by_chance(own)
    assert {-1, 1} <= {*signs_of(own, "direct", values).ravel().tolist()}
    assert len(sign.factors[0].rates.T) == 3


def test_rods_on_universal_joints_are_named_as_rods_on_balls():
    """Each slide of this Delta is on one side of its rods or the other, whichever way round a rod's joint stands."""
    record = load_record("three_p2us")
    signs = distinguishing_signs(record, "inverse")
    assert [{name.partition(".")[0] for name in sign.joints} for sign in signs] == [{"leg1"}, {"leg2"}, {"leg3"}]
    home = home_values(record)
    assert np.allclose(
        frames(with_ball_ends(record), ball_ended_values(record, home[None]))["platform"][1],
        frames(record, home[None])["platform"][1],
    )


@pytest.mark.parametrize("own", ["five bars and a parallelogram"], indirect=True)
def test_no_mode_is_named_by_a_parallelogram_that_lies_flat_where_an_elbow_tells(own):
    """At some poses the elbow's two solutions have the parallelogram on either side, at others on one."""
    signs = distinguishing_signs(own, "inverse")
    assert not any(factor.moving for sign in signs for factor in sign.factors)
    solutions = inverse(own, pose_of(own, home_values(own)) + 0.01)
    told = signs_of(own, "inverse", solutions.joints[solutions.exists])
    assert len(np.unique(told, axis=0)) == len(told) == len(signs) == 2
