import numpy as np
import pytest

import assur
from assur.joint_graph.frames import frames
from assur.scene.companion import companion
from assur.scene.letters import CLOSE, letters
from assur.scene.skeleton import skeleton


@pytest.mark.parametrize("name", assur.names())
def test_every_mechanism_has_letters_apart_each_where_its_name_says(name):
    record = assur.load(name)
    body = skeleton(record, companion(record), record.home_values)
    found, placed = letters(body), frames(record, record.home_values)
    spots = [placed[item.link][0] @ item.at + placed[item.link][1] for item in found]
    for item, spot in zip(found, spots, strict=True):
        assert spot == pytest.approx(record.point(item.name, record.home_values), abs=1e-9 * body.size)
    gaps = [np.linalg.norm(a - b) for k, a in enumerate(spots) for b in spots[:k]]
    assert len(found) >= 3
    assert min(gaps) > CLOSE * body.size
