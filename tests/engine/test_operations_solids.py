"""Operations on surfaces: extrusion, booleans, selection, placing on all surfaces, chance, replay."""

import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import rectangle

from geoanalogy import Example, InputError, Mesh, OperationsTree, Polygon, Pose, Rectangle, Scene, Surface, learn_pose
from geoanalogy.geometry.extrusion import FaceLabels
from geoanalogy.geometry.frame import Frame
from geoanalogy.geometry.roof import Roof
from geoanalogy.operations.applied import instances
from geoanalogy.operations.boolean import Boolean
from geoanalogy.operations.decisions import Decisions, Pin
from geoanalogy.operations.extrusion import Extrusion
from geoanalogy.operations.layout import OnSurface
from geoanalogy.operations.node import Link, Node
from geoanalogy.operations.pose_placement import PosePlacement
from geoanalogy.operations.rectangle_placement import RectanglePlacement
from geoanalogy.operations.selection import Selection
from geoanalogy.operations.table import OPERATIONS

FRONT = "street wall"
WALLS = FaceLabels("wall", "roof", "floor", "roof", "gable")


def plot(number, width=14.0, depth=20.0, angle=0.0, at=None, **more):
    c, s = np.cos(angle), np.sin(angle)
    ring = rectangle(width, depth) @ np.array([[c, s], [-s, c]]) + (at or (30.0 * number, 0.0))
    labels = ["street", "side", "garden", "side"]
    return Polygon(ring, "plot", f"plot {number}", orientation=angle, segment_labels=labels, **more)


def plots(count=3):
    return [plot(i, 14.0 + 2 * i) for i in range(count)]


def drawn(scene, boxes, label, on, **settings_):
    """The placement of a label that is learned from boxes drawn in the polygons of another, in their own frames."""
    examples = []
    for polygon in [p for p in scene.polygons if p.label == on][: len(boxes)]:
        box = boxes[len(examples)]
        x, y = polygon.points.min(axis=0)
        examples.append(Example(scene, Rectangle.from_box(np.add(box, (x, y, x, y)), 0.0)))
    size = settings_.pop("size", (1.0, 1.0))
    return RectanglePlacement.learned(
        examples, label=label, mesh="", size=size, fill=(True,) * len(examples), **settings_
    )


def house(scene=None):
    scene = scene or Scene(plots())
    boxes = [(3, 5, 11 + 2 * i, 14) for i in range(3)]
    return Node("house", drawn(scene, boxes, "house", "plot", max_per={"plot": 1}))


def mass(**settings_):
    operation = Extrusion(label="house", **{"height": 3.0, "faces": WALLS, **settings_})
    return Node("mass", operation, (Link("house"),))


def window(tree, scene, source="mass"):
    """A window at a fixed distance from the left end of every front."""
    layout = tree.layout(scene, source)
    examples = []
    for s in layout.surfaces({FRONT}):
        sheet = OnSurface(layout.ground, surface=s, standing=tuple(layout.elements_on(s))).scene
        examples.append(Example(sheet, Rectangle(2.0, 1.6, 1.2, 1.2)))
    operation = RectanglePlacement.learned(
        examples, label="window", mesh="", size=(1.0, 1.0), fill=(True,) * len(examples), max_per={FRONT: 1}
    )
    return Node("window", operation, (Link(source),))


@pytest.fixture(scope="module")
def tree():
    """A house on every plot, its mass, a window in its front, pushed in."""
    scene = Scene(plots())
    made = OperationsTree([house(scene), mass()])
    made = made.with_node(window(made, scene))
    glass = FaceLabels("reveal", "glass")
    made = made.with_node(
        Node("hole", Extrusion(label="window", height=0.2, inwards=True, faces=glass), (Link("window"),))
    )
    return made.with_node(Node("cut", Boolean(label="window", kind="subtract"), (Link("hole"),)))


def named(elements, label):
    return [e for e in elements if e.label == label]


# ------------------------------------------------------------------------------------------------ the whole chain


