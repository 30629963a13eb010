"""Placement by one example (chapter 4)."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..poses.model import PoseModel
from ..progress import Stepper
from ..tolerances import TOUCHING_SHARE
from .element import Element
from .layout import Layout
from .placing import PlacingOne, elements_of, read_by, with_distinct_keys
from .settings import counts, number, optional, stored


@dataclass(frozen=True, kw_only=True)
class PosePlacement(PlacingOne):
    """Put a library object wherever it stands in the relations of its example.

    Attributes
    ----------
    model : PoseModel
        What the example says.
    threshold : float
        Results below this importance are not placed; the model's own threshold bounds it from below.
    max_per : mapping of str to int
        Most results per parent of a label (section 4.8).
    spacing : float or None
        Least distance between two results of a parent, scene units (section 4.8, density).
    """

    type = "pose placement"

    model: PoseModel = field(metadata=stored(PoseModel.from_dict, PoseModel.to_dict))
    threshold: float = field(default=0.0, metadata=stored(number, late=True))
    max_per: dict[str, int] = field(default_factory=dict, metadata=stored(counts, dict, late=True))
    spacing: float | None = field(default=None, metadata=stored(optional(number), late=True))

    @property
    def footprint(self) -> NDArray[np.float64] | None:
        """The example's footprint."""
        return self.model.footprint

    @property
    def places_in(self) -> frozenset[str]:
        """The label of the polygons that the example is in."""
        return frozenset({self.model.parent.label})

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[tuple[Element, ...]]:
        """Propagate the example."""
        results = yield from self.model.steps(layout.scene)
        found = elements_of(results, self.model, self.mesh, self.label, node, layout.scene)
        return with_distinct_keys(found)

    def chosen(self, results: Sequence[Element], examples: Sequence[Element], layout: Layout) -> Sequence[Element]:
        """The results above the threshold that leave each other room, at most so many per parent."""
        return sift(results, examples, layout, self.threshold, self.max_per, self.spacing)

    def reads(self, layout: Layout) -> list[Polygon]:
        """The rooms like the example's, and what stands in them."""
        return read_by([self.model], layout.scene)


def sift(
    results: Sequence[Element],
    examples: Sequence[Element],
    layout: Layout,
    threshold: float,
    max_per: Mapping[str, int],
    spacing: float | None,
) -> list[Element]:
    """Results above a threshold that leave each other room, at most so many per parent (section 4.8).

    Parameters
    ----------
    results : sequence of Element
        Best first.
    examples : sequence of Element
        They count among the objects of their parents.
    layout : Layout
        Where the parents are.
    threshold : float
        Least importance.
    max_per : mapping of str to int
        Most objects per parent of a label.
    spacing : float or None
        Least distance between two objects of a parent, scene units; None: as long as they do not intersect.

    Returns
    -------
    list of Element
        In order.
    """
    standing: dict[str, list[Element]] = {}
    for e in examples:
        standing.setdefault(e.parent, []).append(e)
    kept = []
    for e in results:
        others = standing.setdefault(e.parent, [])
        most = max_per.get(layout.scene.polygon(e.parent).label)
        full = most is not None and len(others) >= most
        if e.importance >= threshold and not full and not any(too_near(e, other, spacing) for other in others):
            others.append(e)
            kept.append(e)
    return kept


def too_near(one: Element, other: Element, spacing: float | None) -> bool:
    """Whether two elements are nearer than a distance, or intersect.

    Parameters
    ----------
    one, other : Element
        On one surface.
    spacing : float or None
        Scene units; None: only whether they intersect.

    Returns
    -------
    bool
    """
    gap = math.dist(one.pose.position, other.pose.position)
    if spacing is not None and gap < spacing:
        return True
    if one.polygon is None or other.polygon is None or gap > one.reach + other.reach:
        return False
    shared = one.polygon.shape.intersection(other.polygon.shape).area
    return bool(shared > TOUCHING_SHARE * min(one.polygon.area, other.polygon.area))
