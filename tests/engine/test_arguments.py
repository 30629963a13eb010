"""Whatever is given of a wrong type to a public name is named in one sentence that says what to give instead."""

from dataclasses import fields

import numpy as np
import pytest
from shapes import rectangle

import geoanalogy as ga
from geoanalogy.arguments import count, flag, is_whole, number, positive, real, shown, word
from geoanalogy.options import Options
from geoanalogy.poses.arrays import ArrayOptions
from geoanalogy.poses.local_mapping import TransferOptions
from geoanalogy.poses.scatter import ScatterOptions

NAN, INF = float("nan"), float("inf")
SCENE = ga.Scene(
    [ga.Polygon(rectangle(4, 3, (x, 0)), "bedroom", f"at {x}") for x in (0, 6)]
    + [ga.Polygon(rectangle(1, 1, (x, 1)), "bed", f"bed at {x}") for x in (1, 7)]
)
POSE, RING = ga.Pose((0.5, 0.5)), rectangle(0.4, 0.2)
EXAMPLES = [ga.Example(SCENE, ga.Rectangle(x, 0.5, 0.6, 0.4)) for x in (0.5, 6.5)]
SQUARE = np.vstack([rectangle(1, 1), [(0, 0)]])
DRAWING = ga.Drawing([SQUARE, SQUARE + np.array([3.0, 0.0])])
POSES = ga.learn_pose(SCENE, POSE, RING)
PLACES = POSES.place(SCENE)
MODEL = ga.learn_placement(EXAMPLES)
MATCHES = ga.match_regions(DRAWING, SQUARE)
TREE = ga.OperationsTree()

NOT_NUMBERS = (None, "x", b"x", [], [1.0], {}, 1j, NAN, object(), np.array([1.0, 2.0]))
NOT_COUNTS = (*NOT_NUMBERS, 2.5, INF, 10**400)
NOT_FLAGS = ("no", [], {}, 2, NAN, object(), np.array([1, 0]))
NOT_POINTS = (5, "x", {}, object(), [(1, 2), (3,)], [(NAN, 0)], np.zeros((3, 3)), 10**400)
NOT_LISTS = (5, NAN, "abc", object(), np.array(1.0))
NOT_MAPPINGS = (None, 5, "x", [1, 2], object())
NOT_PATHS = (None, 5, [], {}, object(), 1.5, "a\0b.json")
NO_KIND = (5, "x", [1], {"a": 1}, object(), NAN)
NO_OBJECT = (None, *NO_KIND)