def test_every_plot_gets_a_house_with_a_window_in_its_front(tree):
    applied = tree.apply(Scene(plots()), seed=7)
    assert applied.problems == ()
    houses, windows = named(applied, "house"), named(applied, "window")
    assert [h.parent for h in houses] == ["plot 0", "plot 1", "plot 2"] and len(windows) == 3
    for i, (one, opening) in enumerate(zip(houses, windows, strict=True)):
        width = 8.0 + 2 * i
        assert one.solid.is_closed and one.solid.volume == pytest.approx(width * 9 * 3 - 1.2 * 1.2 * 0.2, abs=1e-3)
        assert opening.owner == one.id and opening.surface == f"{one.id}:side 0" == opening.parent
        assert opening.absorbed_by == one.id and opening.mesh == ""
        # The opening is where it was drawn: 2 to the right of the front's left end, 1.6 up.
        assert opening.frame.to_space([opening.pose.position])[0] == pytest.approx((30 * i + 5, 5, 1.6), abs=0.05)
    labels = {s.label for s in applied.surfaces}
    assert labels == {"street wall", "side wall", "garden wall", "roof", "floor"} | {
        *("glass", "reveal", "upper reveal", "lower reveal")
    }


def test_elements_carry_their_meshes_in_space(tree):
    one = named(tree.apply(Scene(plots())), "house")[0]
    assert isinstance(one.mesh, Mesh)
    assert one.mesh.vertices.min(axis=0) == pytest.approx((3, 5, 0), abs=0.05)
    assert one.mesh.vertices.max(axis=0) == pytest.approx((11, 14, 3), abs=0.05)
    assert {"street wall", "glass"} <= set(one.mesh.materials) and one.mesh.uv.shape == (len(one.mesh.faces), 3, 2)


def test_flat_elements_are_flat_meshes_and_library_objects_names():
    scene = Scene(plots())
    flat = named(OperationsTree([house(scene)]).apply(scene), "house")[0]
    assert flat.mesh.vertices[:, 2].tolist() == [0] * 4 and flat.mesh.materials == ("house",)
    shed = dataclasses.replace(house(scene).operation, mesh="Shed")
    assert {e.mesh for e in OperationsTree([Node("shed", shed)]).apply(scene)} == {"Shed"}


def test_library_objects_are_put_in_their_places_and_missing_ones_named():
    scene = Scene(plots())
    shape = flat_mesh()
    operation = dataclasses.replace(house(scene).operation, mesh="Shed")
    tree = OperationsTree([Node("shed", operation)])
    placed = tree.apply(scene, library={"Shed": shape})
    assert placed.problems == ()
    assert placed[0].mesh.vertices.max(axis=0) - placed[0].mesh.vertices.min(axis=0) == pytest.approx(
        (8, 9, 0), abs=0.1
    )
    without = tree.apply(scene, library={})
    assert len(without) == 3
    assert without.problems == (
        "node 'shed': the library object 'Shed' is missing; its places stay empty, add it to the library",
    )


def flat_mesh():
    corners = np.column_stack([rectangle(1, 1, (-0.5, -0.5)), np.zeros(4)])
    faces = np.array([(0, 1, 2), (0, 2, 3)])
    return Mesh(corners, faces, corners[faces][..., :2], ("wood",), np.zeros(2, dtype=np.intp))


# ------------------------------------------------------------------------------------------------ extrusion


def test_sides_are_labelled_by_the_edges_they_face_wherever_the_plot_is(tree):
    turned = Scene([plot(7, angle=0.4, at=(3.0, -8.0)), plot(8, angle=np.pi + 0.1, at=(60.0, 9.0))])
    layout = tree.layout(turned, "mass")
    for one in named(layout.elements, "house"):
        front = next(s for s in layout.surfaces({FRONT}) if s.parent == one.id)
        ring = turned.polygon(one.parent).points
        outwards = (ring[1] - ring[0])[::-1] * (1, -1)
        assert front.frame.normal[:2] @ outwards == pytest.approx(np.hypot(*outwards))
        assert front.frame.y == pytest.approx((0, 0, 1))


