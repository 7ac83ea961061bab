import numpy as np

from assur.page.quantised import STEPS, quantised


def test_vertices_come_back_within_half_a_step_and_faces_exactly(rng, restored):
    vertices = rng.uniform([-300, 0, 1e-3], [200, 0, 2e-3], size=(500, 3))
    faces = rng.integers(0, 500, size=(900, 3))
    back, same = restored(quantised(vertices, faces))
    half = np.ptp(vertices, axis=0) / STEPS / 2
    assert np.all(np.abs(back - vertices) <= half * (1 + 1e-9) + 1e-12)
    assert np.array_equal(same, faces)


def test_the_ends_of_the_box_are_exact(rng, restored):
    vertices = rng.normal(size=(50, 3))
    back, _ = restored(quantised(vertices, np.zeros((1, 3), dtype=np.int64)))
    assert np.array_equal(back.min(axis=0), vertices.min(axis=0))
    assert np.allclose(back.max(axis=0), vertices.max(axis=0), rtol=1e-15)


def test_many_vertices_take_wide_faces(restored):
    vertices = np.column_stack([np.arange(70000.0)] * 3)
    faces = np.array([[0, 69999, 65536]])
    found = quantised(vertices, faces)
    assert found["wide"]
    assert np.array_equal(restored(found)[1], faces)
