"""Learning from examples and placing: what is found, what stays the same, what is kept."""

import json

import numpy as np
import pytest
from placement_scenes import below, facade, overlap, polygon, values

import geoanalogy as ga

STREET = ga.Scene(facade(0, 4, 3) + facade(20, 5, 4, name="g") + facade(50, 2, 2, name="h"))
SHOWN = ("f 0 0", "f 2 1", "f 1 2", "f 3 0")


def learned(scene, ids=SHOWN, targets=None, **options):
    shown = [below(scene, i) for i in ids]
    targets = targets or [1.0] * len(shown)
    return ga.learn_placement(
        [ga.Example(scene, r, t) for r, t in zip(shown, targets, strict=True)], ga.PlacementOptions(**options)
    )


def wanted(scene, ids=SHOWN):
    return [below(scene, p.id) for p in scene.polygons if p.label == "window" and p.id not in ids]


@pytest.mark.parametrize("count", [2, 3, 4])
def test_sills_are_placed_below_every_other_window_of_every_facade_and_nowhere_else(count):
    found = learned(STREET, SHOWN[:count]).place(STREET)
    truth = wanted(STREET, SHOWN[:count])
    assert len(found) == len(truth)
    for sill in truth:
        assert max(overlap(p.rectangle, sill) for p in found) > 0.999


def test_results_are_ranked_within_their_parents_and_free_of_overlaps_and_examples():
    found = learned(STREET).place(STREET)
    scores = [p.score for p in found]
    assert scores == sorted(scores, reverse=True)
    assert all(0.5 <= s <= 1 for s in scores)
    shown = [below(STREET, i) for i in SHOWN]
    for i, p in enumerate(found):
        assert p.parent.label == "facade"
        x0, y0, x1, y1 = p.parent.bounds
        assert x0 <= p.rectangle.x <= x1 and y0 <= p.rectangle.y <= y1
        assert not any(overlap(p.rectangle, q.rectangle) > 0.02 for q in found[:i])
        assert not any(overlap(p.rectangle, s) > 0.02 for s in shown)


def test_a_threshold_of_zero_gives_all_candidates_and_a_high_one_only_the_surest():
    model = learned(STREET)
    every, usual = model.place(STREET, threshold=0), model.place(STREET)
    assert len(every) > 3 * len(usual)
    surest = model.place(STREET, threshold=usual[3].score)
    assert [p.score for p in surest] == [p.score for p in usual if p.score >= usual[3].score]
    assert model.place(STREET, threshold=1.0) == []


def test_examples_are_placed_again_with_their_targets_where_a_replay_asks_for_them():
    found = learned(STREET, targets=[1.0, 1.0, 1.0, 0.8]).place(STREET, include_examples=True)
    assert len(found) == len(wanted(STREET, ()))
    again = {i: max(found, key=lambda p, i=i: overlap(p.rectangle, below(STREET, i))) for i in SHOWN}
    assert [again[i].score for i in SHOWN] == [1.0, 1.0, 1.0, 0.8]
    assert again[SHOWN[0]].novelty == 0


def test_a_model_knows_the_drawing_it_was_taught_in_but_not_another_of_the_same_outline():
    model = learned(STREET)
    rebuilt = ga.Scene(list(STREET.polygons)[::-1])
    assert len(model.place(rebuilt)) == len(wanted(STREET))
    fewer = ga.Scene([p for p in STREET.polygons if p.id != "f 3 2"])
    assert len(model.place(fewer)) == len(wanted(fewer, ()))


def test_a_stored_model_gives_the_same_results():
    model = learned(STREET)
    text = json.dumps(model.to_dict(), allow_nan=False)
    again = ga.PlacementModel.from_dict(json.loads(text))
    assert np.array_equal(values(model.place(STREET)), values(again.place(STREET)))
    assert [p.score for p in model.place(STREET)] == [p.score for p in again.place(STREET)]
    assert again.to_dict() == model.to_dict()


def test_a_facade_without_anything_familiar_gets_nothing():
    bare = ga.Scene([polygon(0, 0, 12, 9, "facade", "bare")])
    assert learned(STREET).place(bare) == []
    assert learned(STREET).place(ga.Scene([polygon(0, 0, 12, 9, "garden")])) == []


def moved(scene, matrix, shift):
    return ga.Scene([ga.Polygon(p.points @ np.transpose(matrix) + shift, p.label, p.id) for p in scene.polygons])


