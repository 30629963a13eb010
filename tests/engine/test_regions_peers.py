"""The methods that regions are compared with do what their papers say."""

import numpy as np
import pytest
from drawn import bent, fish, moved

from benchmarks.peers import agglomerative, robust_l2
from benchmarks.regions_scenes import SCENES
from geoanalogy.regions.correspondences import Correspondences

OUTLINE = fish()[0][::2]


def test_l2e_registers_a_slightly_bent_shape():
    target = moved(bent(OUTLINE, 0.3), 1.3, 0.1, (4.0, 1.0))
    carry = robust_l2.register(OUTLINE, target)
    assert np.linalg.norm(carry(OUTLINE) - target, axis=1).mean() < 0.05


def test_shape_contexts_do_not_depend_on_place_scale_and_direction():
    a = robust_l2.shape_contexts(OUTLINE)
    b = robust_l2.shape_contexts(moved(OUTLINE, 2.0, 0.7, (5.0, -3.0)))
    assert np.abs(a - b).mean() < 1e-3
    np.testing.assert_allclose(a.sum(1), 1.0)


def similar(source, factor, shift):
    return Correspondences(
        source, factor * source + shift, np.full(len(source), factor), np.zeros(len(source), bool), np.ones(len(source))
    )


def test_the_projection_error_is_zero_for_one_similarity_and_grows_with_what_another_misses():
    z = np.array([0.0, 1.0, 1.0j, 2.0 + 1.0j])
    c = similar(z, 1.5 * np.exp(0.4j), 3.0 + 1.0j)
    np.testing.assert_allclose(agglomerative.projection_error(c.source, c.image, c.factor), 0.0, atol=1e-12)
    image = c.image.copy()
    image[0] += 0.3
    error = agglomerative.projection_error(c.source, image, c.factor)
    assert error[0, 1] == pytest.approx((0.3 + 0.3 / 1.5) / 2)
    assert error[1, 2] == pytest.approx(0.0, abs=1e-12)


def test_correspondences_of_two_similarities_are_two_clusters():
    rng = np.random.default_rng(1)
    z = rng.uniform(0, 1, (12, 2)) @ (1, 1j)
    both = Correspondences.joined([similar(z, 1.0 + 0j, 3.0), similar(z, 0.5j, -4.0)])
    found = agglomerative.clustered(both, 1.0)
    assert sorted(len(c.source) for c in found) == [12, 12]
    carried = [c.carry(np.array([0.5 + 0.5j]), 0.1)[0] for c in found]
    assert min(abs(p - (3.5 + 0.5j)) for p in carried) < 1e-9


@pytest.mark.parametrize("name", SCENES)
def test_scenes_know_where_their_targets_are(name):
    scene = SCENES[name]()
    for target in scene.targets:
        assert scene.error(target(scene.points), target) == 0.0
        assert scene.error(target(scene.points) + 0.1, target) > 0.5
