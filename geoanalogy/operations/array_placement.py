"""Arrays of objects (section 4.8)."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..poses.arrays import ArrayModel
from ..progress import Stepper
from .element import Element, plain_ring
from .keys import key_of
from .layout import Layout
from .placing import PlacingOne, read_by, with_distinct_keys
from .settings import number, stored


@dataclass(frozen=True, kw_only=True)
class ArrayPlacement(PlacingOne):
    """Put copies of a library object along the offset boundaries of polygons.

    Attributes
    ----------
    model : ArrayModel
        Start, end and spacing.
    threshold : float
        Arrays below this importance are not placed; the model's own threshold bounds it from below.
    """

    type = "array"

    model: ArrayModel = field(metadata=stored(ArrayModel.from_dict, ArrayModel.to_dict))
    threshold: float = field(default=0.0, metadata=stored(number, late=True))

    @property
    def footprint(self) -> NDArray[np.float64] | None:
        """The first object's footprint."""
        return self.model.start.footprint

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[tuple[Element, ...]]:
        """Propagate starts and ends, and place objects along the paths between them."""
        arrays = yield from self.model.steps(layout.scene)
        ring = plain_ring(self.footprint)
        own = self.model.start.pose
        found = []
        for array in arrays:
            for pose in array.poses:
                first = array.example and pose.position == own.position
                found.append(
                    Element(
                        self.label,
                        self.mesh,
                        str(array.parent.id),
                        own if first else pose,
                        ring,
                        node,
                        key_of(pose.position, array.parent),
                        scale=array.scale,
                        importance=array.importance,
                        example=first,
                    )
                )
        return with_distinct_keys(found)

    def chosen(self, results: Sequence[Element], examples: Sequence[Element], layout: Layout) -> Sequence[Element]:
        """The objects of arrays above the threshold."""
        return [e for e in results if e.importance >= self.threshold]

    def reads(self, layout: Layout) -> list[Polygon]:
        """The parents like those of the start and the end, and what stands in them."""
        models = [self.model.start] if self.model.end is None else [self.model.start, self.model.end]
        return read_by(models, layout.scene)
