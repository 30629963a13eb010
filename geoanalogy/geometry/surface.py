"""Planar surfaces: the domains that operations place on (section 5.6)."""

from dataclasses import dataclass

from .frame import Frame
from .polygon import Polygon

#: The surface that the polygons of a scene lie on.
GROUND = "ground"


@dataclass(frozen=True, eq=False)
class Surface:
    """A planar, parametrised part of the scene. Elements live on one, and relations only hold inside it.

    Attributes
    ----------
    id : str
        Its name among all surfaces, and that of its polygon.
    label : str
        What kind of surface it is ("facade", "roof").
    frame : Frame
        Where it lies: its x axis is the main orientation, its normal points out of the solid.
    polygon : Polygon
        Its outline in the frame's coordinates.
    parent : str
        Id of the element that it belongs to; "" for a surface that belongs to none.
    """

    id: str
    label: str
    frame: Frame
    polygon: Polygon
    parent: str = ""

    @classmethod
    def of(cls, id: str, frame: Frame, polygon: Polygon) -> "Surface":
        """A surface that the user has chosen: any flat outline in space.

        Parameters
        ----------
        id : str
        frame : Frame
        polygon : Polygon
            In the frame's coordinates; its label is the surface's.

        Returns
        -------
        Surface
        """
        own = Polygon(polygon.points, polygon.label, id, polygon.holes, None, 0.0, polygon.segment_labels)
        return cls(id, polygon.label, frame, own)
