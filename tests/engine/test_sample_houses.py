"""The recorded houses: what their trees hold, and what they build on plots that they were not recorded on."""

import json
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
from sample_blends.houses import plots  # noqa: E402

HOUSES = ROOT / "sample_blends" / "houses"


@pytest.fixture(scope="module", params=plots.TYPES)
def built(request):
    """A type's tree, two plots that it was not recorded on, and what it builds there."""
    tree = OperationsTree.load(HOUSES / f"{request.param}.json")
    every = read_scene(HOUSES / "plots.geojson")
    scene = Scene([p for p in every.polygons if p.label == request.param][3:5])
    return tree, scene, tree.apply(scene, seed=7)


def on_surfaces(applied):
    found = defaultdict(list)
    for e in applied.layout.elements:
        if e.owner:
            found[e.surface].append(e)
    return found.values()


def test_the_plots_are_those_of_the_script():
    stored = read_scene(HOUSES / "plots.geojson")
    made = plots.quarter()
    assert Counter(p.label for p in stored.polygons) == dict.fromkeys(plots.TYPES, 10)
    for a, b in zip(stored.polygons, made.polygons, strict=True):
        assert (a.id, a.label, a.segment_labels) == (b.id, b.label, b.segment_labels)
        assert a.points == pytest.approx(b.points)
    outlines = [p.shape for p in made.polygons]
    tree = shapely.STRtree(outlines)
    assert len(tree.query(outlines, predicate="intersects")[0]) == len(outlines)
    assert all(len(plots.recorded(label).polygons) == 7 for label in plots.TYPES)


def test_every_type_takes_many_operations_of_a_few_examples_each(built):
    tree, _, _ = built
    assert len(tree.nodes) >= 45
    taught = [len(n.operation.model.lesson.taught) for n in tree.nodes if isinstance(n.operation, RectanglePlacement)]
    assert len(taught) >= 15 and min(taught) >= 2 and max(taught) <= 6
    kinds = Counter(n.operation.type for n in tree.nodes)
    assert kinds["extrusion"] >= 10 and kinds["boolean"] >= 8 and kinds["selection"] >= 1


def test_all_is_built_and_closed(built):
    _, scene, applied = built
    assert applied.problems == ()
    main = "block" if scene.polygons[0].label == "condominium" else "house"
    masses = [e for e in applied if e.label == main]
    assert sorted(e.parent for e in masses) == sorted(p.id for p in scene.polygons)
    assert all(e.solid.is_closed for e in applied if e.solid is not None and not e.absorbed_by)


def test_doors_stand_on_the_ground_on_the_street_side(built):
    _, scene, applied = built
    doors = [e for e in applied if e.label in ("door", "entrance")]
    assert len(doors) == len(scene.polygons)
    for e in doors:
        ring = e.frame.to_space(e.ring)
        assert ring[:, 2].min() == pytest.approx(0, abs=0.02)
        plot = next(p for p in scene.polygons if p.id in e.id)
        a, b = plot.points[:2]
        street = np.array([b[1] - a[1], a[0] - b[0]]) / np.hypot(*(b - a))
        assert e.frame.normal[:2] @ street == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize(
    ("label", "goal", "masses"),
    [("condominium", "parking", {"block", "wing", "stairs"}), ("two-storey", "garage", {"house", "garage"})],
)
def test_a_drive_leads_from_the_street_to_where_cars_stand(label, goal, masses):
    every = read_scene(HOUSES / "plots.geojson")
    scene = Scene([p for p in every.polygons if p.label == label][2:7])
    applied = OperationsTree.load(HOUSES / f"{label}.json").apply(scene, seed=7)
    there = defaultdict(list)
    for e in applied:
        if e.surface == "ground":
            there[e.parent, e.label].append(shapely.Polygon(e.frame.to_space(e.ring)[:, :2]))
    reached = wanted = 0
    for plot in scene.polygons:
        goals, drives = there[plot.id, goal], there[plot.id, "drive"]
        assert len(goals) <= len(drives) == 1
        wanted += len(goals)
        for drive in drives:
            assert drive.distance(shapely.LineString(plot.points[:2])) < 0.05
            assert plot.shape.buffer(0.05).contains(drive)
            reached += sum(drive.distance(to) < 0.2 for to in goals)
            assert goals or drive.length / 2 - 3.3 > 5.0  # a car stands in the open
            assert all(
                drive.intersection(mass).area < 0.05
                for (owner, name), shapes in there.items()
                for mass in shapes
                if owner == plot.id and name in masses | {"hedge", "walk", "path"}
            )
    assert reached == wanted >= 2