#: What is called, with a value that is wrong, and the values.
CALLS = {
    "Polygon points": (ga.Polygon, NOT_POINTS),
    "Polygon holes": (lambda v: ga.Polygon(rectangle(4, 3), holes=v), NOT_LISTS),
    "Polygon orientation": (lambda v: ga.Polygon(rectangle(4, 3), orientation=v), (*NOT_NUMBERS[1:], INF)),
    "Polygon segment labels": (lambda v: ga.Polygon(rectangle(4, 3), segment_labels=v), (*NOT_LISTS, "door")),
    "Scene": (ga.Scene, (None, *NOT_LISTS, [rectangle(1, 1)])),
    "Scene offset": (lambda v: ga.Scene([], v), (None, *NOT_LISTS, (1,), (1, NAN), ("x", "y"))),
    "Scene.polygon": (SCENE.polygon, (None, 5, [], {}, np.zeros((2, 2)))),
    "Scene.members_of": (SCENE.members_of, (None, 5, [], {})),
    "Scene.parent_of": (SCENE.parent_of, (None, *NOT_POINTS, [], (1, 2, 3), [(1, 2), (3, 4)])),
    "Scene.parent_of_shape ring": (lambda v: SCENE.parent_of_shape(v, 0.9), (None, *NOT_POINTS, [])),
    "Scene.parent_of_shape share": (lambda v: SCENE.parent_of_shape(RING, v), (*NOT_NUMBERS, -0.1, 1.5)),
    "Scene.with_polygons": (SCENE.with_polygons, (None, *NOT_LISTS, [None])),
    "Pose position": (ga.Pose, (None, 5, "x", [], (1, 2, 3), (NAN, 0), 10**400, (10**400, 0))),
    "Pose angle": (lambda v: ga.Pose((0, 0), v), (None, "x", [], {}, 1j, NAN, INF, 10**400)),
    "Pose mirrored": (lambda v: ga.Pose((0, 0), 0.0, v), (None, *NOT_FLAGS)),
    "Pose.to_scene": (POSE.to_scene, NOT_POINTS),
    "Pose.to_frame": (POSE.to_frame, NOT_POINTS),
    "propagate_pose scene": (lambda v: ga.propagate_pose(v, POSE), NO_OBJECT),
    "propagate_pose pose": (lambda v: ga.propagate_pose(SCENE, v), NO_OBJECT),
    "propagate_pose footprint": (lambda v: ga.propagate_pose(SCENE, POSE, v), (*NOT_POINTS, [])),
    "propagate_pose options": (lambda v: ga.propagate_pose(SCENE, POSE, RING, v), (*NO_KIND, {"mirror": True})),
    "propagate_pose progress": (lambda v: ga.propagate_pose(SCENE, POSE, RING, progress=v), NO_KIND),
    "PoseModel.place": (POSES.place, NO_OBJECT),
    "PoseModel.from_dict": (ga.PoseModel.from_dict, (*NO_OBJECT, np.array([1, 2]), np.float64(1))),
    "PoseResults.above": (PLACES.above, NOT_NUMBERS),
    "PoseResults.max_per label": (lambda v: PLACES.max_per(v, 1), (None, 5, [], np.array([1, 2]))),
    "PoseResults.max_per count": (lambda v: PLACES.max_per("bedroom", v), (*NOT_COUNTS, -1)),
    "PoseResults.apart": (PLACES.apart, NOT_NUMBERS),
    **{
        f"Rectangle {f.name}": (
            lambda v, name=f.name: ga.Rectangle(**{"x": 0, "y": 0, "width": 1, "height": 1, name: v}),
            (*NOT_NUMBERS, INF, 10**400),
        )
        for f in fields(ga.Rectangle)
    },
    "Example scene": (lambda v: ga.Example(v, EXAMPLES[0].rectangle), NO_OBJECT),
    "Example rectangle": (lambda v: ga.Example(SCENE, v), (*NO_OBJECT, (0, 0, 1, 1))),
    "Example target": (lambda v: ga.Example(SCENE, EXAMPLES[0].rectangle, v), (*NOT_NUMBERS, -1, 1.5, INF)),
    "learn_placement": (ga.learn_placement, (None, *NOT_LISTS, [], [None], EXAMPLES[0])),
    "learn_placement options": (lambda v: ga.learn_placement(EXAMPLES, v), (*NO_KIND, {"tau": 2.0})),
    "PlacementModel.place": (MODEL.place, NO_OBJECT),
    "PlacementModel.place threshold": (lambda v: MODEL.place(SCENE, v), (*NOT_NUMBERS[1:], -0.1, 1.5)),
    "PlacementModel.place progress": (lambda v: MODEL.place(SCENE, progress=v), NO_KIND),
    "PlacementModel.place examples": (lambda v: MODEL.place(SCENE, include_examples=v), (None, *NOT_FLAGS)),
    "PlacementModel.novelties": (MODEL.novelties, NO_OBJECT),
    "PlacementModel.from_dict": (ga.PlacementModel.from_dict, (*NO_OBJECT, {"schema": np.zeros(3)})),
    **{
        f"PlacementModel.from_dict {part}": (
            lambda v, part=part: ga.PlacementModel.from_dict({**MODEL.to_dict(), part: v}),
            (None, 5, "x", [], [1], {"a": 1}),
        )
        for part in ("options", "examples", "boxes")
    },
    "PlacementModel.from_dict label": (
        lambda v: ga.PlacementModel.from_dict({**MODEL.to_dict(), "label": v}),
        (None, 5, [], {}),
    ),
    "PlacementModel.from_dict orientation": (
        lambda v: ga.PlacementModel.from_dict({**MODEL.to_dict(), "orientation": v}),
        (None, 5, "x", [1], {"a": 1}),
    ),
    "Drawing": (ga.Drawing, (None, *NOT_LISTS, [], SQUARE, [SQUARE[:1]])),
    "Drawing smoothing": (lambda v: ga.Drawing([SQUARE], smoothing=v), (*NOT_NUMBERS, -1, INF)),
    "match_regions drawing": (lambda v: ga.match_regions(v, SQUARE), (*NO_OBJECT, [SQUARE])),
    "match_regions query": (lambda v: ga.match_regions(DRAWING, v), (None, *NOT_POINTS)),
    "match_regions options": (lambda v: ga.match_regions(DRAWING, SQUARE, v), NO_KIND),
    "match_regions progress": (lambda v: ga.match_regions(DRAWING, SQUARE, progress=v), NO_KIND),
    "Matches.above": (MATCHES.above, (*NOT_NUMBERS, 10**400)),
    "RegionMatch.map": (MATCHES[0].map, (None, *NOT_POINTS)),
    "RegionMatch.confidence": (MATCHES[0].confidence, (None, *NOT_POINTS)),
    "OperationsTree": (ga.OperationsTree, (None, *NOT_LISTS, [None])),
    "OperationsTree.node": (TREE.node, (None, 5, [], {}, np.zeros(2))),
    "OperationsTree.apply scene": (TREE.apply, NO_OBJECT),
    "OperationsTree.apply seed": (lambda v: TREE.apply(SCENE, seed=v), NOT_COUNTS),
    "OperationsTree.apply progress": (lambda v: TREE.apply(SCENE, progress=v), NO_KIND),
    "OperationsTree.apply library": (lambda v: TREE.apply(SCENE, library=v), NOT_MAPPINGS[1:]),
    "OperationsTree.apply surfaces": (lambda v: TREE.apply(SCENE, surfaces=v), (None, *NOT_LISTS, [None])),
    "OperationsTree.from_dict": (ga.OperationsTree.from_dict, NO_OBJECT),
    "OperationsTree.load": (ga.OperationsTree.load, NOT_PATHS),
    "OperationsTree.save": (TREE.save, (*NOT_PATHS, "")),
    "read_scene": (ga.read_scene, NOT_PATHS),
    "read_scene label": (lambda v: ga.read_scene("plan.geojson", label=v), (5, [], object())),
    "read_scene scale": (lambda v: ga.read_scene("plan.geojson", scale=v), (*NOT_NUMBERS, 0, -1, INF)),
    "read_drawing": (ga.read_drawing, NOT_PATHS),
    "write_scene scene": (lambda v: ga.write_scene(v, "plan.geojson"), NO_OBJECT),
    "write_scene path": (lambda v: ga.write_scene(SCENE, v), NOT_PATHS),
}

