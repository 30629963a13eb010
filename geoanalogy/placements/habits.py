"""What each edge of the examples keeps to most closely."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .signature import PARENT_BOX, Signature
from .turns import TURNS, flipped

Array = NDArray[np.float64]

#: Scatter of a coordinate below which examples agree in it, and differences from it that hardly count, in widths of
#: the Gaussians.
HABIT_FLOOR = 0.3
#: The same for what is constructed and not drawn by eye: rounding, and nothing else.
CONSTRUCTED = 1e-3


@dataclass(frozen=True)
class Habit:
    """What edges keep to among the coordinates of one group; arrays of shape (2, 2, 4): axis, edge, coordinate.

    Attributes
    ----------
    middle, scatter : ndarray
        Median of each coordinate, and its scatter in scene units.
    weight : ndarray
        Adds up to 1 over the groups and coordinates of an edge.
    """

    middle: Array
    scatter: Array
    weight: Array


class Habits:
    """The habits of each edge (low and high, along x and y).

    Of all coordinates of an edge, to the nearest element of any group, those that scatter least among the positive
    examples weigh most: it is what the edge follows, be it the window's corner or a share of the parent.

    Parameters
    ----------
    kept : Signature
        Of the positive examples.
    widths : ndarray of shape (2,)
        Of the Gaussians of lengths along x and y.
    """

    def __init__(self, kept: Signature, widths: Array) -> None:
        self.widths = widths[:, None, None]
        floor = HABIT_FLOOR * self.widths
        found: dict[str, Habit] = {}
        for key, values in kept.boxes.items():
            edges = values[:, 0][:, :, [0, 2]]
            if not np.isfinite(edges).all():
                continue
            scatter = edges.std(axis=0)
            scatter[..., 3] *= (edges[..., 0] - edges[..., 1]).mean(axis=0)  # shares of the elements' mean extent
            found[key] = Habit(np.median(edges, axis=0), scatter, 1.0 / (scatter**2 + floor**2))
        whole = sum(habit.weight.sum(axis=2, keepdims=True) for habit in found.values())
        self.of = {key: Habit(h.middle, h.scatter, h.weight / whole) for key, h in found.items()}

    def kept_to(self, seen: Signature) -> tuple[Array, Array]:
        """How well each edge of boxes keeps to what it keeps to among the examples.

        Parameters
        ----------
        seen : Signature
            Of n boxes.

        Returns
        -------
        kept : ndarray of shape (n, 2, 2)
            By axis and edge (low, high), between 0 and 1: in all coordinates, by their weights.
        explained : ndarray of shape (n, 2, 2)
            In the best of the coordinates that the examples agree in exactly; 1 where there is none. Whatever is drawn
            by a rule, however many rules would do, keeps to one of them.
        """
        n = len(seen.boxes[PARENT_BOX])
        kept, explained, exact = np.zeros((n, 2, 2)), np.zeros((n, 2, 2)), np.zeros((2, 2), dtype=bool)
        for key, habit in self.of.items():
            tight = habit.scatter <= HABIT_FLOOR * self.widths
            exact |= tight.any(axis=2)
            if key not in seen.boxes:
                continue
            for axis in (0, 1):
                first, kind = seen.distinct(key, axis)
                agreement = self._agreement(habit, seen.boxes[key][first, 0, axis], axis)
                kept[:, axis] += (habit.weight[axis] * agreement).sum(axis=2)[kind]
                best = (tight[axis] * agreement).max(axis=2)[kind]
                explained[:, axis] = np.maximum(explained[:, axis], best)
        return kept, np.where(exact, explained, 1.0)

    def turned(self, seen: Signature) -> Array:
        """How well boxes keep to the habits, all edges on average, in all eight turns of what surrounds them.

        Parameters
        ----------
        seen : Signature
            Of n boxes.

        Returns
        -------
        ndarray of shape (8, n)
            In the order of `TURNS`.
        """
        kept = np.zeros((len(TURNS), len(seen.boxes[PARENT_BOX])))
        for key, habit in self.of.items():
            if key not in seen.boxes:
                continue
            along: list[list[list[Array]]] = []  # by axis of the boxes, whether mirrored, axis of the examples
            for source in (0, 1):
                first, kind = seen.distinct(key, source)
                values = seen.boxes[key][first, :1, source]
                along.append(
                    [[self._along(habit, v[:, 0], axis)[kind] for axis in (0, 1)] for v in (values, flipped(values))]
                )
            for i, (mirrored_x, mirrored_y, swapped) in enumerate(TURNS):
                kept[i] += along[0][mirrored_x][int(swapped)] + along[1][mirrored_y][1 - int(swapped)]
        return kept / 4

    def _along(self, habit: Habit, values: Array, axis: int) -> Array:
        """How well coordinates (n, 3, 4) along an axis keep to a habit: the sum of both edges, shape (n,)."""
        return np.asarray((self._agreement(habit, values, axis) * habit.weight[axis]).sum(axis=(1, 2)))

    def _agreement(self, habit: Habit, values: Array, axis: int) -> Array:
        """Agreement of both edges in every coordinate (n, 3, 4) along an axis with a habit; shape (n, 2, 4)."""
        edges = values[:, [0, 2]]
        off = edges - habit.middle[axis]
        off[..., 3] *= edges[..., 0] - edges[..., 1]
        agreement = np.exp(-0.5 * (off / (habit.scatter[axis] + self.widths[axis])) ** 2)
        agreement[np.isnan(agreement)] = 0.0
        return np.asarray(agreement)

    @cached_property
    def exact(self) -> dict[str, NDArray[np.bool_]]:
        """The coordinates that all examples agree in to the last digit, of the groups where every edge has one."""
        found = {key: habit.scatter <= CONSTRUCTED * self.widths for key, habit in self.of.items()}
        return {key: exact for key, exact in found.items() if exact.any(axis=2).all()}

    def constructed(self, seen: Signature) -> Array:
        """How exactly boxes keep to an element that the examples keep to exactly with all four edges.

        What is snapped to a window by a rule has the same offsets at every window, to the last digit; where that is so,
        a box with other offsets does not follow the rule, however much else is alike. Nothing that is drawn by eye
        keeps so exactly to anything.

        Parameters
        ----------
        seen : Signature
            Of n boxes.

        Returns
        -------
        ndarray of shape (n,)
            Between 0 and 1, for the element that fits best; NaN where the examples keep exactly to none.
        """
        if not self.exact:
            return np.full(len(seen.boxes[PARENT_BOX]), np.nan)
        return np.asarray(np.max(list(self.exactness(seen).values()), axis=0))

    def exactness(self, seen: Signature) -> dict[str, Array]:
        """`constructed`, by the group of the element.

        Parameters
        ----------
        seen : Signature
            Of n boxes.

        Returns
        -------
        dict of str to ndarray of shape (n,)
            For the groups of `exact`.
        """
        found: dict[str, Array] = {}
        for key, exact in self.exact.items():
            if key not in seen.boxes:
                found[key] = np.zeros(len(seen.boxes[PARENT_BOX]))
                continue
            edges = seen.boxes[key][:, 0][:, :, [0, 2]]
            off = edges - self.of[key].middle
            off[..., 3] *= edges[..., 0] - edges[..., 1]
            agreement = np.nan_to_num(np.exp(-0.5 * (off / (HABIT_FLOOR * self.widths)) ** 2))
            found[key] = np.where(exact, agreement, 0.0).max(axis=3).min(axis=(1, 2))
        return found
