"""Making plans: outlines as objects, from drawn lines and from files, and labels for them."""

from collections.abc import Iterable, Sequence

import bpy
import numpy as np
from mathutils import Euler, Matrix
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from . import names
from .linked import require_editable
from .reading.footprints import hull_of, outline_of, pose_of
from .reading.ground import read_grounds
from .reading.planes import Plane, best_plane
from .reading.shapes import rings_of
from .reading.whereabouts import up_to_date
from .writing.selection import select_only

Array = NDArray[np.float64]

#: The collection that plans are put into.
PLAN = "Plan"

#: On the plan's collection: what is added to its coordinates to have those of the file it came from.
OFFSET = "ga_offset"

#: Side of a square footprint, scene units: about what a lamp takes up.
SQUARE = 0.5

#: Area of an object's own unit square seen from above, as a share of its area, below which it is seen from the edge.
UPRIGHT = 1e-4


def ensure_plan(scene: bpy.types.Scene, name: str = PLAN) -> bpy.types.Collection:
    """The plan collection of a scene, made where there is none.

    Parameters
    ----------
    scene : bpy.types.Scene
    name : str
        Of one that is made.

    Returns
    -------
    bpy.types.Collection
    """
    if scene.geoanalogy.plan is None:
        scene.geoanalogy.plan = bpy.data.collections.new(name)
        scene.collection.children.link(scene.geoanalogy.plan)
    return scene.geoanalogy.plan


def set_label(items: Iterable[bpy.types.ID], label: str) -> int:
    """Label objects or collections.

    Parameters
    ----------
    items : iterable of bpy.types.Object or bpy.types.Collection
    label : str
        Empty: takes the label away.

    Returns
    -------
    int
        How many.

    Raises
    ------
    InputError
        Where there are none, one is linked, or one is a result: that has the label of its operation.
    """
    items = list(items)
    if not items:
        raise InputError("nothing is selected; select the objects to label")
    require_editable(items)
    _refuse_results(items)
    for item in items:
        if label.strip():
            item[names.LABEL] = label.strip()
        else:
            item.pop(names.LABEL, None)
    return len(items)


def _refuse_results(items: Iterable[bpy.types.ID]) -> None:
    """Refuse to write on what is made anew from its example."""
    for item in items:
        if names.KEY in item:
            raise InputError(
                f"object {item.name!r} is a result of {item[names.NODE]!r}; change its example, or make results "
                "real in step 5"
            )


def polygons_from_lines(
    context: bpy.types.Context, items: Sequence[bpy.types.Object], label: str
) -> list[bpy.types.Object]:
    """Make a mesh with one face of every closed line of objects; their labels go over to the meshes.

    Parameters
    ----------
    context : bpy.types.Context
    items : sequence of bpy.types.Object
        Curves, grease pencils, or meshes.
    label : str
        Of the polygons; empty: that of the object they are made from.

    Returns
    -------
    list of bpy.types.Object
        In the plan's collection; selected, and nothing else.

    Raises
    ------
    InputError
        For lines that are open, cross themselves or are not flat, naming the object; then none is made.
    """
    if not items:
        raise InputError("nothing is selected; select the curves or strokes to make polygons of")
    depsgraph = up_to_date(context)
    made = []
    for item in items:
        name = f"object {item.name!r}"
        rings = [ring.points for ring in rings_of(item, depsgraph)]
        if not rings:
            raise InputError(f"{name} has no closed line; draw its outline first")
        plane = best_plane(rings, name)
        if plane is None:
            raise InputError(f"{name} is not flat; draw it on a plane")
        own = label.strip() or str(item.get(names.LABEL, ""))
        for i, ring in enumerate(rings):
            id = item.name if len(rings) == 1 else f"{item.name}/{i}"
            made.append((Polygon(plane.to_plane(ring)[:, :2], label=own, id=id), plane))
    plan = ensure_plan(context.scene)
    polygons = [_add_polygon(plan, polygon, plane) for polygon, plane in made]
    # A labelled line is a polygon itself: with its label left on, each would be there twice.
    for item in items:
        if item.library is None:
            item.pop(names.LABEL, None)
    select_only(polygons)
    return polygons


def add_plan(context: bpy.types.Context, scene: Scene, name: str) -> list[bpy.types.Object]:
    """Add the polygons of a file to the plan.

    Parameters
    ----------
    context : bpy.types.Context
    scene : Scene
    name : str
        Of the plan's collection, where it is made.

    Returns
    -------
    list of bpy.types.Object
        On the level plane through the origin; selected, and nothing else.

    Raises
    ------
    InputError
        Where the file has no polygons.
    """
    if not len(scene):
        raise InputError(f"{name} has no polygons; choose a file with closed outlines")
    plan = ensure_plan(context.scene, name)
    away = np.zeros(2)
    if any(scene.offset):
        # Beside what came from the same region before, a file keeps its place.
        away = np.subtract(scene.offset, plan.get(OFFSET, scene.offset))
        plan[OFFSET] = list(plan.get(OFFSET, scene.offset))
    level = Plane()
    made = {polygon.id: _add_polygon(plan, polygon, level) for polygon in scene.polygons}
    for item in made.values():
        item.location.x, item.location.y = np.add(item.location[:2], away)
    for polygon in scene.polygons:
        # Blender may have given another name than the id.
        if polygon.parent in made:
            made[polygon.id][names.PARENT] = made[polygon.parent].name
    select_only(list(made.values()))
    return list(made.values())