#: What no option takes, by what its values are.
WRONG = {bool: NOT_FLAGS, int: NOT_COUNTS, float: (*NOT_NUMBERS, -1.0), str: (None, 5, "x", [], {}, np.zeros(2))}

#: Every class of options, with what it needs besides.
OPTIONS: dict[type[Options], dict] = {
    ga.PoseOptions: {},
    ga.PlacementOptions: {},
    ga.RegionOptions: {},
    ArrayOptions: {},
    ScatterOptions: {"count": 3},
    TransferOptions: {},
}

#: Options whose defaults do not tell what they take, or that take less than others of their type.
OWN = {
    "PoseOptions relations": (None, *NOT_LISTS, [], [None]),
    "PoseOptions mirror": NOT_FLAGS,
    "PoseOptions spacing": (*NOT_NUMBERS[1:], -1.0, INF),
    "PoseOptions relation_weights": (*NOT_MAPPINGS, {"bed": "x"}, {"bed": -1}, {"bed": NAN}),
    "PoseOptions clearance": (*NOT_MAPPINGS, {"door": "x"}, {"door": -1}, {"door": INF}),
    "PoseOptions max_per": (*NOT_MAPPINGS, {"room": "x"}, {"room": -1}, {"room": 0.5}),
    "PoseOptions alternative_geometry": (
        *NOT_MAPPINGS,
        {"door": "x"},
        {"door": [(0, 0), (1, 1)]},
        {"door": [(NAN, 0)] * 3},
    ),
    "PlacementOptions tau": (*NOT_NUMBERS, 0, -1, 1001),
    "ScatterOptions count": (*NOT_COUNTS, -1),
    "ScatterOptions spacing": (*NOT_NUMBERS[1:], -1, INF),
    "ScatterOptions width": (*NOT_NUMBERS, 0, -1, INF),
    "ScatterOptions sharpness": (*NOT_NUMBERS, -1, INF),
    "TransferOptions corner": (*NOT_COUNTS[1:], -1),
    "TransferOptions start": (*NOT_POINTS, [], (1, 2, 3), [(1, 2), (3, 4)]),
    "TransferOptions starts": (*NOT_MAPPINGS, {"bed": 5}, {"bed": [(1, 2), (3, 4)]}, {"bed": (NAN, 0)}),
}


def taking(kind, name, needed):
    """A call that gives one option of a class."""
    return lambda value: kind(**{**needed, name: value})


for KIND, NEEDED in OPTIONS.items():
    for FIELD in fields(KIND):
        NAME = f"{KIND.__name__} {FIELD.name}"
        if NAME != "ScatterOptions density":
            CALLS[NAME] = (taking(KIND, FIELD.name, NEEDED), OWN.get(NAME) or WRONG[type(FIELD.default)])
    CALLS[f"{KIND.__name__}.from_dict"] = (KIND.from_dict, (*NOT_MAPPINGS, {"no option": 1}))