def test_polygons_and_surfaces_are_extruded_too():
    scene = Scene([plot(0, holes=[rectangle(4, 4, (5, 8))])])
    ground = Node("floor", Extrusion(label="plot", height=0.5, faces=FaceLabels(top="deck")))
    upper = Node("tower", Extrusion(label="deck", height=2.0), (Link("floor"),))
    applied = OperationsTree([ground, upper]).apply(scene)
    assert [(e.label, e.parent) for e in applied] == [("plot", "plot 0"), ("deck", f"{applied[0].id}:top")]
    assert [e.solid.volume for e in applied] == pytest.approx([264 * 0.5, 264 * 2.0])
    assert applied[1].mesh.vertices[:, 2].min() == pytest.approx(0.5)


def test_heights_vary_between_their_limits_and_by_the_elements_own_name():
    scene = Scene([plot(i) for i in range(12)])
    tree = OperationsTree([house(Scene(plots())), mass(factor=(0.5, 2.0))])

    def heights(some, seed):
        return {e.id: e.mesh.vertices[:, 2].max() for e in tree.apply(some, seed)}

    every = heights(scene, 7)
    values = list(every.values())
    assert min(values) >= 1.5 and max(values) <= 6.0 and len(set(np.round(values, 6))) == 12
    assert heights(Scene(scene.polygons[::-1]), 7) == every
    assert heights(Scene(scene.polygons[4:6]), 7).items() <= every.items()
    assert heights(scene, 8) != every


@pytest.mark.parametrize("height", [0.0, -2.0])
def test_a_height_that_cannot_be_leaves_elements_flat_and_the_rest_done(height):
    scene = Scene(plots())
    chimney = Node("plinth", Extrusion(label="plot", height=0.1))
    applied = OperationsTree([house(scene), mass(height=height), chimney]).apply(scene)
    assert [e.solid is None for e in named(applied, "house")] == [True] * 3
    assert [e.solid.is_closed for e in named(applied, "plot")] == [True] * 3
    assert applied.problems[0] == (
        f"node 'mass': house '{named(applied, 'house')[0].id}' is left flat: the height is {height:g}; "
        "give a positive one"
    )


# ------------------------------------------------------------------------------------------------ booleans


def test_attachments_become_part_of_their_house(tree):
    scene = Scene(plots())
    bay = tree.with_node(Node("bay", Extrusion(label="window", height=0.5), (Link("window"),)))
    bay = bay.with_node(Node("merged", Boolean(label="window"), (Link("bay"),)))
    applied = bay.apply(scene)
    assert named(applied, "house")[0].solid.volume > 8 * 9 * 3
    layout = bay.layout(scene, "merged")
    one = named(layout.elements, "house")[0]
    sides = [s for s in layout.surfaces() if s.parent == one.id and s.label.endswith("facade")]
    assert {s.label for s in sides} >= {"upper facade", "lower facade"}
    # What stands on a surface that has become a part of the house is found there.
    front = next(s for s in layout.surfaces({"top"}) if s.parent == one.id)
    assert front.polygon.area == pytest.approx(1.44, abs=0.01)


def test_both_branches_changes_are_made_where_they_are_merged(tree):
    scene = Scene(plots())
    layout = tree.layout(scene, "mass")
    glass = FaceLabels("reveal", "glass")
    nodes = [*tree.nodes]
    for name, label in (("left", "side wall"), ("right", "garden wall")):
        sheets = [OnSurface(layout.ground, surface=s).scene for s in layout.surfaces({label})]
        examples = [Example(sheet, Rectangle(2.5, 1.5, 1.0, 1.0)) for sheet in sheets[:3]]
        operation = RectanglePlacement.learned(
            examples, label=name, mesh="", size=(1, 1), fill=(True,) * 3, max_per={label: 1}
        )
        nodes += [
            Node(f"{name} place", operation, (Link("mass"),)),
            Node(
                f"{name} push", Extrusion(label=name, height=0.2, inwards=True, faces=glass), (Link(f"{name} place"),)
            ),
            Node(f"{name} cut", Boolean(label=name, kind="subtract"), (Link(f"{name} push"),)),
        ]
    applied = OperationsTree(nodes).apply(scene)
    for one in named(applied, "house"):
        parts = [e for e in applied if e.absorbed_by == one.id]
        assert {e.label for e in parts} == {"window", "left", "right"}
        whole = one.base.volume - sum(0.2 * e.polygon.area for e in parts)
        assert one.solid.is_closed and one.solid.volume == pytest.approx(whole, abs=1e-3)
    assert OperationsTree(nodes[::-1]).apply(scene) == applied


