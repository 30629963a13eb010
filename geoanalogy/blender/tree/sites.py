"""Sites: where examples lie and results stand, a plane of the scene or a surface that an operation has made there."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import bpy
import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ...geometry.polygon import Polygon
from ...geometry.scene import Scene
from ...geometry.surface import GROUND, Surface
from ...operations.element import Element
from ...operations.layout import Layout, OnSurface
from ...progress import run
from ..reading.ground import Ground
from ..reading.planes import Plane
from ..reading.shapes import solid_points
from ..reading.whereabouts import up_to_date
from .evaluating import Surroundings, incoming_steps, read_surroundings, surroundings_of
from .refresh import stored_layout
from .store import builds, works_everywhere

Array = NDArray[np.float64]

#: Distance from a surface, in sizes of the surface, below which a point lies on it: single precision, and a hand that
#: typed it.
ON_SURFACE = 0.01

#: How much nearer to a surface than to the ground something must lie that may lie on either, scene units: of a floor
#: and the ground below it, the ground is meant.
NEARER = 1e-3


@dataclass(frozen=True)
class Site:
    """A plane, with what lies on it.

    Attributes
    ----------
    ground : Ground
        The plane that the operations were evaluated on.
    layout : Layout
        What has come in there.
    surface : Surface or None
        The surface of a solid; None for the ground itself.
    depsgraph : bpy.types.Depsgraph
    """

    ground: Ground
    layout: Layout
    surface: Surface | None
    depsgraph: bpy.types.Depsgraph

    @cached_property
    def plane(self) -> Plane:
        """Where it lies in the world."""
        return self.ground.plane if self.surface is None else self.ground.plane.under(self.surface.frame)

    @cached_property
    def scene(self) -> Scene:
        """The polygons there."""
        return self.without(())

    def without(self, elements: Iterable[Element]) -> Scene:
        """The polygons there but for some elements.

        Parameters
        ----------
        elements : iterable of Element

        Returns
        -------
        Scene
        """
        gone = {e.id for e in elements}
        layout = self.layout
        if gone:
            layout = replace(layout, elements=tuple(e for e in layout.elements if e.id not in gone))
        if self.surface is None:
            return layout.scene
        standing = tuple(layout.elements_on(self.surface))
        return OnSurface(layout.ground, surface=self.surface, standing=standing).scene

    def polygon_at(self, point: ArrayLike) -> Polygon | None:
        """The smallest polygon there that a point lies over or under.

        Parameters
        ----------
        point : array_like of shape (3,)
            In the world.

        Returns
        -------
        Polygon or None
        """
        x, y = self.plane.to_plane([point])[0, :2]
        if self.surface is not None:
            low, high = np.reshape(self.surface.polygon.bounds, (2, 2))
            if not ((low <= (x, y)).all() and ((x, y) <= high).all()):
                return None
        return self.scene.parent_of((x, y))

    def gap_to(self, point: ArrayLike) -> float | None:
        """Distance of a point from the surface.

        Parameters
        ----------
        point : array_like of shape (3,)
            In the world.

        Returns
        -------
        float or None
            None where it is not over the surface or under it.
        """
        assert self.surface is not None
        x, y, height = self.plane.to_plane([point])[0]
        polygon = self.surface.polygon
        if shapely.distance(polygon.shape, shapely.Point(x, y)) > ON_SURFACE * polygon.size:
            return None
        return abs(float(height))


def sites_in(ground: Ground, layout: Layout, depsgraph: bpy.types.Depsgraph) -> list[Site]:
    """The ground, and all surfaces of the solids that stand there.

    Parameters
    ----------
    ground : Ground
    layout : Layout
    depsgraph : bpy.types.Depsgraph

    Returns
    -------
    list of Site
        The ground first.
    """
    return [Site(ground, layout, None, depsgraph), *(Site(ground, layout, s, depsgraph) for s in layout.surfaces())]


def sites_of(every: Sequence[Surroundings], layouts: Sequence[Layout]) -> list[Site]:
    """All planes and all surfaces of a scene.

    Parameters
    ----------
    every : sequence of Surroundings
    layouts : sequence of Layout
        What has come in on each.

    Returns
    -------
    list of Site
    """
    pairs = zip(every, layouts, strict=True)
    return [site for around, layout in pairs for site in sites_in(around.ground, layout, around.depsgraph)]


def sites_before(context: bpy.types.Context, node: bpy.types.Node) -> list[Site]:
    """The planes that a node works on, with what comes in to it.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node
        Of the scene's tree.

    Returns
    -------
    list of Site
        The grounds; `site_under` finds surfaces.

    Raises
    ------
    InputError
        Where the ground cannot be read.
    """
    depsgraph = up_to_date(context)
    if not builds(node.id_data):
        return [Site(ground, layout, None, depsgraph) for ground, layout in stored_layout(context.scene, node)]
    own = [a for a in read_surroundings(context) if works_everywhere(node) or node in a.nodes]
    return [Site(a.ground, run(incoming_steps(a, node.name)), None, depsgraph) for a in own]


def site_of(
    sites: Sequence[Site], every: Sequence[Surroundings], item: bpy.types.Object, point: Sequence[float] | None = None
) -> Site:
    """Where an object lies.

    Parameters
    ----------
    sites : sequence of Site
    every : sequence of Surroundings
    item : bpy.types.Object
    point : sequence of three float, optional
        What of it counts, in the world; None: its origin.

    Returns
    -------
    Site
        The surface that it touches, where its middle lies nearer to that than to the ground; else the ground.

    Raises
    ------
    InputError
        Where the matrix of the object is not finite.
    """
    around = surroundings_of(list(every), item, point)
    home = next(site for site in sites if site.ground is around.ground)
    made = [site for site in sites if site.surface is not None]
    points = solid_points(item, every[0].depsgraph) if made else np.zeros((0, 3))
    if not len(points):
        return home
    middle = (points.min(axis=0) + points.max(axis=0)) / 2 if point is None else np.asarray(point, float)
    x, y, height = home.plane.to_plane([middle])[0]
    over = home.ground.scene.parent_of((x, y)) is not None
    nearest, best = (abs(float(height)) if over else np.inf), home
    for site in made:
        gap = site.gap_to(middle)
        if gap is None or gap >= nearest - NEARER:
            continue
        heights = site.plane.to_plane(points)[:, 2]
        reach = ON_SURFACE * site.surface.polygon.size
        if heights.min() <= reach and heights.max() >= -reach:
            nearest, best = gap, site
    return best


def site_under(sites: Iterable[Site], element: Element) -> Site | None:
    """The site that an element stands on.

    Parameters
    ----------
    sites : iterable of Site
    element : Element

    Returns
    -------
    Site or None
        None where it is no longer there.
    """
    for site in (site for site in sites if site.surface is None):
        if element.surface != GROUND:
            surface = site.layout.surface_under(element)
            if surface is not None:
                return replace(site, surface=surface)
        elif element.parent in site.layout.polygon_ids:
            return site
    return None
