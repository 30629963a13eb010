"""Elements: what an operations tree places (section 5.6)."""

from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.extrusion import triangulated
from ..geometry.frame import SPACE, Frame
from ..geometry.mesh import Mesh
from ..geometry.polygon import Polygon
from ..geometry.solid import Solid
from ..geometry.surface import GROUND
from ..poses.pose import Pose
from .changes import Change

Ring = tuple[tuple[float, float], ...]

#: Digits of the coordinates of outlines in their own frames: rounding apart, equal elements have equal outlines.
DIGITS = 9


@dataclass(frozen=True)
class Element:
    """One object in its place.

    Attributes
    ----------
    label : str
        What kind of thing it is; later operations see it under this label.
    mesh : str or Mesh
        Name of the library object that stands there, "" for none; in what `OperationsTree.apply` returns, the mesh in
        space of what was extruded.
    parent : str
        Id of the polygon it stands in.
    pose : Pose
        Where it stands, in the coordinates of its surface.
    footprint : tuple of (float, float), or None
        Its ring in the pose's own frame at scale 1 (origin at its position, x along its direction); None: a point.
    node : str
        Id of the node that placed it.
    key : str
        Its stable name among the results of its node (see `keys`).
    surface : str
        The surface it lies on.
    scale : float
        Its size in proportion to the library object's.
    importance : float
        How well it answers the example, 0 to 1.
    example : bool
        Whether it is the example itself, put there by the user.
    stretch : (float, float)
        Its extents along the pose's direction and across it, in proportion to the library object's at that scale.
    novelty : float
        How far its surroundings are from anything that was taught, 0 to 1.
    owner : str
        Id of the element whose solid the surface is a face of; "" on the ground.
    frame : Frame
        Where its surface lies in space.
    base : Solid or None
        What it was extruded to, in the frame `place`.
    changes : tuple of Change
        What has been merged into it and subtracted from it, in order.
    solid : Solid or None
        The base after these changes.
    absorbed_by : str
        Id of the element that its own solid has become a part of, or been cut out of; "" for none.
    twin : Element or None
        The same on an unnamed surface: equal surfaces share it.
    """

    label: str
    mesh: str | Mesh
    parent: str
    pose: Pose
    footprint: Ring | None
    node: str
    key: str
    surface: str = GROUND
    scale: float = 1.0
    importance: float = 1.0
    example: bool = False
    stretch: tuple[float, float] = (1.0, 1.0)
    novelty: float = 0.0
    owner: str = ""
    frame: Frame = SPACE
    base: Solid | None = None
    changes: tuple[Change, ...] = ()
    solid: Solid | None = None
    absorbed_by: str = ""
    twin: "Element | None" = field(default=None, compare=False, repr=False)

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.node, self.key, self.label, self.surface, self.pose, self.solid))

    def __getstate__(self) -> dict[str, Any]:
        """What another process needs; hashes differ there."""
        return {name: self.__dict__[name] for name in self.__dataclass_fields__}

    @cached_property
    def id(self) -> str:
        """Its name among all elements and polygons: the node's and its key."""
        return f"{self.node}/{self.key}"

    @property
    def ring(self) -> NDArray[np.float64] | None:
        """Its outline on the surface, shape (n, 2), counter-clockwise unless it is mirrored; None for a point."""
        return None if self.footprint is None else self.pose.to_scene(self._sized)

    @property
    def reach(self) -> float:
        """Greatest distance of its outline from its position; 0 for a point."""
        return 0.0 if self.footprint is None else float(np.hypot(*self._sized.T).max())

    @property
    def _sized(self) -> NDArray[np.float64]:
        return self.scale * np.array(self.stretch) * np.array(self.footprint)

    @cached_property
    def polygon(self) -> Polygon | None:
        """The polygon that later operations see; None for a point.

        Its parent is found by containment, not stated: a flower bed may itself become a parent.
        """
        ring = self.ring
        return None if ring is None else Polygon(ring, label=self.label, id=self.id)

    @cached_property
    def outline(self) -> Polygon | None:
        """The polygon in the pose's own frame, which equal elements share; None for a point."""
        if self.twin is not None:
            return self.twin.outline
        ring = self.ring
        if ring is None:
            return None
        c, s = np.cos(self.pose.angle), np.sin(self.pose.angle)
        own = (ring - self.pose.position) @ np.array([[c, -s], [s, c]])
        return Polygon(np.round(own, DIGITS) + 0.0, self.label)

    @cached_property
    def place(self) -> Frame:
        """The pose as a frame of space: origin at its position, x along its direction, normal out of the surface."""
        return self.frame.moved(*self.pose.position, self.pose.angle)

    def changed(self, **values: Any) -> "Element":
        """The element with other values, which keep its outline.

        Parameters
        ----------
        **values
            Of its attributes.

        Returns
        -------
        Element
        """
        made = object.__new__(type(self))  # some thousands an operation: `replace` would check what is known
        made.__dict__.update({name: self.__dict__[name] for name in self.__dataclass_fields__})
        made.__dict__.update(values)
        polygon = self.__dict__.get("polygon")
        if polygon is not None and made.id != self.id:
            polygon = copy(polygon)
            polygon.__dict__.pop("content", None)  # which has the id
            polygon.id = made.id
        if polygon is not None:
            made.__dict__["polygon"] = polygon
        return made

    @property
    def geometry(self) -> Mesh | None:
        """What it is made of, in space: its solid, or its flat outline; None for a point and for what is absorbed."""
        if self.absorbed_by:
            return None
        if self.solid is not None:
            return self.solid.mesh.placed(self.place)
        if self.polygon is None:
            return None
        flat = self.polygon.points
        faces = triangulated([flat])
        index = np.zeros(len(faces), dtype=np.intp)
        return Mesh(self.frame.to_space(flat), faces, flat[faces], (self.label,), index)


def plain_ring(footprint: NDArray[np.float64] | None) -> Ring | None:
    """A footprint as an element keeps it, so that elements can be compared.

    Parameters
    ----------
    footprint : ndarray of shape (n, 2) or None

    Returns
    -------
    tuple of (float, float), or None
    """
    return None if footprint is None else tuple((float(x), float(y)) for x, y in footprint)
