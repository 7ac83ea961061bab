import numpy as np
import pytest

from assur.figures import catalogue as figures
from assur.kinematics.rates.velocity import velocity_map
from assur.workspace.fields import at_points

pytestmark = pytest.mark.parametrize("context", ["fivebar", "zeng2019"], indirect=True)
"""Those of which lengths and angles do not mix."""


def test_the_map_is_the_inverse_condition_number_of_jp_and_jq(context, data):
    names = context.record.platform.pose
    for item in data("dexterity")["maps"]:
        first, second = item["plane"]
        rng = np.random.default_rng(5)
        seen = 0
        for _ in range(40):
            i, j = rng.integers(0, len(item[second])), rng.integers(0, len(item[first]))
            pose = np.array([{first: item[first][j], second: item[second][i], **item["held"]}[name] for name in names])
            value = item["index"][i][j]
            margins = [at_points(field, len(names), pose[None])[0] for field in context.workspace.margins.values()]
            if min(margins) < 0:
                assert np.isnan(value)
                continue
            here = velocity_map(context.record, pose, context.workspace.mode)
            jacobian = np.linalg.solve(here.jp, here.jq)
            np.testing.assert_allclose(value, 1 / np.linalg.cond(jacobian), rtol=1e-6)
            seen += 1
        assert seen > 5


@pytest.mark.parametrize(("figure", "key", "place"), [("fastest", "largest", 0), ("slowest", "smallest", -1)])
def test_the_velocity_factors_are_the_singular_values(context, data, figure, key, place):
    names = context.record.platform.pose
    seen = 0
    for item in data(figure)["maps"]:
        first, second = item["plane"]
        rows, columns = np.nonzero(np.isfinite(item[key]))
        for i, j in list(zip(rows, columns, strict=True))[:: max(1, len(rows) // 15)]:
            pose = [{first: item[first][j], second: item[second][i], **item["held"]}[name] for name in names]
            here = velocity_map(context.record, pose, context.workspace.mode)
            factors = np.linalg.svd(np.linalg.inv(here.jp) @ here.jq, compute_uv=False)
            np.testing.assert_allclose(item[key][i][j], factors[place], rtol=1e-6)
            seen += 1
    assert seen > 10


@pytest.mark.parametrize(("figure", "end"), [("fastest", "max"), ("dexterity", "neither"), ("slowest", "neither")])
def test_only_the_bar_of_colours_that_end_at_a_quantile_has_an_arrow(context, figure, end):
    assert figures.drawing(context.record, figure, context).figure.axes[-1]._colorbar.extend == end
