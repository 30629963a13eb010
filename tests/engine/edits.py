"""Rooms and recorded edits for the tests of the operations tree."""

from shapes import rectangle, ring

from geoanalogy import Polygon, Pose, Scene
from geoanalogy.operations.node import Link, Node
from geoanalogy.operations.pose_placement import PosePlacement
from geoanalogy.poses.propagate import learn_pose

BED = ring((-1, -0.5), (1, -0.5), (1, 0.5), (-1, 0.5))
TABLE = ring((-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2))


def rooms(count=3, label="bedroom", y=0.0):
    """Equal rooms in a row, 4 by 3 metres."""
    return [Polygon(rectangle(4, 3, (5.0 * i, y)), label=label, id=f"{label} {i}") for i in range(count)]


def placement(scene, position, footprint, label, **settings):
    """An operation that propagates an object from a scene."""
    model = learn_pose(scene, Pose(position, 0.0), footprint)
    settings = {"threshold": 0.5, "max_per": {model.parent.label: 1}, **settings}
    return PosePlacement(mesh=f"Library {label}", label=label, model=model, **settings)


def bed(scene=None, **settings):
    """The node that places a bed in the lower left corner."""
    return Node("bed", placement(scene or Scene(rooms()), (1.1, 0.6), BED, "bed", **settings))


def table(layout, source="bed", **settings):
    """The node that places a night table beside the bed."""
    return Node("table", placement(layout.scene, (0.3, 1.4), TABLE, "table", **settings), (Link(source),))
