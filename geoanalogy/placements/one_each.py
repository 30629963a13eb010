"""Where every parent holds one placement: rooms with their fixtures, plots with their buildings.

Such parents are variations of each other, often mirrored or turned, and drawn in different scales; what is kept is
rather a share of the parent than a length. Each example says where the placement would be in a parent that is a
stretched copy of its own, in all eight ways to lay one rectangle on another; the examples together say which of these
is meant.
"""

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from .arrangement import PARENT, Arrangement
from .boxes import union_overlap
from .candidates import crossings, extents
from .lesson import Lesson
from .signature import BOX, PARENT_BOX, Signature
from .turns import TURNS, in_units, parent_shares, parent_sizes, turned_boxes, turned_shares

Array = NDArray[np.float64]

#: The figures of a candidate in a parent that holds one placement, in the order of their columns.
ONE_EACH = (
    "relative similarity",  # to the most similar example, lengths in shares of the parents' sizes
    "mean relative similarity",
    "turned similarity",  # the same, in the best of the eight turns for each example
    "mean turned similarity",
    "relative habit",
    "turned habit",
    "copy overlap",  # overlap with the examples' boxes copied by shares of the parent: the mean
    "best copy overlap",
    "like copy overlap",  # the more alike the parents the more they count
    "turned copy overlap",
    "best turned copy overlap",
    "like turned copy overlap",
    "middle overlap",  # overlap with the middle of the copies
    "turned middle overlap",
    "relative size",  # logarithmic difference in size, in shares of the parent's, to the example most alike
    "nearer",  # nearer to an element of some label than any example
    "freed",  # farther from an element of some label than any example
    "off walls",  # fewer corners on the parent's outline than any example has
)

#: Elements of one label up to which they are turned with the parent: a room has few doors, a facade many windows.
MOST_TURNED = 6
#: Distance to the parent's outline, in shares of the parent's size, at which a corner is hardly on it.
BESIDE = 0.03


def copies(lesson: Lesson, arrangement: Arrangement) -> Array:
    """Candidates from copies of the examples' parents.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
        The target.

    Returns
    -------
    ndarray of shape (n, 4)
        In the arrangement's frame.
    """
    low, size = arrangement.parent_box[:2], arrangement.parent_box[2:] - arrangement.parent_box[:2]
    shares = parent_shares(lesson.kept, lesson.positive)
    shares = np.concatenate([shares, middles(shares)])
    found = [np.tile(low, 2) + np.tile(size, 2) * turned_shares(shares, turn) for turn in TURNS]
    unit = float(np.sqrt(size.prod()))
    relative = lesson.relative.kept.boxes
    groups = {PARENT_BOX: arrangement.parent_box[None]} | {
        BOX + label: arrangement.drawn[label] for label in lesson.labels if label in arrangement.drawn
    }
    for key, elements in groups.items():
        values = relative[key][lesson.positive, 0]
        values = values[np.isfinite(values[:, 0, 0, 0])].copy()
        values[..., :3] *= unit
        for turn in TURNS if len(elements) <= MOST_TURNED else TURNS[:1]:
            there = turned_boxes(values, turn)
            x, y = (extents(there[:, axis], elements[:, axis], elements[:, axis + 2]) for axis in (0, 1))
            found.append(crossings(x, y))
    return np.concatenate(found)


def middles(shares: Array) -> Array:
    """For each of some boxes in the unit square, the median of all as far as turns bring them near it.

    Parameters
    ----------
    shares : ndarray of shape (m, 4)

    Returns
    -------
    ndarray of shape (2 m, 4)
        Of the boxes as they are, and of their turned copies.
    """
    ways = np.stack([turned_shares(shares, turn) for turn in TURNS], axis=1)  # box, turn
    off = np.abs(ways[None] - shares[:, None, None]).sum(axis=3)
    # A turn is worth its while only where it brings a box nearer by a good part.
    nearest = np.argmin(off, axis=2)
    brought = ways[np.arange(len(shares))[None], nearest]
    return np.concatenate([np.repeat(np.median(shares, axis=0)[None], len(shares), 0), np.median(brought, axis=1)])


