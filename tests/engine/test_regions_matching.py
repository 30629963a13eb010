"""Matching regions end to end: what is found, where points are mapped, and what does not change the answer."""

import numpy as np
import pytest
from drawn import bent, box, closed, clutter, fish, inner_points, moved
from hypothesis import given, settings
from hypothesis import strategies as st

import geoanalogy as ga
from geoanalogy.regions.view import transformation_space

POINTS = inner_points()


def swum(points):
    """The bent fish of the tests: smaller, turned, elsewhere."""
    return moved(bent(points, 1.2), 0.8, 2.0, (2.5, 0.5))


def error(match, truth, size):
    """Mean distance of the mapped points from the truth, as a share of the target's size."""
    return np.linalg.norm(match.map(POINTS) - truth, axis=1).mean() / size


@pytest.fixture(scope="module")
def pond():
    lines = fish() + [swum(line) for line in fish()] + clutter(np.random.default_rng(1), 8)
    drawing = ga.Drawing(lines)
    return drawing, ga.match_regions(drawing, box(fish()))


def test_a_bent_fish_among_clutter_is_found_first(pond):
    _, matches = pond
    assert not matches[0].mirrored
    assert error(matches[0], swum(POINTS), 0.8) < 0.02


def test_similarities_descend_from_at_most_one(pond):
    _, matches = pond
    every = [m.similarity for m in matches.every]
    assert every == sorted(every, reverse=True)
    assert 0.0 <= every[-1] and every[0] <= 1.0


def test_clutter_stays_below_the_default_threshold(pond):
    _, matches = pond
    assert len(matches) == 1


def test_the_threshold_moves_without_matching_again(pond):
    _, matches = pond
    assert list(matches.above(0.0)) == matches.every
    assert list(matches.above(0.0)[:1]) == [matches[0]]
    assert len(matches.above(1.0)) == 0


def test_an_identical_copy_is_mapped_onto_itself():
    lines = fish() + [moved(line, shift=(2.0, 0.0)) for line in fish()]
    (match,) = ga.match_regions(ga.Drawing(lines), box(fish()))
    assert error(match, moved(POINTS, shift=(2.0, 0.0)), 1.0) < 0.001
    assert match.similarity > 0.95 and match.coverage > 0.98


def test_the_query_itself_is_never_a_match():
    assert (
        len(ga.match_regions(ga.Drawing(fish()), box(fish()), ga.RegionOptions(threshold=0.0, contrast=0.0)).every) == 0
    )


def test_a_mirrored_fish_is_found_and_marked():
    lines = fish() + [moved(line, 0.7, 1.0, (2.0, 0.0), mirrored=True) for line in fish()]
    drawing = ga.Drawing(lines)
    (match,) = ga.match_regions(drawing, box(fish()))
    assert match.mirrored
    assert error(match, moved(POINTS, 0.7, 1.0, (2.0, 0.0), mirrored=True), 0.7) < 0.002
    unmirrored = ga.match_regions(drawing, box(fish()), ga.RegionOptions(mirrored=False, threshold=0.0, contrast=0.0))
    assert not any(m.mirrored for m in unmirrored)


def test_several_fish_of_different_sizes_are_all_found():
    moves = [(0.5, 0.3, (2.0, 0.0)), (1.5, 2.0, (0.0, 2.5)), (0.2, 4.0, (3.0, 2.0))]
    lines = fish() + [moved(bent(line, 0.6), *m) for m in moves for line in fish()]
    matches = ga.match_regions(ga.Drawing(lines), box(fish()))
    assert len(matches) == 3
    for m in moves:
        truth = moved(bent(POINTS, 0.6), *m)
        assert min(error(match, truth, m[0]) for match in matches) < 0.02