def _add_polygon(holder: bpy.types.Collection, polygon: Polygon, plane: Plane) -> bpy.types.Object:
    """A polygon as a mesh of one face, or as a filled curve where it has holes."""
    rings = [plane.to_world(np.column_stack([ring, np.zeros(len(ring))])) for ring in polygon.rings]
    middle = rings[0].mean(axis=0)
    # Near its own origin a shape keeps its precision.
    rings = [ring - middle for ring in rings]
    data = _mesh(polygon.id, rings[0]) if len(rings) == 1 else _filled_curve(polygon.id, rings, plane)
    drawn = bpy.data.objects.new(str(polygon.id), data)
    if len(rings) > 1:
        drawn.rotation_euler = _rotation(plane)
    drawn.location = middle
    drawn[names.LABEL] = polygon.label
    drawn.display_type = "WIRE"
    drawn.hide_render = True
    if polygon.orientation is not None:
        x, y = plane.to_plane([np.array(drawn.rotation_euler.to_matrix())[:, 0] + plane.origin])[0, :2]
        drawn[names.ORIENTATION] = polygon.orientation - float(np.arctan2(y, x))
    if any(polygon.segment_labels):
        drawn[names.SEGMENT_LABELS] = ",".join(label.replace(",", " ") for label in polygon.segment_labels)
    holder.objects.link(drawn)
    return drawn


def _mesh(name: str | None, ring: Array) -> bpy.types.Mesh:
    mesh = bpy.data.meshes.new(str(name))
    mesh.from_pydata(ring.tolist(), [], [list(range(len(ring)))])
    return mesh


def _rotation(plane: Plane) -> Euler:
    return Matrix(plane.matrix[:3, :3].tolist()).to_euler()


def _filled_curve(name: str | None, rings: Sequence[Array], plane: Plane) -> bpy.types.Curve:
    curve = bpy.data.curves.new(str(name), "CURVE")
    curve.dimensions = "2D"
    for ring in rings:
        spline = curve.splines.new("POLY")
        spline.points.add(len(ring) - 1)
        flat = ring @ plane.matrix[:3, :3]
        points = np.column_stack([flat[:, :2], np.zeros(len(ring)), np.ones(len(ring))])
        spline.points.foreach_set("co", points.ravel().astype(np.float32))
        spline.use_cyclic_u = True
    return curve


def take_footprints(
    context: bpy.types.Context, items: Sequence[bpy.types.Object], kind: str, size: float = SQUARE
) -> None:
    """Give objects footprints of their own.

    Parameters
    ----------
    context : bpy.types.Context
    items : sequence of bpy.types.Object
    kind : {"hull", "outline", "box", "square", "none"}
        The convex hull of what each object is now; the exact outline of its faces; the box along its axes; a square
        about its origin, for a light or an empty; or none of its own any more.
    size : float
        Side of the square, scene units.

    Raises
    ------
    InputError
        Where one has no extent on the plan, no faces to take the outline of, stands upright, is linked, or is a
        result; then none is changed.
    """
    require_editable(items)
    _refuse_results(items)
    depsgraph = up_to_date(context)
    own = [None if kind == "none" else _own_footprint(context, item, kind, size, depsgraph) for item in items]
    for item, footprint in zip(items, own, strict=True):
        if footprint is None:
            item.pop(names.FOOTPRINT, None)
        else:
            item[names.FOOTPRINT] = footprint


def _own_footprint(
    context: bpy.types.Context, item: bpy.types.Object, kind: str, size: float, depsgraph: bpy.types.Depsgraph
) -> list[float]:
    """A footprint in an object's own coordinates, as the custom property takes it."""
    plane = _plane_below(context, item, depsgraph)
    pose = pose_of(item, plane)
    if kind == "square":
        ring = pose.to_scene(size / 2 * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]))
    else:
        ring = outline_of(item, plane, depsgraph) if kind == "outline" else hull_of(item, plane, depsgraph)
    if kind == "box":
        own = pose.to_frame(ring)
        (x0, y0), (x1, y1) = own.min(axis=0), own.max(axis=0)
        ring = pose.to_scene([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
    # The object may be tilted: its own x and y are those that are seen at the ring from above.
    frame = np.array(item.matrix_world)
    origin, *ends = plane.to_plane(frame[:3, 3] + np.vstack([np.zeros(3), frame[:3, :2].T]))[:, :2]
    axes = np.column_stack(ends) - origin[:, None]
    if abs(np.linalg.det(axes)) <= UPRIGHT * np.linalg.norm(frame[:3, 0]) * np.linalg.norm(frame[:3, 1]):
        raise InputError(f"object {item.name!r} stands upright on its own y axis; turn it to give it a footprint")
    return [float(v) for v in np.linalg.solve(axes, (ring - origin).T).T.ravel()]


def _plane_below(context: bpy.types.Context, item: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Plane:
    """The plane of the plan that an object stands on; the level one, where there is no plan yet."""
    try:
        grounds = read_grounds(context.scene, depsgraph, {item.name})
    except InputError:
        return Plane()
    return min((g.plane for g in grounds), key=lambda p: abs(p.to_plane([item.matrix_world.translation])[0, 2]))
