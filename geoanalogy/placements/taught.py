"""What a model keeps of one example."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.rectangle import Rectangle
from .arrangement import Arrangement
from .boxes import areas, shared_areas
from .options import PlacementOptions
from .siblings import Standing
from .signature import Signature, signature

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Taught:
    """One example, as a model keeps it: without its scene.

    Attributes
    ----------
    rectangle : Rectangle
        In the example's scene.
    size : ndarray of shape (2,)
        Its extent along the frame's axes.
    quarter : int
        Quarter turns from the frame to its direction.
    target : float
    fingerprint : str
        Of the arrangement it was drawn in.
    outside : float
        Share of it that lies outside its parent.
    covered, touched : dict of str to float
        By label: the share of it that elements cover, and the largest share of one element that it covers.
    standing : Standing or None
        Where its parent stands among its like.
    """

    rectangle: Rectangle
    size: Array
    quarter: int
    target: float
    fingerprint: str
    outside: float
    covered: dict[str, float]
    touched: dict[str, float]
    standing: Standing | None = None

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON."""
        r = self.rectangle
        return {
            "rectangle": [r.x, r.y, r.width, r.height, r.angle],
            "size": self.size.tolist(),
            "quarter": self.quarter,
            "target": self.target,
            "fingerprint": self.fingerprint,
            "outside": self.outside,
            "covered": self.covered,
            "touched": self.touched,
            "standing": self.standing and self.standing.to_dict(),
        }

    @classmethod
    def from_dict(cls, plain: dict[str, Any]) -> "Taught":
        """The inverse of `to_dict`."""
        standing = plain.get("standing")
        return cls(
            **{
                **plain,
                "rectangle": Rectangle(*plain["rectangle"]),
                "size": np.array(plain["size"], dtype=np.float64),
                "standing": None if standing is None else Standing.from_dict(standing),
            }
        )


def coverage(arrangement: Arrangement, boxes: Array) -> tuple[dict[str, Array], dict[str, Array]]:
    """How boxes overlap the drawn elements of every label.

    Parameters
    ----------
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)

    Returns
    -------
    covered : dict of str to ndarray of shape (n,)
        Share of the box that lies under elements of the label (at most 1).
    touched : dict of str to ndarray of shape (n,)
        Largest share of a single element that lies under the box.
    """
    covered, touched = {}, {}
    own = areas(boxes)
    for label, elements in arrangement.drawn.items():
        shared = shared_areas(boxes, elements)
        covered[label] = np.minimum(shared.sum(axis=1) / own, 1.0)
        touched[label] = np.minimum((shared / areas(elements)[None]).max(axis=1), 1.0)
    return covered, touched


def teach(
    arrangement: Arrangement,
    drawn: Sequence[tuple[Rectangle, float]],
    options: PlacementOptions,
    standing: Standing | None = None,
) -> list[tuple[Taught, Signature]]:
    """What is kept of the examples that were drawn in one arrangement.

    Parameters
    ----------
    arrangement : Arrangement
    drawn : sequence of (Rectangle, float)
        With the target of each.
    options : PlacementOptions
    standing : Standing, optional
        Of the arrangement's parent.

    Returns
    -------
    list of (Taught, Signature)
        In the same order; each signature has one row.
    """
    laid = [rectangle.box(arrangement.frame) for rectangle, _ in drawn]
    boxes = np.array([box for box, _ in laid])
    covered, touched = coverage(arrangement, boxes)
    outside = arrangement.share_outside(boxes)
    seen = signature(arrangement, boxes, options.neighbours)
    return [
        (
            Taught(
                rectangle,
                box[2:] - box[:2],
                quarter,
                target,
                arrangement.fingerprint,
                float(outside[i]),
                {label: float(v[i]) for label, v in covered.items()},
                {label: float(v[i]) for label, v in touched.items()},
                standing,
            ),
            seen.rows([i]),
        )
        for i, ((rectangle, target), (box, quarter)) in enumerate(zip(drawn, laid, strict=True))
    ]
