"""The transformation space of an operation as objects beside its drawing (figure 3.8, appendix B).

Five plots in a row: translation and rotation in three dimensions, and each of the four parameters over the query.
A correspondence is a small octahedron in each of them, grey by its confidence, or in the colour of the match whose
function it lies on. One object per match holds its correspondences in all plots, so that it can be hidden or selected;
the object of the correspondences has one vertex for each, with all that is known of it as attributes.
"""

import colorsys
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ...errors import InputError
from ...operations.region_transfer import Found
from ...progress import Stepper
from ...regions.matching import Matches
from ...regions.view import TransformationSpace, transformation_space
from .. import names
from ..holders import ensure_holder_with, holder_with
from ..tree.store import engine_node
from .drawings import DrawnLines, line_curve, read_drawn_lines
from .finding import find_steps, found_already
from .recording import require_transfer, stored_targets
from .results import passing

Array = NDArray[np.float64]

#: Name of the collection that holds the views of a scene.
COLLECTION = "Transformation space"

#: Edge of a plot in sizes of the drawing; in edges the gap beside it, and radii of what is of no match, and of one.
EDGE, GAP, CLUTTER, INLIER = 0.35, 0.35, 0.006, 0.012

#: Shades of correspondences that are of no match, from the least confident.
GREYS = (0.75, 0.55, 0.35, 0.15)

#: Golden section of the circle of hues: neighbouring numbers get colours far apart.
HUE_STEP = 0.618034

#: Corners and faces of an octahedron.
CORNERS = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], float)
FACES = np.array([(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)])

#: The three axes from the corner of a plot, and the rim of its floor.
FRAME = [np.array(line, float) for line in (
    [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 0)], [(0, 0, 0), (0, 0, 1)], [(0, 1, 0), (0, 1, 1), (1, 1, 1)]
)]  # fmt: skip

#: Where the names of the axes stand in a plot, and how they are turned; their size in edges.
LABELS = (
    ((0.0, -0.1, 0.0), Matrix.Identity(4)),
    ((-0.03, 0.0, 0.0), Matrix.Rotation(np.pi / 2, 4, "Z")),
    ((0.0, 0.0, 1.04), Matrix.Rotation(np.pi / 2, 4, "X")),
)
LETTERS = 0.07


@dataclass(frozen=True)
class Plot:
    """All correspondences in one plot.

    Attributes
    ----------
    axes : tuple of str
        What stands at x, y and z.
    points : ndarray of shape (n, 3)
        In edges, from 0 to 1.
    """

    axes: tuple[str, ...]
    points: Array


def space_steps(context: bpy.types.Context, node: bpy.types.Node) -> Stepper[TransformationSpace]:
    """Show the transformation space of an operation, in place of what is shown of it already.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node
        Of a region transfer.

    Returns
    -------
    generator of (float, str)
        Returns what is shown.

    Raises
    ------
    InputError
        Where the node is no region transfer, or there are no correspondences.
    """
    require_transfer(node)
    drawn = read_drawn_lines(context)
    found = yield from find_steps(engine_node(node).operation, drawn)
    if found.matches.refined is None or not len(found.matches.refined):
        raise InputError(
            f"the operation {node.name!r} has no transformation space: its query holds short marks,"
            " which are compared as a whole; outline a shape with longer lines"
        )
    return _show(context.scene, node, found, drawn)


def refresh_space(context: bpy.types.Context, node: bpy.types.Node) -> None:
    """Colour what is shown of an operation anew after another threshold; nothing is computed.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node
        Of a region transfer.
    """
    if space_collection(context.scene, node.name) is not None:
        drawn = read_drawn_lines(context)
        found = found_already(engine_node(node).operation, drawn)
        if found is not None:
            _show(context.scene, node, found, drawn)


def space_collection(scene: bpy.types.Scene, node: str) -> bpy.types.Collection | None:
    """The collection with the view of one operation.

    Parameters
    ----------
    scene : bpy.types.Scene
    node : str
        Name of the node.

    Returns
    -------
    bpy.types.Collection or None
    """
    outer = holder_with(scene.collection, names.SPACE, COLLECTION)
    return None if outer is None else holder_with(outer, names.SPACE, node)


def _show(scene: bpy.types.Scene, node: bpy.types.Node, found: Found, drawn: DrawnLines) -> TransformationSpace:
    operation, every = engine_node(node).operation, found.matches
    targets = stored_targets(operation, found)
    shown = {target.key for target in passing(operation, targets)}
    chosen = [m for m, target in zip(every.every, targets, strict=True) if target.key in shown]
    space = transformation_space(found.drawing, Matches(chosen, 0.0, every.refined, every.nodes, every.size))
    holder = _emptied(scene, node.name)
    edge, corners = EDGE * drawn.size, np.vstack(drawn.lines)
    base = Matrix(drawn.plane.matrix.tolist())
    beside = base @ Matrix.Translation((corners[:, 0].max() + GAP * edge, corners[:, 1].min(), 0.0))

    def add(name: str, data: bpy.types.ID, frame: Matrix = beside) -> None:
        item = bpy.data.objects.new(name, data)
        item.matrix_basis = frame
        # It is no line of the drawing.
        item[names.CONTENT] = "space"
        item.hide_render = True
        holder.objects.link(item)

    plots = _plots(space)
    origins = [np.array(((1.0 + GAP) * i, 0.0, 0.0)) for i in range(len(plots))]
    add(f"{node.name} correspondences", _correspondences(space), base)
    for k in range(-1, len(chosen)):
        own = space.match == k
        if own.any():
            at = np.vstack([origin + plot.points[own] for origin, plot in zip(origins, plots, strict=True)])
            name = f"{node.name} of no match" if k < 0 else f"{node.name} match {k + 1}"
            radius = edge * (CLUTTER if k < 0 else INLIER)
            add(name, _octahedra(name, edge * at, radius, np.tile(space.magnitude[own], len(plots)), k))
    add(f"{node.name} axes", line_curve("axes", [edge * (origin + line) for origin in origins for line in FRAME]))
    for origin, plot in zip(origins, plots, strict=True):
        for (at, turn), text in zip(LABELS, plot.axes, strict=True):
            letters = bpy.data.curves.new("axis", "FONT")
            letters.body, letters.size = text, LETTERS * edge
            add(f"{node.name} axis", letters, beside @ Matrix.Translation(edge * (origin + at)) @ turn)
    holder[names.COUNT] = len(space.match)
    holder[names.INLIERS] = [space.inliers, space.weighted_inliers]
    return space


