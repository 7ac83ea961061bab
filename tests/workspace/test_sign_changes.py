"""Ways on which a map of a followed workspace shows that something vanishes, and what they meet."""

import numpy as np
import pytest

from assur.figures.catalogue import left_out, names
from assur.figures.context import Context
from assur.figures.singular import example_of
from assur.kinematics.rates.instantaneous import instantaneous
from assur.mechanism import load
from assur.singularity.examples import singular_examples
from assur.synthesis.drafting.attempts import DraftQuestion
from assur.synthesis.drafting.inputs import inputs_for
from assur.synthesis.drafting.layout import DraftLayout
from assur.topology.notation import parse_chains
from assur.workspace.region import workspace
from assur.workspace.sign_changes import ways_across

CHAINS = ["{P[z] R[y] R[y] | P[z] R[y] R[y]} R[z]", "P[x] R[y] R[y] R[z]"]


@pytest.fixture(scope="module")
def drafted(tmp_path_factory):
    """A drafted mechanism in whose box det Jp changes its sign, which no path from home to a pose by chance meets."""
    path = tmp_path_factory.mktemp("drafts") / "m2.toml"
    chains = parse_chains(CHAINS)
    inputs, topology = inputs_for(chains, None, "home")
    question = DraftQuestion(chains, path, inputs, topology, "home", coordinates=True)
    drawn = question.attempt(DraftLayout(knee=150.0, side=100.0, twist=-60.0), moved=False)
    path.write_text(drawn.text, encoding="utf-8")
    record = load(path)
    return record, workspace(record, resolution=12)


def test_a_way_leads_from_one_sign_of_the_determinant_to_the_other(drafted):
    record, found = drafted
    ways = list(ways_across(found))
    assert ways
    start = instantaneous(record, np.array([joints for joints, _ in ways]))
    assert start.closed.all()
    assert not start.singular_output.any()


def test_a_sign_change_on_the_map_has_its_example(drafted):
    """Paths from home to poses by chance meet none; the map shows a surface, and the example lies on it."""
    record, found = drafted
    assert found.parallel_singular.factors["output"].faces > 0
    assert "output" not in {item.factor.name for item in singular_examples(record)}
    example = next(
        item for item in singular_examples(record, ways=lambda: ways_across(found)) if item.factor.name == "output"
    )
    assert example.status.name == "parallel"
    here = instantaneous(record, example.joints)
    assert here.closed
    assert float(here.measures["output"]) < 1e-5
    surface = next(locus for locus in found.loci if locus.factor == "output")
    size = np.subtract(found.box.high, found.box.low)
    assert np.min(np.max(np.abs(surface.vertices - example.pose) / size, axis=1)) < 1.5 / 12


def test_the_figure_is_made_and_no_sentence_denies_it(drafted):
    record, found = drafted
    context = Context(record, found)
    assert example_of(context, "parallel") is not None
    assert "parallel" in names(record, context)
    assert "parallel" not in left_out(record, context)
