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
from sample_blends.city.lots import FURTHEST, TYPES, front_of, lot_in, lots_along
from sample_blends.city.maps import HERE, MAPS, ON_STREET, PAVEMENT
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


def test_walks_end_at_a_pavement_and_no_tree_stands_on_a_lot(maps):
    for name, (scene, _) in maps.items():
        paved = shapely.union_all([p.shape for p in scene.polygons if p.label == "pavement"])
        fronts = shapely.linestrings(np.array([p.points[:2] for p in lots(scene)]))
        assert np.mean(shapely.distance(fronts, paved) < 0.1) > 0.97, name
        reached = [front.buffer(0.6, cap_style="flat").intersection(paved).area for front in fronts]
        assert np.mean(np.array(reached) > 0.3 * shapely.length(fronts)) > 0.97, name
        trees = [p.shape.centroid for p in scene.polygons if p.label.endswith("tree")]
        assert not len(shapely.STRtree(trees).query([p.shape for p in lots(scene)], predicate="contains")[0]), name


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
