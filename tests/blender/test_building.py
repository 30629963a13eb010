"""Extrusion, boolean and selection in Blender, and examples drawn on what they make."""

import pytest
from flats import operations_tree
from houses import HEIGHT, SIZES, box_of, corners_of, houses, solids, volume_of, windows

EXEC = "EXEC_DEFAULT"


def test_houses_are_extruded_on_all_parcels():
    corners, node = houses()
    assert node["count"] == 4
    made = solids("house")
    assert len(made) == 4
    for item in made:
        i = next(k for k, (x, _) in enumerate(corners) if x < item.matrix_world.translation.x < x + SIZES[k][0])
        (x0, y0, _), (x1, y1, _) = box_of(i, corners)
        points = corners_of(item)
        if i < 2:
            assert points.min(axis=0) == pytest.approx((x0, y0, 0.0), abs=1e-4)
            assert points.max(axis=0) == pytest.approx((x1, y1, HEIGHT), abs=1e-4)
        assert volume_of(item) > 0


def test_windows_drawn_on_a_wall_are_cut_into_every_wall_like_it():
    corners, _ = houses()
    before = {item.name: volume_of(item) for item in solids("house")}
    node = windows(corners)
    # Four walls of equal label: one window each.
    assert node["count"] == 16
    assert [k.from_node.name for k in operations_tree().nodes["subtract window"].inputs[0].links] == ["extrude window"]
    made = solids("house")
    assert solids("window") == []
    assert {item.name: before[item.name] - volume_of(item) for item in made} == pytest.approx(
        dict.fromkeys(before, 4 * 1.2 * 1.2 * 0.2), abs=1e-3
    )
    assert all({"glass", "reveal"} <= {slot.material.name for slot in item.material_slots} for item in made)
