"""The containment hierarchy (section 4.8)."""

import numpy as np
import pytest
import strategies
from hypothesis import given
from shapes import rectangle

from geoanalogy import InputError, Polygon, Scene


def polygon(id, width, height, corner, **more):
    return Polygon(rectangle(width, height, corner), label=id, id=id, **more)


def parents(scene):
    return {p.id: parent and parent.id for p in scene.polygons for parent in [scene.parent(p.id)]}


def members(scene, id):
    return [p.id for p in scene.members_of(id)]


#: A flat of two rooms with a wall of 0.2 between them, a door through that wall, a bed and a pillow on it.
FLAT = [
    polygon("pillow", 0.5, 0.3, (0.2, 0.2)),
    polygon("bed", 2, 1, (0.1, 0.1)),
    polygon("left", 4, 3, (0, 0)),
    polygon("right", 4.5, 3, (4.2, 0)),
    polygon("door", 0.4, 0.9, (3.9, 1)),
    polygon("flat", 9, 3.5, (-0.1, -0.1)),
]


def test_parent_is_the_smallest_that_holds():
    assert parents(Scene(FLAT)) == {
        "pillow": "bed",
        "bed": "left",
        "left": "flat",
        "right": "flat",
        "door": "flat",
        "flat": None,
    }


def test_a_door_across_the_wall_is_a_member_of_both_rooms():
    scene = Scene(FLAT)
    assert members(scene, "left") == ["bed", "door"]
    assert members(scene, "right") == ["door"]
    assert members(scene, "flat") == ["left", "right", "door"]


@pytest.mark.parametrize(("overlap", "parent"), [(0.96, "room"), (0.94, None)])
def test_a_parent_holds_95_percent(overlap, parent):
    scene = Scene([polygon("room", 4, 3, (0, 0)), polygon("shelf", 1, 0.5, (-1 + overlap, 1))])
    assert parents(scene)["shelf"] == parent
    assert members(scene, "room") == ["shelf"]


@pytest.mark.parametrize(("overlap", "expected"), [(0.06, ["shelf"]), (0.04, [])])
def test_touching_makes_no_member(overlap, expected):
    scene = Scene([polygon("room", 4, 3, (0, 0)), polygon("shelf", 1, 0.5, (-1 + overlap, 1))])
    assert members(scene, "room") == expected


def test_of_two_equal_polygons_the_first_holds_the_other():
    scene = Scene([polygon("a", 2, 2, (0, 0)), polygon("b", 2, 2, (0, 0))])
    assert parents(scene) == {"a": None, "b": "a"}


def test_what_stands_in_the_hole_does_not_belong():
    court = rectangle(2, 2, (1, 1))
    scene = Scene([Polygon(rectangle(4, 4), id="block", holes=[court]), Polygon(court, id="court")])
    assert parents(scene) == {"block": None, "court": None}


def test_a_stated_parent_wins_over_containment():
    scene = Scene([*FLAT, polygon("lamp", 0.2, 0.2, (1, 0.5), parent="right")])
    assert parents(scene)["lamp"] == "right"
    assert members(scene, "right") == ["door", "lamp"]
    assert "lamp" not in members(scene, "bed")


def test_a_stated_parent_that_lies_inside_its_child_stands():
    scene = Scene([polygon("room", 4, 3, (0, 0), parent="table"), polygon("table", 1, 1, (1, 1))])
    assert parents(scene) == {"room": "table", "table": None}


def test_unknown_parents_are_refused():
    with pytest.raises(InputError, match="polygon 'bed' names the parent 'attic', which is not in the scene; add it"):
        Scene([polygon("bed", 2, 1, (0, 0), parent="attic")]).parent("bed")


@pytest.mark.parametrize("circle", [["a"], ["a", "b"], ["a", "b", "c"]])
def test_circles_of_parents_are_refused(circle):
    polygons = [polygon(id, 1, 1, (2 * i, 0), parent=circle[i - 1]) for i, id in enumerate(circle)] + [
        polygon("d", 1, 1, (0, 5), parent="a")
    ]
    with pytest.raises(InputError, match="polygon 'a' is its own ancestor; correct the stated parents"):
        Scene(polygons).members_of("a")


def test_repeated_names_are_told_apart_by_what_they_hold():
    scene = Scene(
        [
            polygon("room", 4, 3, (0, 0)),
            polygon("room", 4, 3, (5, 0)),
            polygon("bed", 2, 1, (5.1, 0.1), parent="room"),
            polygon("bed", 2, 1, (0.1, 0.1), parent="room"),
        ]
    )
    expected = {"room": None, "room.001": None, "bed": "room.001", "bed.001": "room"}
    assert parents(scene) == expected
    assert parents(scene.with_polygons([polygon("lamp", 0.2, 0.2, (3, 2))])) == {**expected, "lamp": "room"}


@given(strategies.similarities(mirrored=True))
def test_hierarchy_does_not_change_with_similarity_transforms(similarity):
    moved = [Polygon(similarity(p.points), p.label, p.id) for p in FLAT]
    assert parents(Scene(moved)) == parents(Scene(FLAT))


def test_hierarchy_does_not_depend_on_the_order():
    for order in np.random.default_rng(0).permuted(np.tile(np.arange(len(FLAT)), (10, 1)), axis=1):
        assert parents(Scene([FLAT[i] for i in order])) == parents(Scene(FLAT))


def test_a_scene_that_grows_step_by_step_has_the_hierarchy_of_the_whole():
    """Later polygons hold earlier ones, lie in them, straddle them and equal them; one scene grows into several."""
    rng = np.random.default_rng(4)
    boxes = [rectangle(*rng.uniform(0.5, 4, 2), rng.uniform(0, 8, 2)) for _ in range(24)]
    boxes += [rectangle(12, 12, (-1, -1)), boxes[3], rectangle(0.2, 0.2, (4, 4))]
    polygons = [Polygon(box, "thing", f"thing {k}") for k, box in enumerate(boxes)]
    first = Scene(polygons[:8])
    for more in (polygons[8:12], polygons[8:], polygons[8:20], polygons[:7:-1]):
        grown, whole = first.with_polygons(more), Scene([*polygons[:8], *more])
        for p in whole.polygons:
            above, below = whole.parent(p.id), [m.id for m in whole.members_of(p.id)]
            grown_above = grown.parent(p.id)
            assert (grown_above and grown_above.id) == (above and above.id)
            assert [m.id for m in grown.members_of(p.id)] == below
    assert any(whole.members_of(p.id) for p in polygons[:8])