def test_nothing_on_the_ground_leaves_its_plot_or_meets_another(built):
    _, scene, applied = built
    joining = {"house", "wing", "bay", "garage", "block", "stairs", "parking", "drive"}
    for plot in scene.polygons:
        there = [e for e in applied.layout.elements if e.surface == "ground" and e.parent == plot.id]
        shapes = [shapely.Polygon(e.frame.to_space(e.ring)[:, :2]) for e in there]
        assert len(there) >= 5 and all(plot.shape.buffer(0.02).contains(shape) for shape in shapes)
        for i, (e, shape) in enumerate(zip(there, shapes, strict=True)):
            for other, its in zip(there[:i], shapes[:i], strict=True):
                assert {e.label, other.label} <= joining or shape.intersection(its).area < 0.05, (e.id, other.id)


def test_no_wall_to_the_garden_is_blank(built):
    _, _, applied = built
    openings = ("window", "door", "loggia")
    walls = 0
    for elements in on_surfaces(applied):
        wall = applied.layout.surface_under(elements[0])
        if wall is not None and wall.label.startswith("garden") and wall.label.endswith(" wall"):
            walls += 1
            area = sum(shapely.Polygon(e.ring).area for e in elements if e.label.endswith(openings))
            assert area >= 0.15 * wall.polygon.shape.area, wall.id
    assert walls >= 2


@pytest.mark.parametrize(("label", "ledge"), [("condominium", "loggia"), ("two-storey", "balcony door")])
def test_who_steps_out_of_an_upper_storey_stands_behind_a_parapet(label, ledge):
    every = read_scene(HOUSES / "plots.geojson")
    scene = Scene([p for p in every.polygons if p.label == label][1:3])
    applied = OperationsTree.load(HOUSES / f"{label}.json").apply(scene, seed=7)
    doors = [e for e in applied if e.label == ledge]
    tops = [e.place.to_space(e.base.vertices) for e in applied.layout.elements if e.label == "balcony"]
    assert len(doors) == len(tops) >= 2
    for e in doors:
        sill = e.frame.to_space(e.ring)
        beside = [p for p in tops if np.hypot(*(p.mean(axis=0) - sill.mean(axis=0))[:2]) < 2.0]
        assert any(0.8 <= p[:, 2].max() - sill[:, 2].min() <= 1.1 for p in beside), e.id


def test_all_storeys_of_a_condominium_have_windows_to_the_street_and_loggias_to_the_garden():
    every = read_scene(HOUSES / "plots.geojson")
    scene = Scene([p for p in every.polygons if p.label == "condominium"][::3])
    applied = OperationsTree.load(HOUSES / "condominium.json").apply(scene, seed=7)
    heights = set()
    for plot in scene.polygons:
        rows = {"window": set(), "loggia": set()}
        for e in applied:
            if e.label in rows and plot.id in e.id:
                rows[e.label].add(round(float(e.frame.to_space(e.ring)[:, 2].min()), 2))
        front = sorted(rows["window"])
        heights.add(len(front))
        assert 3 <= len(front) <= 5 and np.diff(front) == pytest.approx(3.15, abs=0.1)
        # Loggias begin a little lower, as one steps out to them.
        assert all(min(abs(low - z) for z in rows["loggia"]) == pytest.approx(0.35, abs=0.1) for low in front)
    assert len(heights) >= 2


def test_windows_are_clear_of_corners_and_of_each_other(built):
    _, _, applied = built
    count = 0
    for elements in on_surfaces(applied):
        wall = applied.layout.surface_under(elements[0])
        openings = [e for e in elements if e.label.endswith(("window", "door", "entrance", "loggia"))]
        if wall is None or not wall.label.endswith(" wall") or not openings:
            continue
        shapes = [shapely.Polygon(e.ring) for e in openings]
        for e, shape in zip(openings, shapes, strict=True):
            count += 1
            x0, _, x1, _ = shape.bounds
            left, _, right, _ = wall.polygon.bounds
            assert min(x0 - left, right - x1) >= 0.2, e.id
        shared = [a.intersection(b).area for i, a in enumerate(shapes) for b in shapes[:i]]
        assert max(shared, default=0.0) <= 0.02
    assert count >= 12


def test_panes_have_their_sills(built):
    _, _, applied = built
    counts = Counter(e.label for e in applied)
    sills = [name for name in counts if name.endswith(" sill")]
    missing = sum(abs(counts[name] - counts[name.removesuffix(" sill")]) for name in sills)
    assert sills and missing <= 0.05 * sum(counts[name] for name in sills)


def test_houses_differ(built):
    tree, scene, applied = built
    volumes = [round(e.solid.volume, 2) for e in applied if e.solid is not None and e.surface == "ground"]
    assert len(set(volumes)) > len(scene.polygons)
    other = tree.apply(scene, seed=8)
    assert Counter(e.label for e in other) != Counter(e.label for e in applied) or other != applied


def test_trees_are_plain_and_complete(built):
    tree, _, _ = built
    again = OperationsTree.from_dict(json.loads(json.dumps(tree.to_dict())))
    assert again.to_dict() == tree.to_dict()