def found_after(scene, matrix, shift, scale, order=slice(None)):
    changed = moved(scene, matrix, shift)
    examples = []
    for i in SHOWN:
        r = below(scene, i)
        x, y = np.asarray(matrix) @ (r.x, r.y) + shift
        examples.append(ga.Example(changed, ga.Rectangle(x, y, r.width * scale, r.height * scale)))
    return ga.learn_placement(examples[order]).place(changed)


UNEVEN = ga.Scene(facade(0, 4, 3) + facade(20, 3, 2, name="g"))
PLAIN = ga.learn_placement([ga.Example(UNEVEN, below(UNEVEN, i)) for i in SHOWN]).place(UNEVEN)


def assert_same(found, matrix, shift, scale):
    expected = values(PLAIN)
    expected[:, :2] = expected[:, :2] @ np.transpose(matrix) + shift
    expected[:, 2:4] *= scale
    got = values(found)
    assert len(got) == len(expected)
    for row in expected:
        assert np.abs(got - row).max(axis=1).min() < 1e-6 * scale
    assert np.allclose(sorted(p.score for p in found), sorted(p.score for p in PLAIN), atol=0.01)


@pytest.mark.parametrize(
    ("scale", "shift", "mirrored"), [(1.0, (13.7, -5.3), False), (1.0, (0.0, 0.0), True), (0.037, (2.0, 90.0), True)]
)
def test_translated_scaled_and_mirrored_scenes_have_the_translated_scaled_and_mirrored_answer(scale, shift, mirrored):
    matrix = scale * np.diag([-1.0 if mirrored else 1.0, 1.0])
    assert_same(found_after(UNEVEN, matrix, np.array(shift), scale), matrix, np.array(shift), scale)


def test_the_order_of_elements_and_of_examples_does_not_matter():
    turned = ga.Scene(list(UNEVEN.polygons)[::-1])
    assert_same(found_after(turned, np.eye(2), np.zeros(2), 1.0), np.eye(2), np.zeros(2), 1.0)
    assert_same(found_after(UNEVEN, np.eye(2), np.zeros(2), 1.0, slice(None, None, -1)), np.eye(2), np.zeros(2), 1.0)


def test_a_turned_scene_has_the_turned_answer_in_the_frame_of_its_parents():
    angle = 0.4
    c, s = np.cos(angle), np.sin(angle)
    matrix = np.array([[c, -s], [s, c]])
    changed = moved(UNEVEN, matrix, np.zeros(2))
    examples = []
    for i in SHOWN:
        r = below(UNEVEN, i)
        examples.append(ga.Example(changed, ga.Rectangle(*(matrix @ (r.x, r.y)), r.width, r.height, angle)))
    found = values(ga.learn_placement(examples).place(changed))
    assert len(found) == len(PLAIN)
    assert np.allclose(found[:, 4], angle)
    for row in values(PLAIN):
        place = matrix @ row[:2]
        assert np.abs(found[:, :4] - [*place, *row[2:4]]).max(axis=1).min() < 1e-6


def test_the_sides_of_rectangles_drawn_across_the_frame_are_not_swapped():
    examples = []
    for i in SHOWN:
        r = below(STREET, i)
        examples.append(ga.Example(STREET, ga.Rectangle(r.x, r.y, r.height, r.width, np.pi / 2)))
    found = values(ga.learn_placement(examples).place(STREET))
    assert len(found) == len(wanted(STREET))
    assert np.allclose(found[:, 4], np.pi / 2)
    assert (found[:, 2] < found[:, 3]).all()


def test_a_rejected_result_takes_those_like_it_along():
    # Sills are wanted below windows beside shutters; the rejected one is below a bare window.
    rows = [facade(20 * k, 4, 2, name=f"f{k}") for k in range(3)]
    shutters = []
    for k in range(3):
        for i in (0, 2):
            for j in range(2):
                x, y, *_ = next(p for p in rows[k] if p.id == f"f{k} {i} {j}").bounds
                shutters.append(polygon(x - 0.5, y, 0.4, 1.5, "shutter", f"s{k} {i} {j}"))
    scene = ga.Scene([*rows[0], *rows[1], *rows[2], *shutters])
    shown = ["f0 0 0", "f0 2 1", "f1 0 1"]
    before = learned(scene, shown).place(scene)
    bare = [below(scene, p.id) for p in scene.polygons if p.label == "window" and p.id.split()[1] in "13"]
    framed = [below(scene, p.id) for p in scene.polygons if p.label == "window" and p.id.split()[1] in "02"]

    def hits(found, places):
        return sum(any(overlap(p.rectangle, r) > 0.9 for p in found) for r in places)

    after = learned(scene, [*shown, "f0 1 0", "f1 3 1"], [1, 1, 1, 0, 0]).place(scene)
    assert hits(after, bare) == 0 and hits(before, bare) >= hits(after, bare)
    assert hits(after, framed) == len(framed) - len(shown)


