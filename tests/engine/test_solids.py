"""Solids: extrusion, roofs, booleans, openings, the surfaces of all of them."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import rectangle, regular, ring
from strategies import simple_rings

from geoanalogy import InputError, Polygon
from geoanalogy.geometry.boolean import combined
from geoanalogy.geometry.cutting import with_openings
from geoanalogy.geometry.extrusion import FaceLabels, extrude
from geoanalogy.geometry.frame import SPACE, Frame
from geoanalogy.geometry.mesh import joined
from geoanalogy.geometry.roof import Roof

L_SHAPE = ring((0, 0), (10, 0), (10, 6), (5, 6), (5, 12), (0, 12))
COURT = Polygon(rectangle(20, 20), holes=[rectangle(4, 4, (8, 8))])
ROOFS = [
    None,
    Roof("hip"),
    Roof("gable"),
    Roof("mansard"),
    Roof("hip", rise=0.8),
    Roof("hip", overhang=0.5),
    Roof("gable", overhang=0.5),
    Roof("mansard", overhang=0.3),
]


def box(width=10.0, depth=6.0, height=3.0, **more):
    return extrude(Polygon(rectangle(width, depth), **more), height)


def surfaces(solid, label=None, frame=SPACE):
    faces = None if label is None else solid.by_label.get(label, ())
    return solid.surfaces("e", frame, faces)


def street(solid):
    return next(s for s in surfaces(solid) if np.allclose(s.frame.normal, (0, -1, 0)))


# ------------------------------------------------------------------------------------------------ rooms


@pytest.mark.parametrize("polygon", [Polygon(rectangle(4, 3)), Polygon(L_SHAPE), COURT])
def test_a_room_is_a_floor_and_walls_that_look_inwards(polygon):
    labels = FaceLabels(side="wall", top="rim", bottom="floor", outside="plaster")
    room = extrude(polygon, 2.5, labels, walls=0.2)
    outer = shapely.Polygon(polygon.points, polygon.holes).buffer(0.2, join_style="mitre").area
    assert room.is_closed and room.volume == pytest.approx(outer * 2.7 - polygon.area * 2.5)
    (floor,) = surfaces(room, "floor")
    assert floor.frame.normal.tolist() == [0, 0, 1] and floor.polygon.area == pytest.approx(polygon.area)
    walls = surfaces(room, "wall")
    assert len(walls) == sum(len(ring) for ring in polygon.rings)
    for wall in walls:
        middle = wall.frame.to_space([wall.polygon.centroid])[0]
        assert wall.frame.axes[1].tolist() == [0, 0, 1]
        assert polygon.shape.contains(shapely.Point((middle + 0.1 * wall.frame.normal)[:2]))
        assert not polygon.shape.contains(shapely.Point((middle - 0.1 * wall.frame.normal)[:2]))


def test_the_walls_of_a_room_have_the_labels_of_its_edges():
    room = extrude(Polygon(rectangle(4, 3), segment_labels=("door", "", "back", "")), 2.5, walls=0.1)
    assert {label: len(f) for label, f in room.by_label.items()} == {
        "outside": 5,
        "base": 1,
        "top": 1,
        "door facade": 1,
        "facade": 2,
        "back facade": 1,
    }


def test_a_room_refuses_walls_and_roofs_that_cannot_be():
    with pytest.raises(InputError, match=r"walls are -0\.1 thick"):
        extrude(Polygon(rectangle(4, 3)), 2.5, walls=-0.1)
    with pytest.raises(InputError, match="open above; leave out its roof"):
        extrude(Polygon(rectangle(4, 3)), 2.5, roof=Roof("hip"), walls=0.1)


# ------------------------------------------------------------------------------------------------ frames


def test_a_frame_takes_points_to_space_and_back():
    frame = Frame.of((1, 2, 3), (0, 1, 0), (0, 0, 1))
    assert frame.normal.tolist() == [1, 0, 0]
    assert frame.to_space([(5, 7)]).tolist() == [[1, 7, 10]]
    points = np.random.default_rng(0).normal(size=(5, 3))
    assert frame.to_plane(frame.to_space(points)) == pytest.approx(points)
    inner = Frame.of((1, 1, 0), (0, 1, 0), (-1, 0, 0))
    assert inner.inside(frame).to_space(points) == pytest.approx(frame.to_space(inner.to_space(points)))
    assert inner.inside(frame).seen_from(frame).to_space(points) == pytest.approx(inner.to_space(points))
    turned = frame.moved(2, 1, np.pi / 2)
    assert turned.to_space([(1, 0)])[0] == pytest.approx(frame.to_space([(2, 2)])[0])
    assert frame.matrix @ (5, 7, 0, 1) == pytest.approx([1, 7, 10, 1])
    assert frame.flipped.normal.tolist() == [-1, 0, 0]
    upright = Frame.of((0, 0, 0), (0, 0, 1), (0, -1, 0)).upright((0, 0, 1))
    assert upright.y == (0, 0, 1) and upright.normal.tolist() == [1, 0, 0]


# ------------------------------------------------------------------------------------------------ extrusion


@pytest.mark.parametrize("roof", ROOFS)
@pytest.mark.parametrize("polygon", [Polygon(rectangle(10, 6)), Polygon(L_SHAPE), COURT, Polygon(regular(8, 5.0))])
@pytest.mark.parametrize("height", [3.0, -3.0])
def test_every_extrusion_is_closed(polygon, roof, height):
    solid = extrude(polygon, height, roof=roof)
    assert solid.is_closed
    assert solid.volume >= polygon.area * 3 - 1e-3
    for s in surfaces(solid):
        corners = s.frame.to_space(s.polygon.points)
        away = (corners - solid.vertices.mean(axis=0)) @ s.frame.normal
        assert np.ptp(away) == pytest.approx(0, abs=1e-4)


@pytest.mark.parametrize(("kind", "volume"), [("gable", 180 + 90), ("hip", 180 + 90 - 2 * 9)])
def test_volumes_of_roofs(kind, volume):
    # 10 by 6, 3 high, at 45 degrees: a prism of 90; each hip cuts a pyramid of 9 off it.
    assert extrude(Polygon(rectangle(10, 6)), 3.0, roof=Roof(kind, np.pi / 4)).volume == pytest.approx(volume)


def test_sides_are_surfaces_with_the_labels_of_their_edges():
    solid = box(segment_labels=["street", "", "garden", ""])
    labels = {s.label: s for s in surfaces(solid)}
    assert set(labels) == {"street facade", "facade", "garden facade", "top", "base"}
    front = labels["street facade"]
    assert front.polygon.points.tolist() == rectangle(10, 3).tolist()
    assert front.frame.normal.tolist() == [0, -1, 0] and front.frame.y == (0, 0, 1)
    assert front.id == "e:side 0" and front.parent == "e" and front.polygon.id == front.id
    assert labels["top"].frame.origin == (0, 0, 3) and labels["base"].frame.normal.tolist() == [0, 0, -1]


def test_straight_runs_are_one_surface_and_labels_divide_them():
    outline = ring((0, 0), (4, 0), (10, 0), (10, 6), (0, 6))
    assert len(surfaces(extrude(Polygon(outline), 3.0), "facade")) == 4
    divided = extrude(Polygon(outline, segment_labels=["gate", "", "", "", ""]), 3.0)
    assert len(surfaces(divided, "facade")) == 4 and len(surfaces(divided, "gate facade")) == 1


def test_sides_on_an_upright_plane_stand_upright():
    bay = extrude(Polygon(rectangle(2, 3)), 1.0, up=(0.0, 1.0, 0.0))
    right = next(s for s in surfaces(bay) if np.allclose(s.frame.normal, (1, 0, 0)))
    assert right.frame.y == pytest.approx((0, 1, 0)) and right.frame.x == pytest.approx((0, 0, -1))
    assert right.polygon.points.tolist() == rectangle(1, 3).tolist()


def test_names_of_faces():
    labels = FaceLabels("wall", "lid", "floor", "tiles", "end")
    solid = extrude(Polygon(rectangle(10, 6)), 3.0, labels, Roof("gable"))
    assert set(solid.by_label) == {"wall", "floor", "tiles", "end"}
    assert set(extrude(Polygon(rectangle(10, 6)), 3.0, labels).by_label) == {"wall", "floor", "lid"}
    assert solid.renamed("bay").faces[1].name == "bay:side 0"


def test_equal_surfaces_have_identical_outlines():
    one = surfaces(extrude(Polygon(rectangle(10, 6)), 3.0), "facade")
    other = surfaces(extrude(Polygon(rectangle(6, 10, (1 / 3, 7.7))), 3.0), "facade")
    assert one[0].polygon.points.tobytes() == other[1].polygon.points.tobytes()


def test_the_mesh_has_materials_and_texture_coordinates():
    mesh = box().mesh
    assert set(mesh.materials) == {"facade", "top", "base"} and mesh.material == "facade"
    edges = np.linalg.norm(mesh.vertices[mesh.faces] - np.roll(mesh.vertices[mesh.faces], 1, axis=1), axis=2)
    drawn = np.linalg.norm(mesh.uv - np.roll(mesh.uv, 1, axis=1), axis=2)
    assert drawn == pytest.approx(edges)
    two = joined([mesh, mesh.placed(Frame(origin=(20.0, 0.0, 0.0)))])
    assert len(two.faces) == 24 and two.vertices[:, 0].max() == 30 and two.materials == mesh.materials
    assert joined([]).material == ""


@pytest.mark.parametrize("height", [0.0, np.nan, np.inf])
def test_a_height_that_cannot_be_is_refused(height):
    with pytest.raises(InputError, match=r"the height is (0|nan|inf); give a positive one"):
        extrude(Polygon(rectangle(1, 1)), height)


@given(simple_rings(10))
@settings(max_examples=25, deadline=None)
def test_any_outline_extrudes_to_a_closed_solid(outline):
    flat = extrude(Polygon(outline), 1.5)
    assert flat.is_closed and flat.volume == pytest.approx(1.5 * Polygon(outline).area)
    assert extrude(Polygon(outline), 1.5, roof=Roof("hip")).is_closed


# ------------------------------------------------------------------------------------------------ booleans


def test_what_touches_is_merged_exactly():
    house = box()
    front = street(house)
    bay = extrude(Polygon(rectangle(2, 2, (2, 0))), 1.0).renamed("bay")
    merged = combined(house, [(bay, front.frame)], "merge", front.frame)
    assert merged.is_closed and merged.volume == pytest.approx(184)
    # Its lower side is in the plane of the house's floor, its front a surface of its own; nothing is left in between.
    assert "bay:bottom" not in {s.id.removeprefix("e:") for s in surfaces(merged)}
    assert next(s for s in surfaces(merged) if s.id == "e:side 0").polygon.area == pytest.approx(26)


def test_coplanar_faces_of_one_label_become_one_surface():
    one, other = box(), extrude(Polygon(rectangle(4, 3, (10, 0))), 3.0).renamed("wing")
    merged = combined(one, [(other, SPACE)], "merge")
    assert merged.volume == pytest.approx(180 + 36) and merged.is_closed
    front = [s for s in surfaces(merged, "facade") if np.allclose(s.frame.normal, (0, -1, 0))]
    assert [s.polygon.area for s in front] == pytest.approx([42])
    assert len(surfaces(merged, "top")) == 1


def test_subtracted_corners_show_the_faces_of_what_was_subtracted():
    cut = extrude(Polygon(rectangle(4, 4, (6, 2))), 3.0, FaceLabels(side="court")).renamed("cut")
    left = combined(box(), [(cut, SPACE)], "subtract")
    assert left.volume == pytest.approx(180 - 48) and left.is_closed
    court = surfaces(left, "court")
    assert sorted(s.polygon.area for s in court) == pytest.approx([12, 12])
    assert all(np.allclose(s.frame.y, (0, 0, 1)) for s in court)


def test_nothing_left_says_so():
    with pytest.raises(InputError, match="nothing is left of the solid; subtract less"):
        combined(box(), [(box().renamed("all"), SPACE)], "subtract")


def test_turned_planes_touch_exactly():
    turn = Frame(x=(np.cos(0.3), np.sin(0.3), 0.0), y=(-np.sin(0.3), np.cos(0.3), 0.0))
    house = extrude(Polygon(turn.to_space(rectangle(10, 6))[:, :2]), 3.0)
    for s in surfaces(house, "facade"):
        knob = extrude(Polygon(rectangle(1, 1, (1, 1))), 0.5).renamed(s.id)
        house = combined(house, [(knob, s.frame)], "merge", s.frame)
        assert house.is_closed
    assert house.volume == pytest.approx(180 + 4 * 0.5, rel=1e-5)


@pytest.mark.parametrize("seed", range(6))
def test_random_masses_are_closed(seed):
    """Fifty extrusions on random surfaces of a mass, merged or subtracted, often flush with edges of each other."""
    rng = np.random.default_rng(seed)
    mass = box(20, 20, 12)
    done = 0
    while done < 50:
        face = int(rng.choice(np.unique(mass.face)))
        parts = mass.surfaces_of(face)
        if not parts:
            continue
        _, frame, polygon = parts[0]
        x0, y0, x1, y1 = polygon.bounds
        low = rng.integers(0, 7, 2) / 8
        high = np.minimum(low + rng.integers(1, 5, 2) / 8, 1)
        (x0, y0), (x1, y1) = (np.array([x0, y0]) + share * (x1 - x0, y1 - y0) for share in (low, high))
        if min(x1 - x0, y1 - y0) < 1e-2:
            continue
        height = float(rng.integers(1, 6)) / 2
        outline = (
            rectangle(x1 - x0, y1 - y0, (x0, y0))
            if rng.random() < 0.7
            else regular(8, min(x1 - x0, y1 - y0) / 2, ((x0 + x1) / 2, (y0 + y1) / 2), rng.random())
        )
        kind = "merge" if rng.random() < 0.6 else "subtract"
        part = extrude(Polygon(outline), height if kind == "merge" else -height).renamed(f"part {done}")
        before = mass.volume
        mass = combined(mass, [(part, frame)], kind, frame)
        assert mass.is_closed, done
        assert (mass.volume >= before - 1e-3) if kind == "merge" else (mass.volume <= before + 1e-3)
        done += 1


# ------------------------------------------------------------------------------------------------ openings


def window(frame, x, y, width=1.0, height=1.2, depth=0.2):
    return extrude(Polygon(rectangle(width, height)), -depth, FaceLabels("reveal", "glass")), frame.moved(x, y)


def test_openings_inside_a_face_are_cut_in_two_dimensions():
    house = box()
    front = street(house)
    openings = [window(front.frame, x, 1.0) for x in (1.0, 3.0, 5.0)]
    cut, others = with_openings(house, house.by_name["side 0"], openings)
    assert others == [] and cut.is_closed
    assert cut.volume == pytest.approx(180 - 3 * 1.0 * 1.2 * 0.2, abs=1e-12)
    assert len(surfaces(cut, "glass")) == 3
    glass = surfaces(cut, "glass")[0]
    assert glass.frame.normal == pytest.approx((0, -1, 0)) and glass.frame.y == pytest.approx((0, 0, 1))
    assert glass.frame.origin[1] == pytest.approx(0.2)
    assert set(map(tuple, house.vertices)) <= set(map(tuple, cut.vertices))


def test_openings_that_touch_or_pierce_are_left_to_solids():
    house = box()
    front = street(house)
    door = window(front.frame, 2.0, 0.0, 1.0, 2.0)
    overlapping = window(front.frame, 5.0, 1.0), window(front.frame, 5.5, 1.0)
    through = window(front.frame, 8.0, 1.0, depth=7.0)
    cut, others = with_openings(house, house.by_name["side 0"], [door, *overlapping, through])
    assert others == [door, overlapping[1], through] and cut.is_closed
    named = [(solid.renamed(str(i)), where) for i, (solid, where) in enumerate(others)]
    whole = combined(cut, named, "subtract", front.frame)
    assert whole.is_closed and whole.volume == pytest.approx(180 - 0.4 - 1.8 * 0.2 * 1.0 - 7.2 * 1.0, abs=0.1)


def test_a_surface_keeps_its_outline_when_openings_are_cut():
    house = box()
    front = street(house)
    kept = house.with_domain(house.by_name["side 0"])
    door, where = window(front.frame, 2.0, 0.0, 1.0, 2.0)
    for solid, expected in ((house, 30 - 2), (kept, 30)):
        cut = combined(solid, [(door.renamed("door"), where)], "subtract", front.frame)
        outline = next(s.polygon for s in surfaces(cut) if s.id == "e:side 0")
        assert outline.area == pytest.approx(expected)
    assert kept.volume == house.volume


def test_all_parts_of_a_divided_surface_keep_their_outlines():
    house = box()
    front = street(house)
    groove, where = window(front.frame, 4.0, -1.0, 1.0, 5.0)
    divided = combined(house, [(groove.renamed("groove"), where)], "subtract", front.frame)
    face = divided.by_name["side 0"]
    openings = [(pane.renamed("window"), at) for pane, at in (window(front.frame, x, 1.0) for x in (1.0, 7.0))]
    for solid, missing in ((divided, 1.2), (divided.with_domain(face), 0.0)):
        cut, others = with_openings(solid, face, openings)
        areas = {s.id: s.polygon.area for s in surfaces(cut) if s.id.startswith("e:side 0")}
        assert areas == pytest.approx({"e:side 0": 15 - missing, "e:side 0#2": 12 - missing}) and others == []


@given(st.lists(st.tuples(*(st.integers(0, 18), st.integers(0, 5))), min_size=1, max_size=8, unique=True))
@settings(max_examples=25, deadline=None)
def test_openings_and_booleans_agree(places):
    house = box()
    front = street(house)
    openings = [window(front.frame, 0.5 * x, 0.4 * y, 0.5, 0.4) for x, y in places]
    cut, others = with_openings(house, house.by_name["side 0"], openings)
    rest = [(solid.renamed(str(i)), where) for i, (solid, where) in enumerate(others)]
    done = combined(cut, rest, "subtract", front.frame) if rest else cut
    area = shapely.union_all([shapely.box(0.5 * x, 0.4 * y, 0.5 * x + 0.5, 0.4 * y + 0.4) for x, y in places]).area
    assert done.is_closed and done.volume == pytest.approx(180 - 0.2 * area, abs=1e-4)