def test_siblings_are_merged_and_subtracted():
    scene = Scene([plot(0)])
    wide, deep = (drawn(scene, [box], "part", "plot", max_per={"plot": 1}) for box in ((2, 4, 12, 10), (2, 8, 6, 15)))
    first = Node("a", wide)
    second = Node("b", dataclasses.replace(deep, label="other"), (Link("a"),))
    up = [
        Node("c", Extrusion(label="part", height=3.0), (Link("b"),)),
        Node("d", Extrusion(label="other", height=3.0), (Link("c"),)),
    ]
    for kind, volume in (("merge", 3 * (60 + 28 - 8)), ("subtract", 3 * (28 - 8))):
        boolean = Node("e", Boolean(label="part", kind=kind, target="siblings"), (Link("d"),))
        applied = OperationsTree([first, second, *up, boolean]).apply(scene)
        standing = [e for e in applied if e.solid is not None and not e.absorbed_by]
        assert [e.solid.volume for e in standing] == pytest.approx([volume])
        assert standing[0].label == ("part" if kind == "merge" else "other")


# ------------------------------------------------------------------------------------------------ selection


def selected(applied_plots, seed=3, **settings_):
    """Ids of the plots of every set."""
    selection = Selection(**{"label": "plot", **settings_})
    tree = OperationsTree([Node("select", selection)])
    return [
        {p.id for p in tree.layout(Scene(applied_plots), [Link("select", k)], seed).scene.polygons}
        for k in range(selection.outputs)
    ]


@given(st.integers(0, 1000), st.lists(st.floats(0.1, 5.0), min_size=1, max_size=4))
@settings(max_examples=20, deadline=None)
def test_sets_are_disjoint_and_complete(seed, weights):
    some = [plot(i) for i in range(20)]
    sets = selected(some, seed, weights=tuple(weights))
    assert sum(map(len, sets)) == len(set().union(*sets))
    if len(weights) > 1 or weights[0] >= 1:
        assert set().union(*sets) == {p.id for p in some}


def test_shares_follow_the_weights():
    some = [plot(i) for i in range(400)]
    one, three = selected(some, weights=(1.0, 3.0))
    assert len(one) == pytest.approx(100, abs=25) and len(three) == 400 - len(one)
    (some_of_them,) = selected(some, weights=(0.25,))
    assert len(some_of_them) == pytest.approx(100, abs=25)
    block = Polygon(rectangle(13000, 50, (-20, -10)), "block", "block")
    halves = selected([block, *some], weights=(1.0, 1.0), within="parent")
    assert [len(h - {"block"}) for h in halves] == [200, 200]


def test_a_set_does_not_depend_on_what_else_there_is():
    some = [plot(i) for i in range(20)]
    one, other = selected(some, weights=(1.0, 1.0))
    few, rest = selected(some[5:9][::-1], weights=(1.0, 1.0))
    assert few <= one and rest <= other
    assert selected(some, weights=(1.0, 1.0), seed=4) != [one, other]


