"""Which parents of a kind hold a placement at all: windows of a storey have blinds, those of another have none.

Where parents stand among their like in a larger polygon, as windows do on a facade, examples tell more than what a
placement looks like within its parent. What people place within some of many parents they place by rows: a row with
fewer examples than its share of the parents speaks against those in it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from .arrangement import Arrangement, arrangement_of

Array = NDArray[np.float64]

#: Shared height over the smaller height from which two parents stand in one row.
ONE_ROW = 0.5
#: Examples that every row has before any is drawn: half an observation, as little as says nothing (Jeffreys).
UNSEEN = 0.5
#: Power of the share of examples over the share of parents by which odds are multiplied: the rate at which parents of a
#: row hold one, and once more since whoever draws examples draws them where more are meant.
RATE_POWER = 2.0


@dataclass(frozen=True)
class Standing:
    """Where the parent of an example stands among its like.

    Attributes
    ----------
    among : str
        Fingerprint of the arrangement below the polygon that holds the parent.
    box : ndarray of shape (4,)
        The parent in the frame of that arrangement.
    """

    among: str
    box: Array

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON."""
        return {"among": self.among, "box": self.box.tolist()}

    @classmethod
    def from_dict(cls, plain: dict[str, Any]) -> "Standing":
        """The inverse of `to_dict`."""
        return cls(plain["among"], np.array(plain["box"], dtype=np.float64))


def _around(scene: Scene, holder: Polygon) -> Arrangement:
    return arrangement_of(scene, holder, holder.main_orientation)


def standing_of(scene: Scene, parent: Polygon) -> Standing | None:
    """Where a parent stands in the polygon that holds it; None where nothing does.

    Parameters
    ----------
    scene : Scene
    parent : Polygon

    Returns
    -------
    Standing or None
    """
    holder = scene.parent(str(parent.id))
    if holder is None:
        return None
    around = _around(scene, holder)
    return Standing(around.fingerprint, around.box_of(parent))


def row_odds(scene: Scene, label: str, standings: Sequence[Standing]) -> dict[str, float]:
    """What the rows of parents say against placements in them.

    Parameters
    ----------
    scene : Scene
    label : str
        Of the parents.
    standings : sequence of Standing
        Of the parents of positive examples, one for each example.

    Returns
    -------
    dict of str to float
        By the id of the parent, the logarithm of the factor of the odds: not above 0, and only where it is below. It
        says nothing where no example was drawn.
    """
    known = {s.among for s in standings}
    if not known:
        return {}
    found: dict[str, float] = {}
    holders = {str(p.id): p for q in scene.polygons if q.label == label and (p := scene.parent(str(q.id))) is not None}
    for holder in holders.values():
        around = _around(scene, holder)
        if around.fingerprint not in known:
            continue
        siblings = [p for p in around.members if p.label == label]
        boxes = np.array([around.box_of(p) for p in siblings])
        drawn = np.array([s.box for s in standings if s.among == around.fingerprint])
        share, count = _in_one_row(boxes, boxes).mean(axis=1), _in_one_row(boxes, drawn).sum(axis=1)
        rate = (count + UNSEEN) / (share * len(drawn) + UNSEEN)
        for sibling, value in zip(siblings, RATE_POWER * np.log(rate), strict=True):
            if value < 0:
                found[str(sibling.id)] = found.get(str(sibling.id), 0.0) + float(value)
    return found


def _in_one_row(a: Array, b: Array) -> NDArray[np.bool_]:
    """Whether each two boxes stand in one row, shape (n, m): rooms of one storey do, be they large or small."""
    low, high = np.maximum(a[:, None, 1], b[None, :, 1]), np.minimum(a[:, None, 3], b[None, :, 3])
    return high - low >= ONE_ROW * np.minimum((a[:, 3] - a[:, 1])[:, None], (b[:, 3] - b[:, 1])[None])
