"""What a set of examples has in common: weights of relations and similarities among the examples."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .boxes import BETWEEN, TOUCHING
from .habits import Habits
from .options import PlacementOptions
from .signature import BOX, PARENT_BOX, SAMPLE_COUNTS, Signature
from .similarity import axis_agreement, best_assignment, box_agreement, length_widths, outline_agreement
from .taught import Taught
from .turns import TURNS, flipped, in_units, parent_sizes, turned_outlines

Array = NDArray[np.float64]

#: How sure one is of a relation that a single example shows: what examples share beyond chance, seen on real facades.
PRIOR_RELIABILITY = 0.7


#: Share of the positive examples that must lie between two elements for their gap to be one: there are as many kinds of
#: gaps as pairs of labels, and most mean nothing.
LEAST_BETWEEN = 0.75


#: Share of its weight that a relation keeps which tells examples and counter-examples not apart at all.
LEAST_APART = 0.02


@dataclass(frozen=True)
class Match:
    """How the elements of one group around boxes agree with those around examples.

    Attributes
    ----------
    total : ndarray of shape (n, m)
        Utility of the best assignment (eq. 5.4), weighted.
    along_x, along_y : ndarray of shape (n, m)
        Agreement with the element nearest to the example along each axis, 0 to 1; of outlines that in both at once.
    of_boxes : bool
        Whether the group is one of boxes.
    joint : ndarray of shape (n, m)
        Of both axes at once with one element, 0 to 1.
    """

    total: Array
    along_x: Array
    along_y: Array
    joint: Array
    of_boxes: bool


class Lesson:
    """What is learned from the examples; everything follows from what is kept of each.

    Parameters
    ----------
    taught : list of Taught
    kept : Signature
        Feature vectors of the examples, in the same order.
    options : PlacementOptions
    contrasting : bool
        Whether only that counts which tells positive examples and counter-examples apart.
    """

    def __init__(
        self, taught: list[Taught], kept: Signature, options: PlacementOptions, contrasting: bool = False
    ) -> None:
        self.taught = taught
        self.kept = kept
        self.options = options
        self.contrasting = contrasting
        self.targets = np.array([t.target for t in taught])
        self.positive = np.flatnonzero(self.targets > 0)
        self.negative = np.flatnonzero(self.targets == 0)
        self.sizes = np.array([t.size for t in taught])
        self.widths = length_widths(self.sizes[self.positive], options.tau)

    @classmethod
    def of(cls, taught: list[Taught], kept: list[Signature], options: PlacementOptions) -> "Lesson":
        """A lesson from the signatures of single examples, which may have seen different labels.

        Parameters
        ----------
        taught : list of Taught
        kept : list of Signature
            One row each.
        options : PlacementOptions

        Returns
        -------
        Lesson
        """
        boxes = _side_by_side([k.boxes for k in kept])
        positive = np.array([t.target > 0 for t in taught])
        for key in [k for k in boxes if k.startswith(BOX + BETWEEN)]:
            if not options.between or _lies_within(boxes[key][positive, 0]).mean() < LEAST_BETWEEN:
                del boxes[key]
        return cls(taught, Signature(boxes, _side_by_side([k.outlines for k in kept])), options)

    @cached_property
    def labels(self) -> list[str]:
        """Labels of the elements and gaps that were seen around examples."""
        return [key.removeprefix(BOX) for key in self.kept.boxes if key != PARENT_BOX]

    @cached_property
    def weights(self) -> dict[str, Array]:
        """Weight of every relation of every example, by group, in the shape of what is kept of the group.

        The samples it counts for, times how well the counterparts around the other positive examples agree in it: the
        better half of them, for there may be two kinds of examples. A relation in which they differ is no part of what
        they have in common (figure 5.11), one in which they agree keeps its whole weight; the distances to one wall can
        matter and those to another not. With a single example all keep theirs.
        """
        half = len(self.positive) // 2  # of the others, rounded up
        found = {}
        for key, values in (self.kept.boxes | self.kept.outlines).items():
            found[key] = self._counts(key, values) * self.agreement(key, max(half, 1))
            if self.contrasting:
                found[key] *= self._apart(key)
        return found

    @cached_property
    def contrast(self) -> "Lesson":
        """The same lesson, in which relations count by how well they tell examples from counter-examples.

        What both have in common, however many relations that are, says nothing of which of them a placement is like;
        itself where there are no counter-examples.
        """
        return Lesson(self.taught, self.kept, self.options, contrasting=True) if len(self.negative) else self

    def _apart(self, key: str) -> Array:
        """How badly every relation of every example agrees with its counterparts around the examples of the other sign.

        In the shape of what is kept of the group; never nothing, so that examples that are all alike stay alike.
        """
        values = (self.kept.boxes | self.kept.outlines)[key]
        apart = np.ones_like(values)
        for own, others in ((self.targets > 0, self.negative), (self.targets == 0, self.positive)):
            apart[own] -= self._agreement_with(key, others)[own].max(axis=1)
        return np.maximum(apart, LEAST_APART)

    def agreement(self, key: str, most: int) -> Array:
        """How well every relation of every example agrees with its counterparts around the other positive examples.

        Parameters
        ----------
        key : str
            Of the group.
        most : int
            Only so many of the others count, for each relation those that agree best.

        Returns
        -------
        ndarray in the shape of what is kept of the group
            Between 0 and 1; 1 where there are no others.
        """
        values = (self.kept.boxes | self.kept.outlines)[key]
        p = self.positive
        if len(p) < 2:
            return np.ones_like(values)
        matched = self._agreement_with(key, p)
        matched[np.arange(len(values))[:, None] == p[None]] = -1.0
        return np.sort(matched, axis=1)[:, -min(most, len(p) - 1) :].mean(axis=1)

    def _agreement_with(self, key: str, others: NDArray[np.intp]) -> NDArray[Any]:
        """Agreement of every relation of every example with its counterpart around some of the examples: (m, k, …)."""
        values = (self.kept.boxes | self.kept.outlines)[key]
        agreement = self._agreement(key, values, values[others])
        rest = _REST[values.ndim]
        utility = np.einsum(f"nmpq{rest},{rest}->nmpq", agreement, self._counts(key, values))
        column = best_assignment(utility.astype(np.float64))[1]
        index = column.reshape(*column.shape, 1, *(1,) * (agreement.ndim - 4))
        return np.take_along_axis(agreement, index, axis=3)[:, :, :, 0]

    def _counts(self, key: str, values: Array) -> Array:
        """How many samples each relation of a group stands for, as a share of all samples."""
        if key in self.kept.boxes:
            return np.broadcast_to((SAMPLE_COUNTS / SAMPLE_COUNTS.sum())[None, :, None], (2, 3, 4)).copy()
        return np.full(values.shape[2:], 1.0 / values.shape[2])

    def _agreement(self, key: str, a: Array, b: Array) -> NDArray[Any]:
        if key in self.kept.boxes:
            return box_agreement(a, b, self.widths, self.options.tau)
        return outline_agreement(key, a, b, self.widths, self.options.tau)

    def match(self, seen: Signature, neighbours: int | None = None) -> dict[str, Match]:
        """Agreement of boxes with every example, group by group.

        Parameters
        ----------
        seen : Signature
            Of n boxes.
        neighbours : int, optional
            Only the nearest few elements of each example count; None: all that are kept.

        Returns
        -------
        dict of str to Match
            For every group of the examples; nothing agrees with a group that the boxes do not see. Outlines are left
            out where the boxes' signature has none.
        """
        found = {}
        for key, values in (self.kept.boxes | self.kept.outlines).items():
            if key in self.kept.outlines and not seen.outlines:
                continue
            kept = values[:, :neighbours]
            there = seen.boxes.get(key, seen.outlines.get(key))
            if there is None:
                nothing = np.zeros((len(seen.boxes[PARENT_BOX]), len(values)))
                found[key] = Match(nothing, nothing, nothing, nothing, key in self.kept.boxes)
                continue
            weight = self._weights32[key][:, :neighbours]
            if key in self.kept.boxes:
                along = []
                for axis in (0, 1):
                    first, kind = seen.distinct(key, axis)
                    along.append(self._along(key, there[first, :, axis], axis, neighbours)[kind])
                whole = np.maximum(weight.sum(axis=(3, 4)).transpose(2, 0, 1), 1e-9)  # axis, example, element
                x, y = (along[axis][..., 0] / whole[axis, :, 0][:, None] for axis in (0, 1))
                found[key] = Match(
                    best_assignment(along[0] + along[1])[0].astype(np.float64),
                    x.max(axis=2).astype(np.float64),
                    y.max(axis=2).astype(np.float64),
                    (x * y).max(axis=2).astype(np.float64),
                    True,
                )
            else:
                total = self._outline_total(key, there, neighbours)
                there = np.isfinite(kept[:, :, 0, 0])
                whole = np.maximum((weight.sum(axis=(2, 3)) * there).sum(axis=1), 1e-9)
                share = np.minimum(total / whole, 1.0)
                found[key] = Match(total, share, share, share, False)
        return found

    def _along(self, key: str, values: Array, axis: int, neighbours: int | None) -> NDArray[Any]:
        """Weighted agreement (n, m, p, q) of coordinates (n, p, 3, 4) with those of all examples along one axis."""
        kept, weights = self.kept.boxes[key][:, :neighbours, axis], self._weights32[key][:, :neighbours, axis]
        agreement = axis_agreement(values, kept, self.widths[axis], self.options.tau)
        # Positions and coordinates as one dimension: a longer innermost sum.
        count = weights.shape[2] * weights.shape[3]
        flat = agreement.reshape(*agreement.shape[:4], count)
        return np.asarray(np.einsum("nmpqk,mqk->nmpq", flat, weights.reshape(*weights.shape[:2], count)))

    @cached_property
    def _weights32(self) -> dict[str, NDArray[Any]]:
        return {key: weight.astype(np.float32) for key, weight in self.weights.items()}

    def turned_similarities(self, seen: Signature, neighbours: int) -> Array:
        """`similarities` of boxes with all examples, in all eight turns of what surrounds the boxes.

        A turn mirrors and swaps axes, along each of which boxes and examples agree for itself: eight agreements are
        those of all eight turns.

        Parameters
        ----------
        seen : Signature
            Of n boxes; outlines count where it has them.
        neighbours : int
            See `match`.

        Returns
        -------
        ndarray of shape (8, n, m)
            In the order of `TURNS`.
        """
        total = np.zeros((len(TURNS), len(seen.boxes[PARENT_BOX]), len(self.taught)))
        for key in self.kept.boxes:
            if key not in seen.boxes:
                continue
            along: list[list[list[NDArray[Any]]]] = []  # by axis of the boxes, whether mirrored, axis of the examples
            for source in (0, 1):
                first, kind = seen.distinct(key, source)
                ways = seen.boxes[key][first, :, source]
                along.append(
                    [[self._along(key, v, axis, neighbours)[kind] for axis in (0, 1)] for v in (ways, flipped(ways))]
                )
            for i, (mirrored_x, mirrored_y, swapped) in enumerate(TURNS):
                x, y = along[0][mirrored_x][int(swapped)], along[1][mirrored_y][1 - int(swapped)]
                total[i] += best_assignment(x + y)[0]
        if seen.outlines:
            for i, turn in enumerate(TURNS):
                there = turned_outlines(seen.outlines, turn)
                for key in self.kept.outlines:
                    if key in there:
                        total[i] += self._outline_total(key, there[key], neighbours)
        return total / self._whole

    def _outline_total(self, key: str, there: Array, neighbours: int | None) -> Array:
        """Utility of the best assignment of the outlines of one group, shape (n, m)."""
        agreement = self._agreement(key, there, self.kept.outlines[key][:, :neighbours])
        utility = np.einsum("nmpqsr,mqsr->nmpq", agreement, self._weights32[key][:, :neighbours])
        return best_assignment(utility)[0].astype(np.float64)

    @cached_property
    def among_examples(self) -> dict[str, Match]:
        """Agreement of the examples with each other."""
        return self.match(self.kept)

    @cached_property
    def gram(self) -> Array:
        """Similarity of every two examples (eq. 5.7), 1 on the diagonal, shape (m, m)."""
        return self.similarities(self.among_examples)

    @cached_property
    def _whole(self) -> Array:
        """The utility of each example with itself, shape (m,)."""
        totals = np.sum([m.total for m in self.among_examples.values()], axis=0)
        return np.maximum(totals.diagonal(), 1e-9)

    def similarities(self, matches: dict[str, Match]) -> Array:
        """The adapted SL0 similarity (eq. 5.5) as a share of the example's with itself.

        Parameters
        ----------
        matches : dict of str to Match

        Returns
        -------
        ndarray of shape (n, m)
        """
        return np.sum([m.total for m in matches.values()], axis=0) / self._whole

    @cached_property
    def reliability(self) -> dict[str, tuple[float, float, float]]:
        """How surely a positive example agrees with another one, by group: along x, along y, in both at once."""
        found = {}
        p = self.positive
        others = ~np.eye(len(p), dtype=bool)
        for key, match in self.among_examples.items():
            parts = []
            for value in (match.along_x, match.along_y, match.joint):
                best = np.where(others, value[np.ix_(p, p)], 0.0).max(axis=1)
                parts.append(float(best.mean()) if len(p) > 1 else PRIOR_RELIABILITY * float(value[p[0], p[0]] > 0))
            found[key] = (parts[0], parts[1], parts[2])
        return found

    @cached_property
    def habits(self) -> Habits:
        """What each edge of the positive examples keeps to."""
        return Habits(self.kept.rows(self.positive), self.widths[:2])

    @cached_property
    def relative(self) -> "Lesson":
        """The same lesson with lengths in shares of the parents' sizes: what is learned from plans of many scales."""
        units = np.sqrt(parent_sizes(self.kept).prod(axis=1))
        taught = [replace(t, size=t.size / unit) for t, unit in zip(self.taught, units, strict=True)]
        return Lesson(taught, in_units(self.kept, units), self.options)

    @cached_property
    def one_each(self) -> bool:
        """Whether every positive example is the only one in its arrangement."""
        where = [self.taught[i].fingerprint for i in self.positive]
        return len(set(where)) == len(where)

    @cached_property
    def cohesion(self) -> float:
        """How similar a positive example is to the one most similar to it, on average; 1 where there is but one."""
        p = self.positive
        if len(p) < 2:
            return 1.0
        gram = self.gram[np.ix_(p, p)]
        return float(np.where(np.eye(len(p), dtype=bool), 0.0, gram).max(axis=1).mean())


#: Subscripts of the relations of a group by its number of dimensions.
_REST = {5: "xsr", 4: "sr"}


def _lies_within(values: Array) -> NDArray[np.bool_]:
    """Whether boxes overlap the elements that their coordinates (n, 2, 3, 4) are relative to; shape (n,)."""
    touching = TOUCHING * (values[:, :, 2, 0] - values[:, :, 0, 0])
    return ((values[:, :, 0, 1] < -touching) & (values[:, :, 2, 0] > touching)).all(axis=1)


def _side_by_side(parts: list[dict[str, Array]]) -> dict[str, Array]:
    """Rows of several dictionaries under each other; a group that one lacks is nil elements there."""
    shapes = {key: value.shape for part in parts for key, value in part.items()}
    return {
        key: np.concatenate([part.get(key, np.full((1, *shapes[key][1:]), np.nan)) for part in parts])
        for key in sorted(shapes)
    }
