"""Footprints of what has no extent, and of what is tilted."""

import math

import bpy
import numpy as np
import pytest
from flats import activate, bridge, everything, face, link, propagate, results, rooms
from mathutils import Vector

EXEC = "EXEC_DEFAULT"


def take(**settings):
    assert bpy.ops.geoanalogy.set_footprint(EXEC, True, **settings) == {"FINISHED"}


def on_the_ground(item):
    """The footprint as it is seen from above, in world coordinates."""
    bpy.context.view_layer.update()
    found = bridge("reading.footprints").footprint_ring_of(
        item, bridge("reading.planes").Plane(), bpy.context.evaluated_depsgraph_get()
    )
    return sorted(map(tuple, np.round(found, 3).tolist()))


def ceiling_light():
    light = link(bpy.data.objects.new("Light", bpy.data.lights.new("Light", "SPOT")), "light")
    light.location = (2.0, 1.5, 2.4)
    return activate(light)


def test_a_light_is_propagated_by_a_square_footprint():
    rooms(3)
    light = ceiling_light()
    with pytest.raises(RuntimeError, match="object 'Light' has no extent on the plan; give it a square footprint"):
        bpy.ops.geoanalogy.propagate(EXEC, True)
    take(kind="square", size=0.4)
    assert on_the_ground(light) == [(1.8, 1.3), (1.8, 1.7), (2.2, 1.3), (2.2, 1.7)]
    propagate()
    assert [tuple(round(v, 2) for v in item.location) for item in results()] == [(7.0, 1.5, 2.4), (12.0, 1.5, 2.4)]
    assert {item.data for item in results()} == {light.data}


@pytest.mark.parametrize("kind", ["hull", "box", "square"])
def test_the_footprint_of_a_tilted_object_is_what_is_seen_from_above(kind):
    item = activate(face("Board", [(-1, -1), (1, -1), (1, 1), (-1, 1)], "board", at=(3, 0, 0.5)))
    item.rotation_euler[0] = math.radians(60)
    take(kind=kind, size=2.0)
    deep = 1.0 if kind == "square" else 0.5
    assert on_the_ground(item) == [(2, -deep), (2, deep), (4, -deep), (4, deep)]


def test_what_stands_on_its_y_axis_gets_no_footprint_of_its_own():
    item = activate(face("Board", [(-1, -1), (1, -1), (1, 1), (-1, 1)], "board"))
    item.rotation_euler[0] = math.radians(90)
    before = everything()
    with pytest.raises(RuntimeError, match="object 'Board' stands upright on its own y axis; turn it"):
        bpy.ops.geoanalogy.set_footprint(EXEC, True, kind="square")
    assert everything() == before


def test_a_square_turns_with_the_object():
    light = ceiling_light()
    light.rotation_euler = (math.radians(30), 0, math.radians(45))
    take(kind="square", size=math.sqrt(2))
    assert on_the_ground(light) == [(1.0, 1.5), (2.0, 0.5), (2.0, 2.5), (3.0, 1.5)]
    assert (light.matrix_world.to_3x3() @ Vector((0, 0, 1))).z == pytest.approx(math.cos(math.radians(30)))
