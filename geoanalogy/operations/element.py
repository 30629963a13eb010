"""Elements: what an operations tree places (section 5.6)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..poses.pose import Pose

#: The surface that the polygons of a scene lie on.
GROUND = "ground"

Ring = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Element:
    """One object in its place.

    Attributes
    ----------
    label : str
        What kind of thing it is; later operations see it under this label.
    mesh : str
        Name of the library object that stands there.
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
    """

    label: str
    mesh: str
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

    @property
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