def test_targets_grade_the_scores():
    scores = {}
    for target in (1.0, 0.5):
        found = learned(STREET, SHOWN, [target] * 4).place(STREET, threshold=0.05)
        scores[target] = max(p.score for p in found)
    assert scores[0.5] == pytest.approx(0.5 * scores[1.0])


def test_novelty_is_small_where_all_is_as_taught_and_large_where_nothing_is():
    model = learned(STREET)
    usual = model.place(STREET)
    assert np.median([p.novelty for p in usual]) < 0.2
    odd = ga.Scene([polygon(0, 0, 30, 9, "facade", "odd"), polygon(20, 3, 6, 4, "window", "w")])
    assert min(p.novelty for p in model.place(odd, threshold=0)) > 0.3


def test_parents_are_listed_by_their_novelty_also_where_nothing_is_placed():
    model = learned(STREET)
    bare = polygon(100, 0, 12, 9, "facade", "bare")
    odd = [polygon(200, 0, 30, 9, "facade", "odd"), polygon(220, 3, 6, 4, "window", "wide")]
    scene = ga.Scene([*STREET.polygons, bare, *odd])
    listed = model.novelties(scene)
    novelty = {parent.id: value for parent, value in listed}
    assert [value for _, value in listed] == sorted(novelty.values(), reverse=True)
    assert not [p for p in model.place(scene) if p.parent.id == "bare"]
    assert novelty["bare"] > 0.3 and novelty["odd"] > 0.3
    taught = {parent.id: value for parent, value in model.novelties(STREET)}
    assert min(taught.values()) == 0.0  # where examples were drawn all is known


def test_a_wider_kernel_is_more_tolerant():
    crooked = list(facade(0, 4, 2))
    crooked += facade(20, 3, 1, name="g")
    scene = ga.Scene(crooked)
    ids = ("f 0 0", "f 2 1", "f 1 0")
    shown = [below(scene, i) for i in ids]
    off = [ga.Rectangle(r.x, r.y - d, r.width, r.height) for r, d in zip(shown, (0.0, 0.12, 0.06), strict=True)]
    cohesion = [
        ga.learn_placement([ga.Example(scene, r) for r in off], ga.PlacementOptions(tau=tau)).lesson.cohesion
        for tau in (0.3, 1.0, 3.0)
    ]
    assert cohesion == sorted(cohesion) and cohesion[2] > cohesion[0] + 0.05


def test_forbidden_intersections_are_not_among_the_results():
    blocked = [polygon(4.2, 3.2, 1.6, 0.25, "lamp", "l")]
    scene = ga.Scene(facade(0, 4, 3) + blocked)
    ids = ("f 0 0", "f 2 1", "f 3 2")
    place = below(scene, "f 1 0")

    def hit(found):
        return any(overlap(p.rectangle, place) > 0.3 for p in found)

    assert hit(learned(scene, ids).place(scene, threshold=0))
    assert not hit(learned(scene, ids, forbid_intersections=True).place(scene, threshold=0))


def test_shape_tolerances_keep_deformed_boxes_out():
    wide = ga.Scene([*facade(0, 4, 2), polygon(20, 0, 12, 9, "facade", "g"), polygon(22, 4, 6, 1.5, "window", "w")])
    ids = ("f 0 0", "f 2 1")
    loose = learned(wide, ids).place(wide, threshold=0)
    strict = learned(wide, ids, aspect_tolerance=0.05, area_tolerance=0.05).place(wide, threshold=0.2)
    assert any(p.rectangle.width > 4 for p in loose)
    assert not any(p.rectangle.width > 2 for p in strict)


def test_progress_runs_from_parent_to_parent_and_cancels():
    seen = []

    def watch(fraction, text):
        seen.append((fraction, text))
        return len(seen) < 2

    with pytest.raises(ga.Cancelled):
        learned(STREET).place(STREET, progress=watch)
    assert [round(f, 3) for f, _ in seen] == [0, 0.333]
    assert seen[1][1] == "placing in facade 2 of 3"
