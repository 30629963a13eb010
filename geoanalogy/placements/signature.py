"""The relations of boxes to what surrounds them: the feature vectors of sections 5.2 and 5.3.

A box is sampled at its four corners and its centre. Relations are taken to the nearest few elements of every label:
a facade has hundreds, and those far away agree or differ by chance.

Box coordinates are separable: of the five samples, two share the left edge, two the right one, and one is the centre,
and so for the edges below and above. They are therefore kept per axis for three positions (low, middle, high), which
count 2, 1 and 2.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import Elements, ElementType
from ..relations.observation import Observation
from ..relations.table import RELATIONS, Kind
from .arrangement import Arrangement
from .boxes import distances

Array = NDArray[np.float64]

#: How many of the five samples lie at the low edge, in the middle and at the high edge of an axis.
SAMPLE_COUNTS = np.array([2.0, 1.0, 2.0])

#: The four box coordinates along an axis, in the order of their last dimension.
BOX_COORDINATES = ("box minimum", "box maximum", "box centre", "box share")

#: The relations of outlines by element type.
OUTLINE_RELATIONS: dict[ElementType, tuple[str, ...]] = {
    ElementType.POLYGON: ("boundary distance",),
    ElementType.SEGMENT: ("segment distance", "segment arc length"),
    ElementType.CORNER: ("corner distance", "corner ratio"),
}

#: Share by which distances must differ for one of two elements to be the nearer one.
EQUALLY_FAR = 1e-6

#: Key of the group of the parent's own box.
PARENT_BOX = "parent's box"
#: Prefix of the groups of boxes.
BOX = "box of "


@dataclass(frozen=True)
class Signature:
    """Feature vectors of n boxes, by group of elements; only elements of the same group are compared.

    Attributes
    ----------
    boxes : dict of str to ndarray of shape (n, k, 2, 3, 4)
        Box, nearest elements of one label, axis, position (low, middle, high), box coordinate; NaN where the label has
        fewer than k elements (the nil elements of section 5.3).
    outlines : dict of str to ndarray of shape (n, k, 5, r)
        Box, nearest elements, sample, relation of `OUTLINE_RELATIONS`.
    """

    boxes: dict[str, Array]
    outlines: dict[str, Array]

    def rows(self, index: Sequence[int] | NDArray[np.intp]) -> "Signature":
        """The signature of some of the boxes.

        Parameters
        ----------
        index : sequence of int

        Returns
        -------
        Signature
        """
        at = np.asarray(index, dtype=np.intp)
        return Signature(
            {key: value[at] for key, value in self.boxes.items()},
            {key: value[at] for key, value in self.outlines.items()},
        )

    def distinct(self, key: str, axis: int) -> tuple[NDArray[np.intp] | slice, NDArray[np.intp] | slice]:
        """Which boxes differ in their coordinates along an axis, relative to the elements of one group.

        Candidates are crossings of extents, and most share theirs along an axis with others: there is a tenth as many
        extents as boxes.

        Parameters
        ----------
        key : str
            Of a group of boxes.
        axis : int

        Returns
        -------
        first : ndarray of int, or slice
            One box of each kind; all where telling them apart is as much work as they are.
        kind : ndarray of shape (n,) of int, or slice
            Of every box.
        """
        if (key, axis) not in self._distinct:
            self._distinct[key, axis] = _kinds(self.boxes[key][:, :, axis])
        return self._distinct[key, axis]

    @cached_property
    def _distinct(self) -> dict[tuple[str, int], tuple[NDArray[np.intp] | slice, NDArray[np.intp] | slice]]:
        return {}


#: Boxes below which all are compared.
FEW_BOXES = 64


def _kinds(values: Array) -> tuple[NDArray[np.intp] | slice, NDArray[np.intp] | slice]:
    """The first of the equal rows of coordinates (n, k, 3, 4), and which of these each row equals."""
    if values.shape[1] > 1 or len(values) < FEW_BOXES:
        return slice(None), slice(None)
    kind = np.zeros(len(values), dtype=np.intp)
    # From the element's minimum, and its extent: the other coordinates follow.
    for column in (values[:, 0, 0, 0], values[:, 0, 2, 0], values[:, 0, 0, 1]):
        known, number = np.unique(column, return_inverse=True)
        kind = kind * len(known) + number.ravel()
    _, first, kind = np.unique(kind, return_index=True, return_inverse=True)
    return first, kind.ravel()


def box_coordinates(boxes: Array, elements: Array) -> Array:
    """The box relations of section 5.3 between boxes and their own elements.

    The table of relations evaluates every element at every point; here each box meets only the few elements that are
    nearest to it. The values are those of the table.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
    elements : ndarray of shape (n, k, 4)

    Returns
    -------
    ndarray of shape (n, k, 2, 3, 4)
        By axis, position on the box and coordinate (from the minimum, the maximum, the centre; as a share).
    """
    position = np.stack([boxes[:, :2], (boxes[:, :2] + boxes[:, 2:]) / 2, boxes[:, 2:]], axis=2)[:, None]
    low, high = elements[:, :, :2, None], elements[:, :, 2:, None]
    from_low = position - low
    return np.stack([from_low, position - high, position - (low + high) / 2, from_low / (high - low)], axis=-1)


def nearest(boxes: Array, elements: Array, count: int) -> Array:
    """The elements nearest to each box, NaN where there are fewer than asked for.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
    elements : ndarray of shape (e, 4)
    count : int

    Returns
    -------
    ndarray of shape (n, count, 4)
    """
    far = distances(boxes, elements)
    most = min(count, len(elements))
    found = np.full((len(boxes), count, 4), np.nan)
    if most < len(elements):
        order = np.argpartition(far, most, axis=1)[:, : most + 1]
        order = np.take_along_axis(order, np.argsort(np.take_along_axis(far, order, 1), axis=1, kind="stable"), 1)
        reach = np.take_along_axis(far, order, 1)
        # Of two that are equally far only one would count, by an accident of order: neither does.
        tied = reach[:, :most] >= reach[:, most:] * (1 - EQUALLY_FAR)
        tied[:, 0] = False
        found[:] = np.where(tied[..., None], np.nan, elements[order[:, :most]])
    else:
        found[:, :most] = elements[np.argsort(far, axis=1, kind="stable")]
    return found


def samples(boxes: Array) -> Array:
    """The five samples of each box: the corners counter-clockwise from the least one, and the centre; (n, 5, 2).

    Parameters
    ----------
    boxes : ndarray

    Returns
    -------
    ndarray
    """
    x0, y0, x1, y1 = boxes.T
    return np.stack(
        [
            np.stack([x0, y0], 1),
            np.stack([x1, y0], 1),
            np.stack([x1, y1], 1),
            np.stack([x0, y1], 1),
            (boxes[:, :2] + boxes[:, 2:]) / 2,
        ],
        axis=1,
    )


def signature(
    arrangement: Arrangement, boxes: Array, neighbours: int, labels: Sequence[str] | None = None, outlines: bool = True
) -> Signature:
    """The feature vectors of boxes in an arrangement.

    Parameters
    ----------
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)
        In the arrangement's frame.
    neighbours : int
        Elements of every label that count: the nearest ones.
    labels : sequence of str, optional
        Only elements of these labels; None: all.
    outlines : bool
        Whether relations to segments, corners and boundaries are evaluated.

    Returns
    -------
    Signature
    """
    of_boxes = {PARENT_BOX: box_coordinates(boxes, np.broadcast_to(arrangement.parent_box, (len(boxes), 1, 4)))}
    for label, elements in arrangement.boxes.items():
        if labels is None or label in labels:
            of_boxes[BOX + label] = box_coordinates(boxes, nearest(boxes, elements, neighbours))
    of_outlines: dict[str, Array] = {}
    if outlines:
        points = arrangement.unturned(samples(boxes)).reshape(-1, 2)
        for role, elements_of in arrangement.outlines.items():
            of_outlines |= _outline_relations(role, elements_of, points, neighbours)
    return Signature(of_boxes, of_outlines)


def _outline_relations(role: str, elements: Elements, points: Array, neighbours: int) -> dict[str, Array]:
    """Relations to the nearest segments (by label), corners and boundaries of one role, by group."""
    seen = Observation(elements, points)
    found = {}
    for element, names in OUTLINE_RELATIONS.items():
        if not elements.count(element):
            continue
        values = np.stack([RELATIONS[name].value(seen) for name in names], axis=-1)
        values = values.reshape(len(values), -1, 5, len(names)).transpose(1, 0, 2, 3)  # box, element, sample, relation
        labels = elements.segment_label if element is ElementType.SEGMENT else ("",) * values.shape[1]
        for label in sorted(set(labels)):
            some = values[:, [i for i, name in enumerate(labels) if name == label]]
            # By the distance of the nearest sample, then of the centre: opposite corners of a box are ties otherwise.
            near = some[..., 0].min(axis=2) + 0.25 * some[:, :, 4, 0]
            order = np.argsort(near, axis=1, kind="stable")[:, :neighbours]
            kept = np.full((len(some), neighbours, 5, len(names)), np.nan)
            kept[:, : order.shape[1]] = np.take_along_axis(some, order[:, :, None, None], axis=1)
            found[f"{element.value}s of {role}" + (f" ({label})" if label else "")] = kept
    return found


def outline_kinds(key: str) -> tuple[tuple[Kind, ...], tuple[float, ...]]:
    """What the relations of an outline group are, and after what value they repeat.

    Parameters
    ----------
    key : str
        The group's key.

    Returns
    -------
    kinds : tuple of Kind
    periods : tuple of float
        inf where values never wrap.
    """
    names = outline_relations_of(key)
    # A closed segment's arc length wraps; that of an open one does not, and a smooth closed ring has nothing else.
    periods = tuple(2.0 if name == "corner ratio" else np.inf for name in names)
    return tuple(RELATIONS[name].kind for name in names), periods


def outline_relations_of(key: str) -> tuple[str, ...]:
    """Names of the relations of an outline group, in the order of their last dimension.

    Parameters
    ----------
    key : str
        The group's key.

    Returns
    -------
    tuple of str
    """
    return OUTLINE_RELATIONS[next(e for e in OUTLINE_RELATIONS if key.startswith(f"{e.value}s of "))]