def copy_evidence(
    lesson: Lesson, arrangement: Arrangement, boxes: Array, seen: Signature, like: Array, neighbours: int
) -> Array:
    """The figures of `ONE_EACH`.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)
    seen : Signature
        Of the boxes.
    like : ndarray of shape (m,)
        How much each positive example counts, by the proportions of its parent; the sum is 1.
    neighbours : int
        How many of the nearest elements of every label are in the feature vectors.

    Returns
    -------
    ndarray of shape (n, len(ONE_EACH))
    """
    p = lesson.positive
    size = arrangement.parent_box[2:] - arrangement.parent_box[:2]
    unit = float(np.sqrt(size.prod()))
    relative = in_units(seen, unit)
    whole = lesson.relative
    # A quick look is at boxes alone: outlines in eight turns would cost more than all the rest.
    view = relative if neighbours > 1 else Signature(relative.boxes, {})
    similar = whole.turned_similarities(view, neighbours)[:, :, p]
    habit = whole.habits.turned(view)
    shares = (boxes - np.tile(arrangement.parent_box[:2], 2)) / np.tile(size, 2)
    taught = parent_shares(lesson.kept, p)
    overlaps = np.stack([union_overlap(shares, turned_shares(taught, turn)) for turn in TURNS])
    central = middles(taught)
    middle = union_overlap(shares, central[:1])[:, 0]
    turned_middle = np.stack([union_overlap(shares, turned_shares(central, turn)) for turn in TURNS]).max(axis=(0, 2))
    extent = np.log(boxes[:, 2:] - boxes[:, :2]) - np.log(unit)
    taught_extent = np.log(whole.sizes[p])
    stretch = np.abs(extent[:, None] - taught_extent[None]).sum(axis=2)
    swapped = np.abs(extent[:, None] - taught_extent[None, :, ::-1]).sum(axis=2)
    nearer, freed = _clearances(lesson, arrangement, boxes, unit)
    figures = {
        "relative similarity": similar[0].max(axis=1),
        "mean relative similarity": similar[0].mean(axis=1),
        "turned similarity": similar.max(axis=(0, 2)),
        "mean turned similarity": similar.max(axis=0).mean(axis=1),
        "relative habit": habit[0],
        "turned habit": habit.max(axis=0),
        "copy overlap": overlaps[0].mean(axis=1),
        "best copy overlap": overlaps[0].max(axis=1),
        "like copy overlap": overlaps[0] @ like,
        "turned copy overlap": overlaps.max(axis=0).mean(axis=1),
        "best turned copy overlap": overlaps.max(axis=(0, 2)),
        "like turned copy overlap": overlaps.max(axis=0) @ like,
        "middle overlap": middle,
        "turned middle overlap": turned_middle,
        "relative size": np.minimum(np.minimum(stretch, swapped).min(axis=1), 2.0),
        "nearer": nearer,
        "freed": freed,
        "off walls": _off_walls(lesson, seen),
    }
    return np.stack([figures[name] for name in ONE_EACH], axis=1)


def _clearances(lesson: Lesson, arrangement: Arrangement, boxes: Array, unit: float) -> tuple[Array, Array]:
    """By how much boxes are nearer to, and farther from, elements of each label than any example; sums over labels.

    Gaps in shares of the parent's size; the gap of what overlaps is 0.
    """
    nearer, freed = np.zeros(len(boxes)), np.zeros(len(boxes))
    kept = lesson.relative.kept.boxes
    for label, elements in arrangement.drawn.items():
        values = kept.get(BOX + label)
        if values is None:
            continue
        taught = values[lesson.positive, 0]
        taught = taught[np.isfinite(taught[:, 0, 0, 0])]
        if not len(taught):
            continue
        # Of each axis the gap is how far the low edge is beyond the maximum, or the high edge before the minimum.
        apart = np.maximum(np.maximum(taught[:, :, 0, 1], -taught[:, :, 2, 0]), 0.0)
        known = np.hypot(*apart.T)
        way = np.maximum(
            np.maximum(elements[None, :, :2] - boxes[:, None, 2:], boxes[:, None, :2] - elements[None, :, 2:]), 0.0
        )
        gap = np.hypot(way[..., 0], way[..., 1]).min(axis=1) / unit
        nearer += np.maximum(known.min() - gap, 0.0)
        freed += np.maximum(gap - known.max(), 0.0)
    return np.minimum(nearer, 1.0), np.minimum(freed, 1.0)


def _off_walls(lesson: Lesson, seen: Signature) -> Array:
    """By how much fewer corners than those of any example lie on the parent's outline, as a share of four."""
    return np.maximum(_on_walls(lesson.kept.rows(lesson.positive)).min() - _on_walls(seen), 0.0) / 4


def _on_walls(seen: Signature) -> Array:
    """How many corners of boxes lie on the parent's outline, those nearly on it in part."""
    away = seen.outlines[f"{ElementType.POLYGON.value}s of {PARENT}"][:, 0, :4, 0]
    unit = np.sqrt(parent_sizes(seen).prod(axis=1))[:, None]
    return np.exp(-0.5 * (away / unit / BESIDE) ** 2).sum(axis=1)