def test_branches_place_in_their_own_sets_and_nothing_is_lost():
    scene = Scene([plot(i) for i in range(10)])
    node = house(Scene(plots()))
    select = Node("select", Selection(label="plot", weights=(1.0, 1.0)))
    low = dataclasses.replace(node, id="low", inputs=(Link("select", 0),))
    tree = OperationsTree([select, low])
    some = {e.parent for e in tree.apply(scene, 1)}
    assert 0 < len(some) < 10
    high = Node("high", dataclasses.replace(node.operation, label="tower"), (Link("select", 1),))
    both = tree.with_node(high).apply(scene, 1)
    assert {e.parent for e in named(both, "house")} == some
    assert {e.parent for e in named(both, "tower")} == {p.id for p in scene.polygons} - some
    # After the branches are merged, all plots are seen again.
    after = tree.with_node(high).with_node(
        Node("all", Extrusion(label="plot", height=0.1), (Link("low"), Link("high")))
    )
    assert len(named(after.apply(scene, 1), "plot")) == 10


def test_surfaces_and_elements_can_be_selected(tree):
    scene = Scene([plot(i) for i in range(8)])
    by_surface = OperationsTree([tree.node("house"), tree.node("mass")])
    select = Node("select", Selection(label=FRONT, weights=(1.0, 1.0)), (Link("mass"),))
    some = dataclasses.replace(tree.node("window"), inputs=(Link("select"),))
    placed = by_surface.with_node(select).with_node(some).apply(scene, 2)
    assert 0 < len(named(placed, "window")) < 8 and len(named(placed, "house")) == 8
    pushed = Node("push", Extrusion(label="window", height=0.1), (Link("half"),))
    half = Node("half", Selection(label="window", weights=(1.0, 1.0)), (Link("window"),))
    raised = OperationsTree([*(tree.node(n) for n in ("house", "mass", "window")), half, pushed]).apply(scene, 2)
    assert 0 < sum(e.solid is not None for e in named(raised, "window")) < len(named(raised, "window")) == 8


# ------------------------------------------------------------------------------------------------ placing on surfaces


def test_a_pose_is_propagated_to_all_surfaces(tree):
    scene = Scene(plots())
    layout = tree.layout(scene, "mass")
    front = next(layout.surfaces({FRONT}))
    sheet = OnSurface(layout.ground, surface=front).scene
    lamp = learn_pose(sheet, Pose((0.8, 2.2)), rectangle(0.2, 0.2, (-0.1, -0.1)))
    node = Node("lamp", PosePlacement(mesh="Lamp", label="lamp", model=lamp, max_per={FRONT: 1}), (Link("mass"),))
    lamps = named(tree.with_node(node).apply(scene), "lamp")
    assert {e.owner for e in lamps} == {e.id for e in named(layout.elements, "house")}
    for e in lamps:  # a rectangle fits onto itself turned by half: either corner is right
        height = e.frame.to_space([e.pose.position])[0][2]
        assert min(abs(height - 2.2), abs(height - 0.8)) < 0.05


def test_surfaces_that_the_user_chose_are_placed_on():
    """A wall in a scene that has none: equal to the fronts that a window was drawn in."""
    wall = Surface.of("wall 1", Frame.of((4, 9, 1), (0, 1, 0), (0, 0, 1)), Polygon(rectangle(8, 3), FRONT))
    other = Surface.of("wall 2", Frame.of((7, 0, 0), (-1, 0, 0), (0, 0, 1)), Polygon(rectangle(8, 3), FRONT))
    sheet = Scene([wall.polygon])
    drawn_here = RectanglePlacement.learned(
        [Example(sheet, Rectangle(2.0, 1.6, 1.2, 1.2))], label="window", mesh="", size=(1, 1), max_per={FRONT: 1}
    )
    out = Extrusion(label="window", height=0.3)
    tree = OperationsTree([Node("window", drawn_here), Node("out", out, (Link("window"),))])
    applied = tree.apply(Scene([]), surfaces=[wall, other])
    assert [(e.surface, e.owner) for e in applied] == [("wall 1", ""), ("wall 2", "")]
    assert applied[0].mesh.vertices.min(axis=0) == pytest.approx((4, 10.4, 2.0), abs=0.01)
    assert applied[1].mesh.vertices.max(axis=0) == pytest.approx((5.6, 0.3, 2.2), abs=0.01)
    assert [s.id for s in applied.surfaces][:2] == ["wall 1", "wall 2"]
    assert tree.evaluations.surfaces_reused == 1