def test_where_nothing_supports_the_mapping_it_says_so():
    outline, gill, side = (swum(line) for line in fish())
    lines = [*fish(), outline[40:135], gill, side]
    match = ga.match_regions(ga.Drawing(lines), box(fish()))[0]
    assert match.coverage < 0.85
    assert error(match, swum(POINTS), 0.8) < 0.065
    known = np.concatenate([fish()[0][60:110], fish()[2]])
    missing = np.concatenate([fish()[0][:20], fish()[0][150:]])
    assert match.confidence(known).mean() > match.confidence(missing).mean() + 0.3
    assert ((match.confidence(POINTS) >= 0.0) & (match.confidence(POINTS) <= 1.0)).all()


def test_a_smooth_mapping_has_no_folds(pond):
    _, matches = pond
    x, y = np.meshgrid(np.linspace(0.1, 0.85, 30), np.linspace(-0.05, 0.1, 8))
    grid = matches[0].map(np.stack([x.ravel(), y.ravel()], 1)).reshape(8, 30, 2)
    right, up = grid[:-1, 1:] - grid[:-1, :-1], grid[1:, :-1] - grid[:-1, :-1]
    assert (right[..., 0] * up[..., 1] - right[..., 1] * up[..., 0] > 0.0).all()


def test_a_stroke_is_matched_along_a_thin_shape():
    x = np.linspace(0.0, 2.0, 80)
    weed = np.stack([x, 0.15 * np.sin(7.0 * x) * (0.4 + x) + 0.1 * np.cos(13.0 * x)], 1)
    other = moved(weed, 0.7, 1.2, (4.0, 0.0))
    match = ga.match_regions(ga.Drawing([weed, other]), weed[5:75], ga.RegionOptions(reach=0.05))[0]
    assert np.linalg.norm(match.map(weed[10:70]) - other[10:70], axis=1).mean() < 0.02


def test_a_ring_and_a_stroke_may_be_stated():
    ring = box(fish())
    drawing = ga.Drawing(fish() + [moved(line, shift=(2.0, 0.0)) for line in fish()])
    by_ring = ga.match_regions(drawing, ring, ga.RegionOptions(query_kind="region"))
    assert by_ring[0].similarity == ga.match_regions(drawing, closed(ring))[0].similarity
    outline = fish()[0]
    by_stroke = ga.match_regions(drawing, outline, ga.RegionOptions(query_kind="stroke", reach=0.02))
    assert error(by_stroke[0], moved(POINTS, shift=(2.0, 0.0)), 1.0) < 0.01


def test_branches_may_share_lines():
    trunk = np.stack([np.linspace(0.0, 1.0, 40), 0.1 * np.sin(np.linspace(0.0, 9.0, 40))], 1)
    twig = np.array([(0.0, 0.0), (0.2, 0.12), (0.25, 0.3), (0.42, 0.36), (0.5, 0.55), (0.72, 0.6)])
    path = np.vstack([trunk, trunk[-1] + twig])
    fork = [moved(p, shift=(4.0, 0.0)) for p in (path, trunk[-1] + moved(twig, angle=-0.9))]
    drawing = ga.Drawing([path, *fork])
    ring = box([path])
    alone = ga.match_regions(drawing, ring, ga.RegionOptions(threshold=0.0, contrast=0.0))
    both = ga.match_regions(drawing, ring, ga.RegionOptions(threshold=0.0, contrast=0.0, branches=True))
    assert len(both.every) > len(alone.every)


def test_a_joint_is_forgiven_by_its_tolerance():
    arm = [
        closed(
            [
                (0, 0),
                (0.5, 0.05),
                (1.0, 0.0),
                (1.5, 0.05),
                (1.9, 0.2),
                (2.0, -0.1),
                (1.5, -0.2),
                (0.5, -0.25),
                (0, -0.2),
            ]
        )
    ]
    at = np.array([1.0, -0.1])

    def folded(p):
        p = np.asarray(p, float)
        return moved(np.where(p[:, :1] > 1.0, moved(p - at, 1.0, 0.9) + at, p), shift=(4.0, 0.0))

    drawing = ga.Drawing([*arm, folded(arm[0])])
    strict = ga.match_regions(drawing, box(arm), ga.RegionOptions(threshold=0.0, contrast=0.0))
    lenient = ga.match_regions(drawing, box(arm), ga.RegionOptions(threshold=0.0, contrast=0.0, joint_tolerance=1.0))
    assert lenient[0].evidence.smooth > strict[0].evidence.smooth
    assert lenient[0].similarity > strict[0].similarity


