"""Probabilistic placement (section 4.8)."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..poses.scatter import ScatterModel
from ..progress import Stepper
from .element import Element
from .layout import Layout
from .placing import PlacingOne, elements_of, read_by, with_distinct_keys
from .settings import stored, whole


@dataclass(frozen=True, kw_only=True)
class ScatterPlacement(PlacingOne):
    """Put copies of a library object where chance falls, likelier where they answer the example better.

    Attributes
    ----------
    model : ScatterModel
        The example, and how many are drawn.
    seed : int
        For another draw of this operation alone.
    """

    type = "scatter"
    random = True

    model: ScatterModel = field(metadata=stored(ScatterModel.from_dict, ScatterModel.to_dict))
    seed: int = field(default=0, metadata=stored(whole))

    @property
    def footprint(self) -> NDArray[np.float64] | None:
        """The example's footprint."""
        return self.model.model.footprint

    @property
    def places_in(self) -> frozenset[str]:
        """The label of the polygons that the example is in."""
        return frozenset({self.model.model.parent.label})

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[tuple[Element, ...]]:
        """Draw poses."""
        drawn = yield from self.model.steps(layout.scene, seed ^ self.seed)
        found = elements_of(drawn, self.model.model, self.mesh, self.label, node, layout.scene)
        return with_distinct_keys(found)

    def reads(self, layout: Layout) -> list[Polygon]:
        """The parents like the example's, and what stands in them."""
        return read_by([self.model.model], layout.scene)
