"""Image patches: an image with alpha on a mesh over the query, fine enough to be bent with the mapping."""

import bpy
import numpy as np
import shapely
from mathutils import Matrix, Vector
from mathutils.geometry import delaunay_2d_cdt
from numpy.typing import NDArray

from ...errors import InputError
from .. import names
from ..holders import ensure_holder
from ..reading.planes import Plane

Array = NDArray[np.float64]

#: About how many vertices a patch has inside.
PATCH_POINTS = 500

#: Name of the collection that patches are put into.
PAINTED = "Painted"

#: Name of the UV layer of patches.
UV = "UVMap"


def add_patch(
    scene: bpy.types.Scene, region: shapely.Geometry, image: bpy.types.Image, plane: Plane, height: float, name: str
) -> bpy.types.Object:
    """Lay an image over a region.

    Parameters
    ----------
    scene : bpy.types.Scene
    region : shapely geometry
        On the plane; the image fills its bounding box.
    image : bpy.types.Image
    plane : Plane
    height : float
        Above the plane: its layer.
    name : str

    Returns
    -------
    bpy.types.Object
        A mesh with UVs and a material, in the scene's collection of contents.

    Raises
    ------
    InputError
        Where the region has no area.
    """
    if not region.area > 0.0:
        raise InputError("the query has no area; outline the region again")
    corners, faces = triangulated(region)
    x0, y0, x1, y1 = region.bounds
    middle = np.array(((x0 + x1) / 2, (y0 + y1) / 2))
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(np.column_stack([corners - middle, np.zeros(len(corners))]).tolist(), [], faces.tolist())
    uv = (corners - (x0, y0)) / (max(x1 - x0, 1e-30), max(y1 - y0, 1e-30))
    layer = mesh.uv_layers.new(name=UV)
    layer.uv.foreach_set("vector", uv[faces.ravel()].ravel().astype(np.float32))
    mesh.materials.append(image_material(image))
    item = bpy.data.objects.new(name, mesh)
    frame = plane.matrix.copy()
    frame[:3, 3] = plane.to_world([(*middle, height)])[0]
    item.matrix_world = Matrix(frame.tolist())
    item[names.CONTENT] = True
    ensure_holder(scene.collection, PAINTED).objects.link(item)
    return item


def triangulated(region: shapely.Geometry) -> tuple[Array, NDArray[np.intp]]:
    """A region as triangles of about equal size.

    Parameters
    ----------
    region : shapely geometry

    Returns
    -------
    corners : ndarray of shape (n, 2)
    faces : ndarray of shape (m, 3), int
        Counter-clockwise.
    """
    step = float(np.sqrt(region.area / PATCH_POINTS))
    x0, y0, x1, y1 = region.bounds
    rows = np.arange(y0 + step / 2, y1, step * np.sqrt(0.75))
    shifted = [np.arange(x0 + (0.25 + 0.5 * (i % 2)) * step, x1, step) for i in range(len(rows))]
    inner = np.vstack(
        [np.column_stack([x, np.full(len(x), y)]) for x, y in zip(shifted, rows, strict=True)] or [np.zeros((0, 2))]
    )
    inside = region.buffer(-0.4 * step)
    shapely.prepare(inside)
    inner = inner[shapely.contains_xy(inside, inner[:, 0], inner[:, 1])]
    points, edges = [], []
    for part in shapely.get_parts(region):
        if part.geom_type != "Polygon":
            continue
        for ring in (part.exterior, *part.interiors):
            own = shapely.get_coordinates(ring.simplify(0.02 * step).segmentize(step))[:-1]
            first = len(points)
            points += own.tolist()
            edges += [(first + i, first + (i + 1) % len(own)) for i in range(len(own))]
    points += inner.tolist()
    # Near the origin, the library's tolerance is far below the smallest distance.
    middle, size = np.array(((x0 + x1) / 2, (y0 + y1) / 2)), max(x1 - x0, y1 - y0)
    unit = (np.array(points) - middle) / size
    made, _, faces, *_ = delaunay_2d_cdt([Vector(p) for p in unit.tolist()], edges, [], 1, 1e-7)
    corners = np.array([tuple(v) for v in made]) * size + middle
    return corners, np.array(faces, dtype=np.intp)


def image_material(image: bpy.types.Image) -> bpy.types.Material:
    """The material of an image with alpha: flat colour, as painted.

    Parameters
    ----------
    image : bpy.types.Image

    Returns
    -------
    bpy.types.Material
        One per image.
    """
    known = next((m for m in bpy.data.materials if m.get(names.CONTENT) == image.name), None)
    if known is not None:
        return known
    made = bpy.data.materials.new(image.name)
    made[names.CONTENT] = image.name
    if made.node_tree is None:  # Blender before 5.0
        made.use_nodes = True
    made.surface_render_method = "BLENDED"
    tree = made.node_tree
    tree.nodes.clear()
    kinds = ("TexImage", "BsdfTransparent", "Emission", "MixShader", "OutputMaterial")
    picture, clear, light, mix, output = (tree.nodes.new(f"ShaderNode{kind}") for kind in kinds)
    for i, node in enumerate((picture, clear, light, mix, output)):
        node.location = (200.0 * i, 0.0)
    picture.image = image
    picture.extension = "EXTEND"
    for source, target in (
        (picture.outputs["Alpha"], mix.inputs[0]),
        (picture.outputs["Color"], light.inputs["Color"]),
        (clear.outputs[0], mix.inputs[1]),
        (light.outputs[0], mix.inputs[2]),
        (mix.outputs[0], output.inputs["Surface"]),
    ):
        tree.links.new(source, target)
    return made
