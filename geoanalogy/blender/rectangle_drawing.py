"""Drawing rectangles on faces: from lines of sight to points on a face, from two corners to an object."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.rectangle import Rectangle
from ..poses.pose import Pose
from ..progress import run
from . import names
from .holders import ensure_holder
from .overlay import Shape
from .reading.footprints import frame_of
from .reading.planes import Plane
from .tree.editing import chosen_outputs
from .tree.evaluating import after_steps, read_surroundings
from .tree.sites import NEARER, Site, sites_of
from .tree.store import builds, ordered_nodes, tree_of
from .writing.selection import select_only

Array = NDArray[np.float64]

#: Colours of what is wanted, and of what is not.
WANTED, UNWANTED = (0.25, 0.8, 0.45, 1.0), (0.95, 0.35, 0.25, 1.0)

#: The collection that drawn rectangles are put into.
EXAMPLES = "Examples"

#: Cosine of the angle between a line of sight and a face that is seen edge-on: half a degree.
EDGE_ON = 0.009

#: Shortest side of a drawn rectangle in sizes of its face: less is a click, not a rectangle.
LEAST_SIDE = 1e-3

#: Distance of a corner from its face, in sizes of the face: single precision, and a hand that typed it.
ON_FACE = 0.01


@dataclass(frozen=True)
class Face:
    """A labelled outline that can be drawn on.

    Attributes
    ----------
    plane : Plane
    polygon : Polygon
        The smallest under the point that was asked for.
    """

    plane: Plane
    polygon: Polygon


def sites_to_draw_on(context: bpy.types.Context) -> list[Site]:
    """What rectangles can be drawn on: everything labelled but what was drawn before, and the surfaces of solids.

    Parameters
    ----------
    context : bpy.types.Context

    Returns
    -------
    list of Site
        Planes of the scene, then surfaces that come in to the next operation.

    Raises
    ------
    InputError
        Where nothing is labelled.
    """
    tree = tree_of(context.scene)
    every = read_surroundings(context, [item for item in context.scene.objects if names.DRAWN in item])
    links = chosen_outputs(tree, ordered_nodes(tree)) if builds(tree) else ()
    return sites_of(every, run(after_steps(every, links)))


def face_in_sight(sites: Iterable[Site], origin: ArrayLike, direction: ArrayLike) -> tuple[Face, Array] | None:
    """The first face that a line of sight meets, and where.

    Parameters
    ----------
    sites : iterable of Site
    origin, direction : array_like of shape (3,)
        Of the line, in the world.

    Returns
    -------
    (Face, ndarray of shape (3,)) or None
        None where it meets no labelled face.
    """
    best, nearest = None, np.inf
    for site in sites:
        away = sight_on(site.plane, origin, direction)
        if away is None or away >= nearest:
            continue
        point = np.asarray(origin, float) + away * np.asarray(direction, float)
        polygon = site.polygon_at(point)
        if polygon is not None:
            best, nearest = (Face(site.plane, polygon), point), away
    return best


def sight_on(plane: Plane, origin: ArrayLike, direction: ArrayLike) -> float | None:
    """How far along a line of sight a plane is.

    Parameters
    ----------
    plane : Plane
    origin, direction : array_like of shape (3,)

    Returns
    -------
    float or None
        In lengths of the direction; None where it is seen edge-on or lies behind.
    """
    direction = np.asarray(direction, float)
    steep = float(plane.normal @ direction)
    if abs(steep) <= EDGE_ON * np.linalg.norm(direction):
        return None
    away = float(plane.normal @ (plane.origin - np.asarray(origin, float))) / steep
    return away if away > 0 else None


def face_at(sites: Iterable[Site], *points: ArrayLike) -> Face:
    """The face that the first of some points lies on that lies on any.

    Parameters
    ----------
    sites : iterable of Site
    *points : array_like of shape (3,)
        In the world.

    Returns
    -------
    Face

    Raises
    ------
    InputError
        Where none lies on any.
    """
    for point in points:
        found = []
        for site in sites:
            polygon = site.polygon_at(point)
            height = abs(float(site.plane.to_plane([point])[0, 2]))
            if polygon is not None and height <= ON_FACE * polygon.size:
                # Of a floor and the ground below it, the ground comes first.
                found.append((height // NEARER, len(found), Face(site.plane, polygon)))
        if found:
            return min(found)[2]
    raise InputError("there is no labelled face here; label the face in step 1, then draw on it")


def rectangle_between(face: Face, start: ArrayLike, end: ArrayLike) -> Rectangle:
    """The rectangle between two opposite corners, along the main orientation of its face.

    Parameters
    ----------
    face : Face
    start, end : array_like of shape (3,)
        In the world; they are taken to the face.

    Returns
    -------
    Rectangle
        On the face's plane; of the two main directions, its width has the one nearer to level.

    Raises
    ------
    InputError
        Where the corners are too near to each other.
    """
    main = face.polygon.main_orientation
    angle = main - np.pi / 2 * round(main / (np.pi / 2))
    corners = face.plane.to_plane([start, end])[:, :2]
    c, s = np.cos(angle), np.sin(angle)
    turned = corners @ np.array([[c, -s], [s, c]])
    if np.ptp(turned, axis=0).min() < LEAST_SIDE * face.polygon.size:
        raise InputError("the rectangle has no area; drag from one corner to the opposite one")
    return Rectangle.from_box(np.hstack([turned.min(axis=0), turned.max(axis=0)]), angle)


def corners_in_world(rectangle: Rectangle, plane: Plane) -> Array:
    """The corners of a rectangle on a plane.

    Parameters
    ----------
    rectangle : Rectangle
    plane : Plane

    Returns
    -------
    ndarray of shape (4, 3)
        In the world.
    """
    return plane.to_world(np.column_stack([rectangle.ring, np.zeros(4)]))


def add_rectangles(
    context: bpy.types.Context, corners: Sequence[tuple[Sequence[float], Sequence[float], float]], label: str
) -> list[bpy.types.Object]:
    """Put rectangles on faces, as examples.

    Parameters
    ----------
    context : bpy.types.Context
    corners : sequence of (start, end, target)
        Two opposite corners in the world, and how much the rectangle is wanted.
    label : str
        What they are.

    Returns
    -------
    list of bpy.types.Object
        Selected, the last one active, and nothing else.

    Raises
    ------
    InputError
        For a rectangle off every labelled face or without area, and for an empty label; then none is made.
    """
    if not corners:
        raise InputError("no rectangle was drawn; drag one across a labelled face")
    label = required_label(label)
    sites = sites_to_draw_on(context)
    wanted = []
    for start, end, target in corners:
        # A corner that was set on the very edge of a face may lie a rounding beyond it.
        face = face_at(sites, start, np.add(start, end) / 2, end)
        wanted.append((rectangle_between(face, start, end), face.plane, target))
    holder = ensure_holder(context.scene.collection, EXAMPLES)
    made = []
    for rectangle, plane, target in wanted:
        item = bpy.data.objects.new(f"{label} rectangle", _sheet(rectangle))
        holder.objects.link(item)
        item.matrix_world = Matrix(frame_of(Pose((rectangle.x, rectangle.y), rectangle.angle), plane).tolist())
        item[names.LABEL] = label
        item[names.DRAWN] = True
        set_target(item, target)
        item.display_type = "WIRE"
        item.hide_render = True
        made.append(item)
    select_only(made)
    return made


def required_label(label: str) -> str:
    """What rectangles are called, without the blanks around it.

    Parameters
    ----------
    label : str

    Returns
    -------
    str

    Raises
    ------
    InputError
        Where nothing is left.
    """
    if not label.strip():
        raise InputError("the rectangles have no label; say what they are before drawing them")
    return label.strip()


def set_target(item: bpy.types.Object, target: float) -> None:
    """Say how much an example is wanted.

    Parameters
    ----------
    item : bpy.types.Object
    target : float
        From 1, wanted, to 0: nothing of the kind here.
    """
    item[names.TARGET] = float(target)
    item.id_properties_ui(names.TARGET).update(min=0.0, max=1.0, description="1 is wanted, 0 is not wanted")


def _sheet(rectangle: Rectangle) -> bpy.types.Mesh:
    x, y = rectangle.width / 2, rectangle.height / 2
    mesh = bpy.data.meshes.new("rectangle")
    mesh.from_pydata([(-x, -y, 0.0), (x, -y, 0.0), (x, y, 0.0), (-x, y, 0.0)], [], [(0, 1, 2, 3)])
    return mesh


@dataclass
class Sketch:
    """Rectangles that are being drawn: nothing of it is in the scene yet.

    Attributes
    ----------
    sites : list of Site
    done : list of (start, end, target)
        Finished rectangles, as `add_rectangles` takes them.
    outlines : list of (ndarray of shape (4, 3), float)
        Their corners in the world, and their targets.
    target : float
        How much the rectangles are wanted that are drawn next.
    """

    sites: list[Site]
    target: float = 1.0
    done: list[tuple[tuple[float, ...], tuple[float, ...], float]] = field(default_factory=list)
    outlines: list[tuple[Array, float]] = field(default_factory=list)
    _face: Face | None = None
    _start: Array | None = None
    _end: Array | None = None

    @property
    def dragging(self) -> bool:
        """Whether a corner has been set whose opposite is still to come."""
        return self._face is not None

    def press(self, origin: ArrayLike, direction: ArrayLike) -> bool:
        """Set the first corner where a line of sight meets a face.

        Parameters
        ----------
        origin, direction : array_like of shape (3,)

        Returns
        -------
        bool
            False where it meets none.
        """
        found = face_in_sight(self.sites, origin, direction)
        if found is None:
            return False
        self._face, self._start = found
        self._end = self._start
        return True

    def move(self, origin: ArrayLike, direction: ArrayLike) -> None:
        """Move the opposite corner to where a line of sight meets the plane of the face.

        Parameters
        ----------
        origin, direction : array_like of shape (3,)
        """
        away = None if self._face is None else sight_on(self._face.plane, origin, direction)
        if away is not None:
            self._end = np.asarray(origin, float) + away * np.asarray(direction, float)

    def shapes(self) -> Iterator[Shape]:
        """What is to be drawn of it, in the colours of how much it is wanted.

        Yields
        ------
        Shape
        """
        current = self.current()
        for corners, target in [*self.outlines, *([] if current is None else [(current[0], self.target)])]:
            colour = tuple(target * a + (1.0 - target) * b for a, b in zip(WANTED, UNWANTED, strict=True))
            yield Shape(corners.tolist(), colour, closed=True)

    def current(self) -> tuple[Array, Rectangle] | None:
        """The rectangle that is being dragged.

        Returns
        -------
        (ndarray of shape (4, 3), Rectangle) or None
            Its corners in the world, and itself on its plane; None where it has no area yet.
        """
        if self._face is None or self._start is None or self._end is None:
            return None
        try:
            rectangle = rectangle_between(self._face, self._start, self._end)
        except InputError:
            return None
        return corners_in_world(rectangle, self._face.plane), rectangle

    def release(self) -> bool:
        """Finish the rectangle that is being dragged.

        Returns
        -------
        bool
            False where it has no area; it is dropped then.
        """
        current = self.current()
        if current is not None:
            self.done.append((tuple(map(float, self._start)), tuple(map(float, self._end)), self.target))
            self.outlines.append((current[0], self.target))
        self._face = self._start = self._end = None
        return current is not None

    def take_back(self) -> None:
        """Drop the rectangle that is being dragged, else the last one."""
        if self.dragging:
            self._face = self._start = self._end = None
        elif self.done:
            self.done.pop()
            self.outlines.pop()
