import itertools

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from assur.joint_graph.points import point
from assur.scene.skeleton import link_point


def test_joints_are_where_the_joint_graph_has_them(every, data_of_every):
    skeleton = every.schematic
    found = data_of_every("structure")["joints"]
    assert set(found) == set(every.record.joints)
    for name, item in found.items():
        here = point(skeleton.record, name, skeleton.values)
        joint = skeleton.record.joints[name]
        value = skeleton.values[next(c.index for c in skeleton.record.coordinates if c.joint == name)]
        slides = joint.type.name in ("prismatic", "cylindrical")
        rotation = skeleton.frames[joint.parent][0]
        moved = here + (value * (rotation @ joint.axes[0]) if slides else 0.0)
        np.testing.assert_allclose(item["at"], moved, atol=1e-9 * skeleton.size)
        assert item["links"] == [joint.parent, joint.child]


def test_every_driven_joint_is_marked(every, data_of_every):
    driven = {name for name, item in data_of_every("structure")["joints"].items() if item["driven"]}
    assert driven == {item.coordinate.joint for item in every.record.drives}


def test_every_link_but_the_base_is_drawn(every, data_of_every):
    found = data_of_every("structure")
    links = {item["link"] for item in (*found["bars"], *found["plates"])}
    wanted = set(every.record.links) - {every.record.base}
    assert links <= set(every.record.links)
    assert all(link in links or at_one_place(every, link) for link in wanted)


def at_one_place(every, link):
    """Whether all joints of a link are at one place: a slider is drawn by the symbol of its joint."""
    joints = [name for name, joint in every.record.joints.items() if link in (joint.parent, joint.child)]
    places = [link_point(every.record, every.schematic.frames, link, name) for name in joints]
    return len(joints) > 1 and np.max(np.ptp(places, axis=0)) < 1e-9 * every.schematic.size


def test_bars_of_a_link_reach_all_its_joints(every):
    skeleton = every.schematic
    for mark in skeleton.marks:
        for link in {mark.joint.parent, mark.joint.child} - {every.record.base}:
            if at_one_place(every, link):
                continue
            place = mark.rail if link == mark.joint.parent and mark.slides else mark.at
            rods = [rod.points for rod in skeleton.rods if rod.link == link]
            gaps = [_distance(place, *ends) for ends in rods]
            gaps += [
                float(np.min(np.linalg.norm(plate.points - place, axis=1)))
                for plate in skeleton.plates
                if plate.link == link
            ]
            assert min(gaps) < 1e-9 * skeleton.size, (mark.joint.name, link)


def _distance(at, start, end):
    way = end - start
    square = float(way @ way)
    share = np.clip((at - start) @ way / square, 0, 1) if square else 0.0
    return float(np.linalg.norm(at - start - share * way))


def test_no_label_lies_on_another_or_outside_the_page(page_of_every):
    for name in ("structure", "model"):
        figure = page_of_every(name)
        renderer = FigureCanvasAgg(figure).get_renderer()
        texts = [item for item in figure.axes[0].texts if item.get_text()]
        boxes = [item.get_window_extent(renderer) for item in texts]
        assert len(boxes) > 5
        width, height = figure.get_size_inches() * figure.dpi
        for text, box in zip(texts, boxes, strict=True):
            assert min(box.x0, box.y0, width - box.x1, height - box.y1) >= 0, text.get_text()
        for (a, first), (b, second) in itertools.combinations(zip(texts, boxes, strict=True), 2):
            shared_x = min(first.x1, second.x1) - max(first.x0, second.x0)
            shared_y = min(first.y1, second.y1) - max(first.y0, second.y0)
            assert min(shared_x, shared_y) < 1.0, (name, a.get_text(), b.get_text())