def _plots(space: TransformationSpace) -> list[Plot]:
    """The rightmost plot of appendix B, and the four in its middle."""
    (x, y), (right, up) = space.query_point.T, space.translation.T
    query = [("query x", _unit(x)), ("query y", _unit(y))]
    moved = [(f"translation {k}: {v.min():.3g} to {v.max():.3g}", _unit(v)) for k, v in (("x", right), ("y", up))]
    grown = (f"scale: {space.scale.min():.3g} to {space.scale.max():.3g}", _unit(np.log(space.scale)))
    turned = ("rotation: -180° to 180°", space.rotation / (2.0 * np.pi) + 0.5)
    rows = [[*moved, turned], *([*query, one] for one in (*moved, grown, turned))]
    return [Plot(tuple(name for name, _ in row), np.stack([v for _, v in row], 1)) for row in rows]


def _unit(values: Array) -> Array:
    """Values from 0 to 1."""
    return (values - values.min()) / max(float(np.ptp(values)), 1e-30)


def _correspondences(space: TransformationSpace) -> bpy.types.Mesh:
    """A vertex at the query point of every correspondence, with attributes."""
    mesh = bpy.data.meshes.new("correspondences")
    mesh.vertices.add(len(space.match))
    mesh.vertices.foreach_set("co", _flat(space.query_point).ravel())
    for name, kind, key, values in (
        ("target", "FLOAT_VECTOR", "vector", _flat(space.target).ravel()),
        ("translation", "FLOAT_VECTOR", "vector", _flat(space.translation).ravel()),
        ("scale", "FLOAT", "value", space.scale.astype(np.float32)),
        ("rotation", "FLOAT", "value", space.rotation.astype(np.float32)),
        ("mirrored", "BOOLEAN", "value", space.mirrored),
        ("confidence", "FLOAT", "value", space.magnitude.astype(np.float32)),
        ("match", "INT", "value", (space.match + 1).astype(np.int32)),
    ):
        mesh.attributes.new(name, kind, "POINT").data.foreach_set(key, values)
    mesh.update()
    return mesh


def _flat(points: Array) -> NDArray[np.float32]:
    return np.column_stack([points, np.zeros(len(points))]).astype(np.float32)


def _octahedra(name: str, at: Array, radius: float, confidence: Array, match: int) -> bpy.types.Mesh:
    """One mesh of all points of a match in all plots; of no match (-1) in shades of grey."""
    mesh = bpy.data.meshes.new(name)
    points = (at[:, None] + radius * CORNERS).reshape(-1, 3)
    faces = (FACES + len(CORNERS) * np.arange(len(at))[:, None, None]).reshape(-1, 3)
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.astype(np.float32).ravel())
    mesh.loops.add(faces.size)
    mesh.loops.foreach_set("vertex_index", faces.astype(np.int32).ravel())
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, faces.size, 3, dtype=np.int32))
    if match >= 0:
        mesh.materials.append(_material(colorsys.hsv_to_rgb(HUE_STEP * match % 1.0, 0.85, 0.9)))
    else:
        for grey in GREYS:
            mesh.materials.append(_material((grey, grey, grey)))
        shade = np.minimum((len(GREYS) * confidence).astype(np.int32), len(GREYS) - 1)
        mesh.polygons.foreach_set("material_index", np.repeat(shade, len(FACES)).astype(np.int32))
    mesh.update(calc_edges=True)
    return mesh


def _material(colour: tuple[float, float, float]) -> bpy.types.Material:
    """A material of one colour, in solid views and rendered ones; one for all views."""
    name = "transformation space {:.2f} {:.2f} {:.2f}".format(*colour)
    known = bpy.data.materials.get(name)
    if known is not None:
        return known
    made = bpy.data.materials.new(name)
    if made.node_tree is None:  # Blender before 5.0
        made.use_nodes = True
    made.diffuse_color = (*colour, 1.0)
    shader = next(node for node in made.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    return made


def _emptied(scene: bpy.types.Scene, node: str) -> bpy.types.Collection:
    """The collection of an operation's view with nothing of a former one in it."""
    holder = space_collection(scene, node)
    if holder is not None:
        former = [item for item in holder.objects if item.get(names.CONTENT) == "space"]
        data = dict.fromkeys(item.data for item in former)
        bpy.data.batch_remove(former)
        bpy.data.batch_remove([one for one in data if one.users == 0])
        return holder
    outer = ensure_holder_with(scene.collection, names.SPACE, COLLECTION)
    return ensure_holder_with(outer, names.SPACE, node, f"{node} transformations")