def test_a_circle_comes_to_an_end():
    turn = np.linspace(0.0, 2.0 * np.pi, 200)
    circle = np.stack([np.cos(turn), np.sin(turn)], 1)
    drawing = ga.Drawing([circle, 0.5 * circle + (3.0, 0.0), 2.0 * circle + (7.0, 0.0)])
    matches = ga.match_regions(drawing, box([circle]))
    assert len(matches) == 2
    assert sorted(round(float(np.ptp(m.map(circle)[:, 0])), 1) for m in matches) == [1.0, 4.0]


@settings(max_examples=6, deadline=None)
@given(
    angle=st.floats(-3.1, 3.1),
    scale=st.floats(0.01, 100.0),
    shift=st.tuples(st.floats(-100, 100), st.floats(-100, 100)),
    mirrored=st.booleans(),
)
def test_the_answer_moves_with_the_drawing(angle, scale, shift, mirrored):
    lines = fish() + [swum(line) for line in fish()]

    def move(p):
        return moved(p, scale, angle, np.multiply(shift, scale), mirrored)

    match = ga.match_regions(ga.Drawing([move(line) for line in lines]), move(box(fish())))[0]
    assert not match.mirrored
    assert np.linalg.norm(match.map(move(POINTS)) - move(swum(POINTS)), axis=1).mean() < 0.01 * scale


@settings(max_examples=4, deadline=None)
@given(seed=st.integers(0, 1000))
def test_the_order_direction_and_sampling_of_strokes_do_not_matter(seed):
    rng = np.random.default_rng(seed)
    lines = fish() + [swum(line) for line in fish()]
    other = []
    for k in rng.permutation(len(lines)):
        line = lines[k][:: rng.choice([-1, 1])]
        at = np.sort(np.concatenate([np.arange(len(line)), rng.uniform(0, len(line) - 1, 40)]))
        other.append(np.stack([np.interp(at, np.arange(len(line)), line[:, i]) for i in (0, 1)], 1))
    match = ga.match_regions(ga.Drawing(other), box(fish()))[0]
    assert error(match, swum(POINTS), 0.8) < 0.01


def test_the_same_input_gives_the_same_answer(pond):
    drawing, matches = pond
    again = ga.match_regions(drawing, box(fish()))
    assert [m.similarity for m in again.every] == [m.similarity for m in matches.every]
    np.testing.assert_array_equal(again[0].map(POINTS), matches[0].map(POINTS))


def test_progress_runs_from_zero_towards_one_and_cancels():
    drawing = ga.Drawing(fish() + [swum(line) for line in fish()])
    steps = []
    ga.match_regions(drawing, box(fish()), progress=lambda fraction, text: steps.append((fraction, text)) or True)
    fractions = [f for f, _ in steps]
    assert fractions[0] == 0.0 and fractions == sorted(fractions) and fractions[-1] <= 1.0
    assert len({text for _, text in steps}) >= 4
    with pytest.raises(ga.Cancelled):
        ga.match_regions(drawing, box(fish()), progress=lambda fraction, text: fraction < 0.4)


def test_the_transformation_space_shows_the_inliers(pond):
    drawing, matches = pond
    space = transformation_space(drawing, matches)
    assert len(space.scale) == len(space.match) == len(matches.refined)
    own = space.match == 0
    assert 0.0 < space.inliers < 1.0 and space.weighted_inliers > space.inliers
    assert np.median(space.scale[own]) == pytest.approx(0.8, rel=0.15)
    np.testing.assert_allclose(space.query_point + space.translation, space.target)
    truth = swum(space.query_point[own])
    assert np.median(np.linalg.norm(space.target[own] - truth, axis=1)) < 0.08
    assert len(transformation_space(drawing, matches, least=0.5).scale) < len(space.scale)