CALLS["ScatterOptions density"] = (lambda v: ScatterOptions(density=v), (*NOT_NUMBERS, -0.1, INF))


def test_no_class_of_options_is_forgotten():
    assert set(Options.__subclasses__()) == set(OPTIONS)


@pytest.mark.parametrize("call", CALLS)
def test_what_is_of_a_wrong_type_is_named(call, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    give, values = CALLS[call]
    for value in values:
        try:
            give(value)
        except ga.InputError as error:
            sentence = str(error)
            assert "\n" not in sentence
            assert len(sentence) < 500
            assert "; " in sentence or ": " in sentence, f"{sentence!r} says nothing of what to do"
        else:
            pytest.fail(f"{value!r} is taken")


def test_lists_tuples_and_the_numbers_of_numpy_are_taken():
    room = ga.Polygon(
        [[0, 0], (4, 0), np.array([4, 3]), [0, 3]], label="bedroom", holes=None, orientation=np.float32(0)
    )
    scene = ga.Scene(iter([room]), offset=np.array([1, 2]))
    assert scene.parent_of([1, 1]) is scene.polygon("polygon 0")
    pose = ga.Pose(np.array([1, 1], dtype=np.int32), np.float32(0.5), np.bool_(True))
    assert pose == ga.Pose((1.0, 1.0), 0.5, True)
    assert ga.Rectangle(1, np.int8(2), np.float32(3), 4) == ga.Rectangle(1.0, 2.0, 3.0, 4.0)
    assert ga.RegionOptions(query_points=50.0, most=np.int64(3)) == ga.RegionOptions(most=3)
    assert ga.PlacementOptions(neighbours=np.int64(2), mirrored=np.bool_(True)).to_dict()["neighbours"] == 2
    assert TREE.apply(scene, seed=np.int64(3)) == []


def test_values_are_shown_on_one_short_line():
    assert shown(np.arange(6.0).reshape(3, 2)).count("\n") == 0
    assert len(shown("x" * 999)) < 50
    assert (shown(np.float64(0.5)), shown("half"), shown(None)) == ("0.5", "'half'", "None")


def test_numbers_are_told_from_what_is_none():
    assert [real(v) for v in (1, 2.5, np.int8(3), np.array(4.0), False)] == [1.0, 2.5, 3.0, 4.0, 0.0]
    assert np.isnan([real(v) for v in ("1", None, [1], 1j)]).all()
    assert (real(10**400), real(-(10**400))) == (INF, -INF)
    assert [is_whole(v) for v in (1, 2.0, np.int8(3), 2.5, INF, NAN, "1")] == [True, True, True, *[False] * 4]


@pytest.mark.parametrize(
    ("read", "value", "limits", "sentence"),
    [
        (number, 2, (0, 1), "the share is 2; give a number from 0 to 1"),
        (number, INF, (0,), "the share is inf; give a finite number from 0 on"),
        (positive, 0.0, (), "the share is 0.0; give a finite positive number"),
        (positive, 11, (10,), "the share is 11; give a positive number up to 10"),
        (positive, 0, (INF,), "the share is 0; give a positive number"),
        (count, 2.5, (1,), "the share is 2.5; give a whole number from 1 on"),
        (count, 9, (1, 8), "the share is 9; give a whole number from 1 to 8"),
        (flag, "no", (), "the share is 'no'; give True or False"),
        (word, "some", ("all", "none"), "the share is 'some'; choose from all, none"),
    ],
)
def test_what_cannot_be_used_is_named_with_what_is_wanted(read, value, limits, sentence):
    with pytest.raises(ga.InputError) as caught:
        read(value, "the share", *limits)
    assert str(caught.value) == sentence


def test_what_is_at_a_limit_is_taken():
    assert [number(v, "n", 0, 1) for v in (0, np.float32(1))] == [0.0, 1.0]
    assert positive(INF, "n", INF) == INF and positive(10, "n", 10) == 10.0
    assert [count(v, "n", 1, 8) for v in (1, 8.0, np.int64(3))] == [1, 8, 3]
    assert (flag(np.bool_(True), "n"), flag(0, "n"), word("all", "n", "all")) == (True, False, "all")


@pytest.mark.parametrize("kind", OPTIONS)
def test_options_are_stored_as_what_differs_from_the_defaults(kind):
    options = kind(**OPTIONS[kind])
    assert kind.from_dict(options.to_dict()) == options
    if kind is not ga.PlacementOptions:
        assert options.to_dict() == OPTIONS[kind]