def test_instances_share_their_shapes(tree):
    scene = Scene([plot(i, angle=0.3 * i) for i in range(3)])
    masses = OperationsTree([tree.node("house"), tree.node("mass")]).layout(scene).elements
    made = instances(masses)
    assert len(made) == 3 and len({id(one.mesh) for one in made}) == 1
    for one, e in zip(made, masses, strict=True):
        assert one.frame.to_space(one.mesh.vertices) == pytest.approx(e.geometry.vertices)
    shed = dataclasses.replace(house(Scene(plots())).operation, mesh="Shed")
    placed = OperationsTree([Node("shed", shed)]).layout(scene).elements
    assert [(one.mesh, one.scale) for one in instances(placed)] == [("Shed", (*e.stretch, 1.0)) for e in placed]
    assert [e for e in instances(tree.layout(scene).elements) if e.element.label == "window"] == []


def test_equal_surfaces_are_evaluated_once(tree):
    fresh = OperationsTree(tree.nodes)
    alike = Scene([plot(i, angle=0.3 * i) for i in range(6)])
    applied = fresh.apply(alike)
    assert len(named(applied, "window")) == 6
    assert fresh.evaluations.surfaces_evaluated == 1 and fresh.evaluations.surfaces_reused == 5
    assert applied.hit_rate == pytest.approx(5 / 6)
    keys = {e.key.removeprefix(e.surface) for e in named(applied, "window")}
    assert len(keys) == 1


def test_only_what_changed_is_evaluated_again(tree):
    fresh = OperationsTree(tree.nodes)
    evaluations = fresh.evaluations
    fresh.apply(Scene(plots()))

    def counted(scene, some=fresh):
        before = evaluations.evaluated, evaluations.surfaces_evaluated
        some.apply(scene)
        return evaluations.evaluated - before[0], evaluations.surfaces_evaluated - before[1]

    assert counted(Scene(plots())) == (0, 0)
    # One plot wider: the nodes see another input, but only its own front is searched again.
    wider = [plot(0, 15.0), *plots()[1:]]
    nodes, surfaces = counted(Scene(wider))
    assert surfaces == 1 and nodes >= 2
    # Deeper recesses: neither houses nor windows are placed again.
    deeper = dataclasses.replace(fresh.node("hole").operation, height=0.3)
    changed = fresh.with_node(dataclasses.replace(fresh.node("hole"), operation=deeper))
    assert counted(Scene(plots()), changed) == (2, 0)


def test_corrections_on_surfaces_survive_a_replay(tree):
    scene = Scene(plots())
    first, second, third = named(tree.apply(scene), "window")
    node = tree.node("window")
    decisions = Decisions().reject(first.key).pin(second.key, Pin(second.parent, (0.3, 0.0)))
    operation = dataclasses.replace(node.operation, decisions=decisions)
    corrected = OperationsTree.from_dict(
        json.loads(json.dumps(tree.with_node(dataclasses.replace(node, operation=operation)).to_dict()))
    )
    left = named(corrected.apply(scene), "window")
    assert [e.key for e in left] == [third.key, second.key] or [e.key for e in left] == [second.key, third.key]
    moved = next(e for e in left if e.key == second.key)
    assert moved.pose.position != second.pose.position and moved.absorbed_by == second.owner
    wall = next(s for s in corrected.layout(scene, "mass").surfaces({FRONT}) if s.id == second.surface)
    x = wall.polygon.centroid[0] + 0.3 * wall.polygon.size
    assert moved.pose.position[0] == pytest.approx(x)


# ------------------------------------------------------------------------------------------------ replay


def test_the_same_seed_gives_the_same_whatever_the_order(tree):
    scene = Scene(plots())
    one = OperationsTree(tree.nodes).apply(scene, seed=7)
    assert OperationsTree(tree.nodes[::-1]).apply(scene, seed=7) == one
    assert OperationsTree.from_dict(json.loads(json.dumps(tree.to_dict()))).apply(scene, seed=7) == one


