"""Letters: whatever a mechanism writes as LaTeX can be drawn; found here and not when someone draws."""

import pytest
from matplotlib.mathtext import MathTextParser

import assur
from assur.figures.letters import letter
from assur.scene.companion import companion
from catalogue import each

PARSER = MathTextParser("path")


def written(record):
    """Everything that stands between dollar signs in a figure: LaTeX of the mechanism, and its names."""
    form, drawn = record.closed_form, companion(record)
    named = [*record.inputs]
    if form is not None:
        named += [*form.factor_list, *form.quantity_list, *form.direct_margins, *form.inverse_margins]
    latex = [item.latex for item in named]
    latex += [form.self_motion.latex] if form is not None and form.self_motion else []
    latex += [step.latex for step in drawn.flow.steps.values()] + [item.latex for item in drawn.measures]
    names = [*record.joints, *record.points, *record.links, *record.angles, *record.platform.pose]
    return [f"${text}$" for text in latex if text] + [letter(name) for name in names]


@pytest.mark.parametrize("name", each())
def test_all_that_a_mechanism_writes_can_be_drawn(name):
    texts = written(assur.load(name))
    assert len(texts) > 10
    for text in texts:
        PARSER.parse(text)  # a ValueError says what is not understood


def test_the_law_can_fail():
    with pytest.raises(ValueError, match="unknown"):
        PARSER.parse(r"$\unknown{x}$")


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("leg1.A", "$A_{1}$"),
        ("leg12.B2", "$B_{12,2}$"),
        ("leg2.crank", "crank 2"),
        ("leg2.rod1", "rod 2,1"),
        ("l10", "$l_{10}$"),
        ("theta3", r"$\theta_{3}$"),
        ("O'", "$O$\N{PRIME}"),
    ],
)
def test_letters(name, expected):
    assert letter(name) == expected
