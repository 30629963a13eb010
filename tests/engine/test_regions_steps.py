"""The steps of matching by themselves: alignment, modes, linkage, what is fitted."""

import numpy as np
import pytest
import shapely
from drawn import closed, fish, moved

import geoanalogy as ga
from geoanalogy.progress import run
from geoanalogy.regions.alignment import GAIN, align
from geoanalogy.regions.fitting import Fitter, distinct
from geoanalogy.regions.linkage import clusters, similarities
from geoanalogy.regions.query import Query, Run
from geoanalogy.regions.refinement import Refined, modes
from geoanalogy.regions.samples import Sampling
from geoanalogy.regions.transformation import Nodes

OUTLINE = fish()[0][:-1]


def runs_of(drawing):
    contours = drawing.contours
    return [Run(np.arange(contours.first[k], contours.first[k + 1]), bool(contours.closed[k])) for k in range(2)]


@pytest.mark.parametrize("begin", [0, 31, 97])
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_copy_aligns_wherever_its_line_begins(begin, mirrored):
    other = moved(closed(np.roll(OUTLINE, begin, axis=0)), 0.6, 1.0, (4.0, 1.0), mirrored)
    drawing = ga.Drawing([closed(OUTLINE), other])
    first, second = runs_of(drawing)
    best = align(drawing.contours, [first], [second], True, 10)[0]
    assert best.mirrored == mirrored
    assert 0.85 * GAIN < best.score <= 1.001 * GAIN
    there = np.conj(best.target) if mirrored else best.target
    truth = moved(drawing.out_of_frame(best.source), 0.6, 1.0, (4.0, 1.0), mirrored)
    assert np.linalg.norm(drawing.out_of_frame(there) - truth, axis=1).mean() < 0.02


def test_a_part_of_a_line_aligns_with_the_part_it_is():
    drawing = ga.Drawing([closed(OUTLINE), moved(OUTLINE[20:110], shift=(4.0, 0.0))])
    first, second = runs_of(drawing)
    best = align(drawing.contours, [first], [second], False, 10)[0]
    truth = moved(drawing.out_of_frame(best.source), shift=(4.0, 0.0))
    assert np.linalg.norm(drawing.out_of_frame(best.target) - truth, axis=1).mean() < 0.03


def spread(rng, image, factor, count):
    """Similarities near one."""
    noise = 0.01 * (rng.normal(size=count) + 1j * rng.normal(size=count))
    return image + noise, factor * np.exp(noise)


def test_modes_are_where_many_similarities_agree_for_each_query_point_by_itself():
    rng = np.random.default_rng(4)
    many, few = spread(rng, 2.0 + 1.0j, 0.5j, 30), spread(rng, -3.0 + 0.0j, 1.5, 10)
    image, factor = (np.concatenate([a, b])[None] for a, b in zip(many, few, strict=True))
    weight = np.ones((1, 40))
    row, found, scale, magnitude = modes(image, factor, weight, 1.0)
    assert row.tolist() == [0, 0]
    np.testing.assert_allclose(found, [2.0 + 1.0j, -3.0], atol=0.02)
    np.testing.assert_allclose(scale, [0.5j, 1.5], atol=0.02)
    assert magnitude[0] > 2.0 * magnitude[1]
    other = np.stack([image[0], image[0] + 5.0]), np.repeat(factor, 2, 0), np.repeat(weight, 2, 0)
    row, found, _, _ = modes(*other, 1.0)
    assert row.tolist() == [0, 0, 1, 1]
    np.testing.assert_allclose(found, [2.0 + 1.0j, -3.0, 7.0 + 1.0j, 2.0], atol=0.02)


def test_linkage_parts_two_smooth_functions_and_leaves_strays_alone():
    grid = np.array([x + 1j * y for x in range(5) for y in range(4)], complex)
    nodes = Nodes.of(grid, 1.0, 1.5)
    rng = np.random.default_rng(2)
    images = [10.0 + grid, 30.0 + 2.0 * grid]
    factors = [np.ones(20, complex), np.full(20, 2.0 + 0.0j)]
    stray = rng.uniform(-50, 50, 8) + 1j * rng.uniform(-50, 50, 8)
    refined = Refined(
        np.concatenate([np.arange(20), np.arange(20), np.arange(8)]),
        np.concatenate([*images, stray]),
        np.concatenate([*factors, np.ones(8, complex)]),
        np.zeros(48, bool),
        np.ones(48),
    )
    found = run(clusters(nodes, refined, similarities(nodes, refined), 5))
    assert [sorted(c.members.tolist()) for c in found] == [list(range(20)), list(range(20, 40))]
    assert found[0].tps == pytest.approx(1.0)


def test_functions_that_lead_to_the_same_places_are_one():
    rng = np.random.default_rng(6)
    at = rng.normal(size=20) + 1j * rng.normal(size=20)
    functions = np.array(
        [np.concatenate([a * at + b, np.full(20, a)]) for a, b in ((1, 0), (1, 0.09), (1, 0.15), (1, 0))]
    )
    mirrored = np.array([False, False, False, True])
    assert distinct(functions, mirrored, np.full(4, 0.1)).tolist() == [0, 2, 3]
    assert distinct(functions, mirrored, np.array([0.1, 0.05, 0.1, 0.1])).tolist() == [0, 1, 3]
    assert distinct(functions[:0], mirrored[:0], np.zeros(0)).tolist() == []


def test_a_coarse_sampling_has_longer_steps_along_the_same_lines():
    drawing = ga.Drawing([closed(OUTLINE), moved(closed(OUTLINE), shift=(4.0, 0.0))])
    ring = shapely.get_coordinates(shapely.box(*(OUTLINE.min(0) - 0.1), *(OUTLINE.max(0) + 0.1)).exterior)[:-1]
    query = Query.of(drawing, ring, ga.RegionOptions())
    nodes = Nodes.of(query.points, query.spacing, 1.5)
    fine, coarse = (Sampling.of(drawing.contours, query, nodes, k) for k in (1, 2))
    assert len(fine.samples.points) == 2 * len(coarse.samples.points)
    np.testing.assert_allclose(coarse.samples.step[1:], 2.0 * fine.samples.step[1], rtol=1e-6)
    line = shapely.LineString(drawing.into_frame(closed(OUTLINE)).view(float).reshape(-1, 2))
    away = shapely.distance(line, shapely.points(coarse.samples.points.real, coarse.samples.points.imag))
    assert away.max() < 0.01 * query.size
    identity = np.concatenate([nodes.at, np.ones(len(nodes.at))])
    np.testing.assert_allclose(coarse.rows @ identity, coarse.samples.points, atol=1e-9)


@pytest.mark.parametrize(("teeth", "passed_over"), [(6, False), (40, True)])
def test_lines_whose_bends_a_coarse_sampling_passes_over_are_sampled_finely_at_once(teeth, passed_over):
    turn = np.linspace(0.0, 2.0 * np.pi, 801)
    ring = (1.0 + 0.05 * np.cos(teeth * turn))[:, None] * np.stack([np.cos(turn), np.sin(turn)], 1)
    drawing = ga.Drawing([ring, moved(ring, shift=(4.0, 0.0))])
    box = np.array([(-1.2, -1.2), (1.2, -1.2), (1.2, 1.2), (-1.2, 1.2)])
    query = Query.of(drawing, box, ga.RegionOptions())
    fitter = Fitter(drawing.contours, query, Nodes.of(query.points, query.spacing, 1.5))
    assert (fitter.coarse is fitter.sampling) == passed_over