def test_plots_do_not_depend_on_each_other(tree):
    every = {e.id: e for e in tree.apply(Scene(plots()), seed=7)}
    alone = [e for p in plots() for e in OperationsTree(tree.nodes).apply(Scene([p]), seed=7)]
    assert {e.id: e for e in alone} == every


@pytest.mark.parametrize(
    "operation",
    [
        Extrusion(label="house", height=3.0),
        Extrusion(
            label="house",
            height=2.0,
            factor=(0.5, 1.5),
            inwards=True,
            roof=Roof("mansard", 0.3, 1.2, 2.0, 4.0, 0.5),
            faces=WALLS,
        ),
        Boolean(label="window", kind="subtract", target="siblings"),
        Selection(label="window", weights=(1.0, 2.0), within="parent", seed=3),
    ],
)
def test_operations_are_stored(operation):
    plain = json.loads(json.dumps(operation.to_dict()))
    assert OPERATIONS[operation.type].from_dict(plain) == operation


@pytest.mark.parametrize(
    ("kind", "plain", "message"),
    [
        ("extrusion", {"label": "house"}, "the operation 'extrusion' lacks the setting 'height'; record it again"),
        (
            "extrusion",
            {"label": "house", "height": 3, "roof": {"kind": "dome"}},
            "'dome' is not among flat, hip, gable",
        ),
        ("extrusion", {"label": "house", "height": 3, "roof": {"storeys": 2}}, "has a damaged setting 'roof'"),
        ("extrusion", {"label": "house", "height": 3, "faces": {"door": "x"}}, "has a damaged setting 'faces'"),
        ("boolean", {"label": "house", "kind": "xor"}, "'xor' is not among merge, subtract"),
        ("selection", {"label": "house", "weights": []}, r"the weights are \[\]; give one positive number per set"),
        ("selection", {"label": "house", "weights": [1, -1]}, "give one positive number per set"),
    ],
)
def test_damaged_settings_are_named(kind, plain, message):
    with pytest.raises(InputError, match=message):
        OPERATIONS[kind].from_dict(plain)


def test_an_output_that_is_not_there_is_named(tree):
    select = Node("select", Selection(label="plot", weights=(1.0, 1.0)))
    with pytest.raises(InputError, match="node 'x' asks for output 2 of node 'select', which has 2; relink it"):
        OperationsTree([select, Node("x", Selection(label="plot"), (Link("select", 2),))])


def test_trees_learned_apart_grow_together(tree):
    scene = Scene(plots())
    masses = OperationsTree([tree.node("house"), tree.node("mass")])
    facades = OperationsTree([dataclasses.replace(tree.node("window"), inputs=()), tree.node("hole"), tree.node("cut")])
    grown = masses.with_tree(facades, [Link("mass")])
    assert grown.to_dict() == tree.to_dict()
    assert grown.apply(scene, seed=7) == tree.apply(scene, seed=7)
    apart = masses.with_tree(facades, [Link("mass")], prefix="front ")
    assert [node.id for node in apart.nodes] == ["house", "mass", "front window", "front hole", "front cut"]
    assert len(named(apart.apply(scene), "window")) == 3
    with pytest.raises(InputError, match="several nodes are called 'house'; give each node an id of its own"):
        masses.with_tree(masses, [Link("mass")])


def test_stored_trees_of_older_versions_are_migrated(tree, monkeypatch):
    plain = tree.to_dict()
    older = {**plain, "steps": plain["nodes"]}
    del older["nodes"]
    monkeypatch.setattr("geoanalogy.operations.storage.MIGRATIONS", (lambda p: {**p, "nodes": p["steps"]},))
    monkeypatch.setattr("geoanalogy.operations.storage.VERSION", 2)
    assert OperationsTree.from_dict(older).to_dict()["nodes"] == plain["nodes"]
    newest = {**plain, "schema": "geoanalogy.operations/2"}
    assert OperationsTree.from_dict(newest).to_dict() == newest
