"""The four city maps: enough lots, each on a street, clear of each other and of the streets, and room for its house."""

import json

import numpy as np
import pytest
import shapely

from geoanalogy import OperationsTree
from geoanalogy.batch.generation import Choices, generate, merged
from geoanalogy.formats.files import read_parcels
from geoanalogy.formats.repair import without_overlaps
from geoanalogy.geometry.scene import Scene
from sample_blends.city.ground import CARRIAGEWAY, PAVEMENT, SLIVER, strips
from sample_blends.city.lots import FURTHEST, TYPES, Lot, front_of, lot_in, lots_along
from sample_blends.city.maps import HERE, MAPS, ON_STREET
from sample_blends.houses.plots import TYPES as LABELS


@pytest.fixture(scope="module")
def maps():
    return {name: read_parcels(HERE / f"{name}.geojson") for name in MAPS}


def lots(scene):
    return [p for p in scene.polygons if p.label in LABELS]


def test_there_are_a_thousand_lots_of_three_types(maps):
    assert sum(len(lots(scene)) for scene, _ in maps.values()) >= 1000
    for name, (scene, problems) in maps.items():
        assert {p.label for p in lots(scene)} == set(LABELS), name
        assert [p for p in problems if "'lot " in p] == []
        said = []
        without_overlaps(scene, frozenset(LABELS), said)
        assert said == [], name


def test_every_lot_has_its_front_on_a_street(maps):
    for scene, _ in maps.values():
        streets = shapely.union_all([p.shape for p in scene.polygons if p.label == "street"])
        for p in lots(scene):
            assert p.segment_labels == ("street", "side", "garden", "side")
            assert shapely.LineString(p.points[:2]).distance(streets) < ON_STREET + FURTHEST
            assert p.shape.intersection(streets).area < 0.5
            along = p.points[1] - p.points[0]
            assert np.cos(np.arctan2(along[1], along[0]) - p.orientation) == pytest.approx(1, abs=1e-4)


def lot_of(p):
    """A lot of a file as the script has it."""
    along, deep = np.hypot(*(p.points[1:3] - p.points[:2]).T)
    return Lot(tuple(p.points[0]), p.orientation, along, deep, p.label)


def test_walks_and_drives_lead_to_a_pavement_past_all_trees(maps):
    for name, (scene, _) in maps.items():
        street = shapely.union_all([p.shape for p in scene.polygons if p.label == "street"])
        hard = ("pavement", "front walk", "front drive")
        paved = shapely.union_all([p.shape for p in scene.polygons if p.label in hard]).buffer(0.02)
        trees = shapely.points([p.centroid for p in scene.polygons if p.label.endswith("tree")])
        ways = [(lot, strip) for lot in map(lot_of, lots(scene)) for _, strip in strips(lot)]
        for lot, strip in ways:
            before = [p for p in shapely.get_parts(strip.difference(street)) if p.distance(lot.front) < 0.1]
            assert len(before) == 1 and strip.intersection(street).area > 0.3, (name, lot)
            assert before[0].difference(paved).area < 0.1 * before[0].area + 0.05, (name, lot)
            assert not shapely.contains(before[0], trees).any(), (name, lot)
        assert not len(shapely.STRtree(trees).query([p.shape for p in lots(scene)], predicate="contains")[0]), name


def test_pavements_are_of_one_width_and_the_ground_has_no_gaps(maps):
    for name, (scene, _) in maps.items():
        flat = [p.shape for p in scene.polygons if not p.label.endswith("tree")]
        labels = [p.label for p in scene.polygons if not p.label.endswith("tree")]
        street = shapely.union_all([s for s, label in zip(flat, labels, strict=True) if label == "street"])
        pavement = shapely.union_all([s for s, label in zip(flat, labels, strict=True) if label == "pavement"])
        assert pavement.difference(street.buffer(PAVEMENT - CARRIAGEWAY + SLIVER)).area < 0.01 * pavement.area, name
        beside = shapely.union_all([p.shape for p in lots(scene)]).buffer(3.0)
        bare = beside.difference(shapely.union_all(flat).buffer(0.03))
        assert bare.area < 0.002 * beside.area, name
        assert sum(s.area for s in flat) - shapely.union_all(flat).area < 0.001 * beside.area, name


def test_ways_are_where_houses_have_their_walks_and_drives(maps):
    scene = maps["grid"][0]
    for label in LABELS:
        tree = OperationsTree.load(HERE.parent / "houses" / f"{label}.json")
        for p in [p for p in lots(scene) if p.label == label][:3]:
            lot = lot_of(p)
            made = [e for e in tree.apply(Scene([p]), seed=7) if e.label in ("path", "walk", "drive")]
            begin = [shapely.Polygon(e.frame.to_space(e.ring)[:, :2]).buffer(0.01) for e in made]
            wanted = [shapely.box(a, 0.0, b, 0.1) for _, a, b in lot.ways]
            c, s = np.cos(lot.angle), np.sin(lot.angle)
            placed = [shapely.transform(w, lambda q: q @ [[c, s], [-s, c]] + lot.corner) for w in wanted]  # noqa: B023
            assert len(begin) == len(placed)
            assert all(any(b.contains(w) for b in begin) for w in placed), lot


def test_the_real_map_names_its_source():
    plain = json.loads((HERE / "bubenec.geojson").read_text(encoding="utf-8"))
    assert "momepy" in plain["attribution"] and "BSD-3-Clause" in plain["attribution"]
    assert "Redistribution and use" in (HERE / "LICENSE.momepy").read_text(encoding="utf-8")


def test_a_house_stands_on_every_lot_of_a_street(tmp_path, maps):
    scene = maps["bubenec"][0]
    some = [p for p in lots(scene)][::40]
    folder = HERE.parent / "houses"
    tree = merged([(name, OperationsTree.load(folder / f"{name}.json")) for name in LABELS])
    job = generate(tree, Scene(some), tmp_path, Choices(seed=7, detail="mass"))
    ((_, product),) = job.products()
    built = {product.masses.parcels[k] for k, label in enumerate(product.masses.labels) if label in ("house", "block")}
    assert built == {str(p.id) for p in some} and product.facts["problems"] == []


def test_the_largest_lot_is_found_in_a_plot():
    street = shapely.LineString([(-50, -5), (90, -5)])
    plot = shapely.Polygon([(0, 0), (40, 0), (40, 28), (22, 28), (22, 60), (0, 60)])
    angle = front_of(plot, street, 13.0)
    assert angle == pytest.approx(0.0)
    lot = lot_in(plot, angle, "a")
    assert lot.type == "condominium" and plot.buffer(0.3).contains(lot.shape)
    assert lot.width == pytest.approx(40, abs=1) and lot.depth == pytest.approx(28, abs=1)
    assert lot_in(shapely.box(0, 0, 8, 60), 0.0, "a") is None
    assert front_of(shapely.box(0, 60, 20, 90), street, 13.0) is None


def test_lots_along_a_street_do_not_meet():
    street = shapely.LineString([(0, 0), (60, 0), (120, 25)])
    paved = street.buffer(PAVEMENT - 0.3)
    found = lots_along([street], paved, PAVEMENT, (1, 1, 1), 2)
    assert len(found) >= 6 and {lot.type for lot in found} <= {name for name, *_ in TYPES}
    shapes = [lot.shape for lot in found]
    assert all(a.intersection(b).area < 0.06 for i, a in enumerate(shapes) for b in shapes[:i])
    assert not any(shape.intersects(paved) for shape in shapes)
