"""What those operations share that place library objects: examples, results as elements, decisions by hand."""

from abc import abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..geometry.surface import GROUND, Surface
from ..poses.model import PoseModel
from ..poses.pose import Pose
from ..poses.results import PropagatedPose
from ..progress import Stepper
from ..tolerances import SAME_POLYGON
from .decisions import Decisions
from .element import Element, plain_ring
from .keys import distinct, key_of
from .layout import Layout, OnSurface
from .operation import Operation
from .settings import stored, text


@dataclass(frozen=True, kw_only=True)
class Placing(Operation):
    """An operation that adds elements to the layout.

    Attributes
    ----------
    decisions : Decisions
        Results accepted, rejected and pinned by hand.
    """

    decisions: Decisions = field(
        default_factory=Decisions, metadata=stored(Decisions.from_dict, Decisions.to_dict, late=True)
    )

    @abstractmethod
    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[tuple[Element, ...]]:
        """All elements that it may place, as a stepper: the examples, then the results, best first."""

    def chosen(self, results: Sequence[Element], examples: Sequence[Element], layout: Layout) -> Sequence[Element]:
        """Those results that the settings let pass; all, unless there are such settings.

        Parameters
        ----------
        results : sequence of Element
            Best first, without the examples.
        examples : sequence of Element
            Those that stand in the scene.
        layout : Layout

        Returns
        -------
        sequence of Element
        """
        return results

    def template(self, node: str) -> Element | None:
        """What a pinned result looks like that is no longer proposed; None where it cannot be told.

        Parameters
        ----------
        node : str

        Returns
        -------
        Element or None
        """
        return None

    @property
    def places_in(self) -> frozenset[str] | None:
        """Labels of the polygons that it may place something in; None: any."""
        return None

    def decide(self, proposed: Sequence[Element], layout: Layout, node: str) -> tuple[Layout, ...]:
        """The layout with the examples, and with the results that pass, corrected by the decisions by hand."""
        by_surface: dict[str, list[Element]] = {GROUND: []}
        for e in proposed:
            by_surface.setdefault(e.surface, []).append(e)
        surfaces = {s.id: s for s in layout.surfaces(self.places_in)} if self.decisions != NONE else {}
        for pin in self.decisions.pinned.values():
            if pin.parent in surfaces:
                by_surface.setdefault(pin.parent, [])
        found: list[Element] = []
        for id, elements in by_surface.items():
            there = layout
            if id != GROUND:
                surface = surfaces.get(id) or layout.surface_under(elements[0])
                there = OnSurface(layout.ground, surface=surface, standing=tuple(layout.on.get(id, ())))
            chosen = self._decided(elements, there, node)
            found += [e if e.surface == id else standing_on(surfaces[id], e) for e in chosen]
        return (layout.with_elements(found),)

    def _decided(self, proposed: Sequence[Element], layout: Layout, node: str) -> list[Element]:
        """What of the elements on one surface stays."""
        examples = [e for e in proposed if e.example]
        results = [e for e in proposed if not e.example]
        chosen = self.chosen(results, examples, layout)
        if self.decisions != NONE:
            chosen = self.decisions.apply(results, chosen, self.template(node), layout.scene)
        return [*examples, *chosen]


#: What has been decided where nothing has.
NONE = Decisions()


def standing_on(surface: Surface, element: Element) -> Element:
    """An element of an unnamed surface on a surface of the scene.

    Parameters
    ----------
    surface : Surface
    element : Element
        Its ids have `UNNAMED` where they will have the surface's.

    Returns
    -------
    Element
    """
    return element.changed(
        parent=element.parent.replace(UNNAMED, surface.id),
        key=element.key.replace(UNNAMED, surface.id),
        surface=surface.id,
        owner=surface.parent,
        frame=surface.frame,
        twin=element,
    )


#: The id of a surface in what equal surfaces share; no id that a user gives has this character.
UNNAMED = "\0"


@dataclass(frozen=True, kw_only=True)
class PlacingOne(Placing):
    """An operation that places one library object in many places.

    Attributes
    ----------
    mesh : str
        Name of the library object.
    label : str
        What later operations see it as.
    """

    mesh: str = field(metadata=stored(text))
    label: str = field(metadata=stored(text))

    @property
    @abstractmethod
    def footprint(self) -> NDArray[np.float64] | None:
        """The object's ring in its pose's frame; None: a point."""

    def template(self, node: str) -> Element:
        """The object at the origin."""
        return Element(self.label, self.mesh, "", Pose((0.0, 0.0)), plain_ring(self.footprint), node, "")


def elements_of(
    results: Iterable[PropagatedPose], model: PoseModel, mesh: str, label: str, node: str, scene: Scene
) -> list[Element]:
    """Propagated poses as elements, after their example where it stands in the scene.

    Parameters
    ----------
    results : iterable of PropagatedPose
        Best first.
    model : PoseModel
        What they were propagated from.
    mesh, label, node : str
        The elements'.
    scene : Scene

    Returns
    -------
    list of Element
    """
    ring = plain_ring(model.footprint)
    found = [example(model, mesh, label, node)] if holds(scene, model.parent) else []
    for r in results:
        key = key_of(r.pose.position, r.parent)
        parent = str(r.parent.id)
        found.append(Element(label, mesh, parent, r.pose, ring, node, key, scale=r.scale, importance=r.importance))
    return found


def with_distinct_keys(elements: Sequence[Element]) -> tuple[Element, ...]:
    """Elements of one node, of which no two have the same key.

    Parameters
    ----------
    elements : sequence of Element

    Returns
    -------
    tuple of Element
    """
    keys = distinct(e.key for e in elements)
    return tuple(e if e.key == key else replace(e, key=key) for e, key in zip(elements, keys, strict=True))


def example(model: PoseModel, mesh: str, label: str, node: str) -> Element:
    """The example of a model as an element.

    Parameters
    ----------
    model : PoseModel
    mesh, label, node : str
        The element's.

    Returns
    -------
    Element
    """
    ring = plain_ring(model.footprint)
    key = key_of(model.pose.position, model.parent)
    return Element(label, mesh, str(model.parent.id), model.pose, ring, node, key, example=True)


def holds(scene: Scene, polygon: Polygon) -> bool:
    """Whether a scene has a polygon: the same id, and the same vertices but for single precision.

    Parameters
    ----------
    scene : Scene
    polygon : Polygon

    Returns
    -------
    bool
    """
    found = next((p for p in scene.polygons if p.id == polygon.id), None)
    return (
        found is not None
        and found.points.shape == polygon.points.shape
        and bool(np.abs(found.points - polygon.points).max() <= SAME_POLYGON * polygon.size)
    )


def read_by(models: Sequence[PoseModel], scene: Scene) -> list[Polygon]:
    """The polygons that the answers of pose models depend on: the parents that can match, and their members.

    Parameters
    ----------
    models : sequence of PoseModel
    scene : Scene

    Returns
    -------
    list of Polygon
        In the scene's order.
    """
    read = set()
    for model in models:
        for parent in model.targets(scene):
            read |= {parent.id, *(member.id for member in scene.members_of(str(parent.id)))}
    return [p for p in scene.polygons if p.id in read]
