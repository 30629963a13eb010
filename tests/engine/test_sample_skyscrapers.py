"""The recorded skyscrapers: four trees, what they hold, and what they build when they are grown together."""

import sys
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np
import pytest
import shapely

from geoanalogy import OperationsTree, Scene, read_scene
from geoanalogy.operations.rectangle_placement import RectanglePlacement

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT))
from sample_blends.skyscrapers import __main__ as skyscrapers  # noqa: E402
from sample_blends.skyscrapers import lots  # noqa: E402


@pytest.fixture(scope="module")
def trees():
    return {name: OperationsTree.load(skyscrapers.HERE / f"{name}.json") for name in skyscrapers.SESSIONS}


@pytest.fixture(scope="module")
def masses(trees):
    scene = read_scene(skyscrapers.HERE / "lots.geojson")
    return scene, trees["mass"].apply(scene, seed=skyscrapers.SEED)


def lot_of(element, scene):
    return next(p for p in scene.polygons if p.id == element.parent or p.id in element.surface or p.id in element.id)


def shape_of(applied, scene):
    """The shape of the shaft of every lot."""
    found = {str(p.id): "stepped" for p in scene.polygons}
    found |= {lot_of(e, scene).id: "octagonal" for e in applied if e.label == "drum"}
    return found | {lot_of(e, scene).id: "winged" for e in applied if e.label == "wing"}


@pytest.fixture(scope="module")
def built(masses):
    """One lot of each shape with all its facades."""
    scene, applied = masses
    first = {shape: id for id, shape in reversed(shape_of(applied, scene).items())}
    some = Scene([p for p in scene.polygons if p.id in first.values()])
    return some, skyscrapers.grown().apply(some, seed=skyscrapers.SEED)


def test_the_lots_are_those_of_the_script():
    for name, made, least in (("examples", lots.recorded(), 9), ("lots", lots.built(), 9)):
        stored = read_scene(skyscrapers.HERE / f"{name}.geojson")
        assert len(made.polygons) >= least
        for a, b in zip(stored.polygons, made.polygons, strict=True):
            assert (a.id, a.label, a.segment_labels) == (b.id, b.label, b.segment_labels)
            assert a.points == pytest.approx(b.points)
    assert set(lots.RECORDED).isdisjoint(lots.BUILT)


def test_four_sessions_make_many_operations_of_a_few_examples_each(trees):
    assert len(trees) == 4 and sum(len(tree.nodes) for tree in trees.values()) >= 146
    nodes = [node for tree in trees.values() for node in tree.nodes]
    taught = [len(n.operation.model.lesson.taught) for n in nodes if isinstance(n.operation, RectanglePlacement)]
    assert min(taught) >= 2 and max(taught) <= 8
    kinds = Counter(n.operation.type for n in nodes)
    assert kinds["selection"] >= 4 and kinds["boolean"] >= 20
    assert sum(n.operation.factor[0] < n.operation.factor[1] for n in nodes if n.operation.type == "extrusion") >= 10
    assert sum(bool(n.operation.outline) for n in nodes if isinstance(n.operation, RectanglePlacement)) >= 4
    assert all((skyscrapers.HERE / f"{name}.json").stat().st_size <= 1_500_000 for name in trees)


def test_sessions_are_trees_of_their_own(trees):
    for tree in trees.values():
        ids = {node.id for node in tree.nodes}
        assert all(link.node in ids for node in tree.nodes for link in node.inputs)
    whole = skyscrapers.grown()
    assert len(whole.nodes) == sum(len(tree.nodes) for tree in trees.values())
    assert sum(not node.inputs for node in whole.nodes) == sum(not node.inputs for node in trees["mass"].nodes)


def test_masses_vary_in_shape_height_and_crown(masses):
    scene, applied = masses
    assert applied.problems == ()
    assert min(Counter(shape_of(applied, scene).values()).values()) >= 2
    assert len(Counter(shape_of(applied, scene).values())) == 3
    solids = [e for e in applied if e.label == "podium"]
    assert len(solids) == len(scene.polygons) and all(e.solid.is_closed for e in solids)
    heights = {round(float(e.solid.vertices[:, 2].max()), 2) for e in solids}
    assert len(heights) == len(solids) and min(heights) >= 60 and max(heights) >= 1.3 * min(heights)
    crowns = {lot_of(e, scene).id: e.label for e in applied if e.label in ("attic", "parapet", "lantern")}
    assert len(crowns) == len(scene.polygons) and len(set(crowns.values())) == 3
    assert Counter(e.label for e in applied)["tank"] == Counter(crowns.values())["parapet"]


def test_masses_stand_on_their_lots_and_get_narrower_upwards(masses):
    scene, applied = masses
    order = ("podium", "shaft", "setback", "tower")
    for lot in scene.polygons:
        there = {e.label: e for e in applied if lot_of(e, scene) is lot}
        shapes = [lot.shape] + [
            shapely.Polygon(there[label].frame.to_space(there[label].ring)[:, :2]) for label in order if label in there
        ]
        for above, below in zip(shapes[1:], shapes, strict=False):
            assert above.difference(below).area <= 0.01 * above.area and above.area < below.area, lot.id


def test_notches_and_octagons_are_where_they_belong(masses):
    scene, applied = masses
    shapes = shape_of(applied, scene)
    notches = Counter(lot_of(e, scene).id for e in applied if e.label == "notch")
    assert set(notches) == {id for id, shape in shapes.items() if shape == "winged"}
    assert set(notches.values()) == {4}
    for e in applied:
        if e.label == "drum":
            assert len(e.ring) == 8
            assert e.polygon.area < 0.95 * np.prod(np.ptp(e.ring, axis=0))


def test_facades_are_complete(built):
    scene, applied = built
    assert applied.problems == ()
    counts = defaultdict(Counter)
    for e in applied:
        counts[lot_of(e, scene).id][e.label] += 1
    assert len(counts) == 3
    for lot, found in counts.items():
        assert found["entrance"] == found["portal"] == found["canopy"] == 1, lot
        assert found["left shop"] >= 1 and found["right shop"] >= 1 and found["street cornice"] == 1, lot
        assert found["window"] + found["slot"] >= 40 and found["light"] >= 8, lot
        assert found["window"] == found["sill"] == found["sash"], lot
        assert found["slot"] == found["slot mullion"] and found["spandrel"] >= 5 * found["slot"], lot
    assert len({round(e.solid.volume) for e in applied if e.label == "podium"}) == 3


def test_doors_are_on_the_street_and_openings_clear_of_each_other_and_of_corners(built):
    _, applied = built
    on = defaultdict(list)
    for e in applied:
        if e.label in ("entrance", "slot", "window", "light") or e.label.endswith((" shop", " mezzanine")):
            on[e.surface].append(e)
        if e.label == "entrance":
            assert e.frame.normal.tolist() == pytest.approx([0, -1, 0], abs=1e-9)
            assert e.frame.to_space(e.ring)[:, 2].min() == pytest.approx(0, abs=1e-6)
    for elements in on.values():
        wall = applied.layout.surface_under(elements[0]).polygon.shape.buffer(1e-6)
        shapes = [e.polygon.shape for e in elements]
        assert all(wall.contains(shape) for shape in shapes), elements[0].surface
        tree = shapely.STRtree(shapes)
        for i, j in zip(*tree.query(shapes, predicate="intersects"), strict=True):
            assert i == j or shapes[i].intersection(shapes[j]).area <= 0.01, (elements[i].id, elements[j].id)
