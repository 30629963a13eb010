"""Which candidates are worth going on with: those of one arrangement stand against one another."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .batch import Batch
from .importance import Importance

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

#: The number of results per arrangement that numbers of candidates are meant for; where more are wanted, more are kept.
PER_PARENT = 12

#: Candidates nearer than this, in half-widths of level sets, have come to the same maximum.
SAME_MAXIMUM = 0.1


@dataclass(frozen=True)
class Refined:
    """Poses at maxima of the importance.

    Attributes
    ----------
    which : ndarray of shape (k,), int
        The number of each pose's importance, ascending.
    position : ndarray of shape (k, 2)
    angle, value : ndarray of shape (k,)
        Direction in radians, and importance.
    """

    which: Indices
    position: Array
    angle: Array
    value: Array

    def of(self, chosen: Indices | Bools | slice) -> "Refined":
        """Some of the poses.

        Parameters
        ----------
        chosen : ndarray of int or bool, or slice

        Returns
        -------
        Refined
        """
        return Refined(self.which[chosen], self.position[chosen], self.angle[chosen], self.value[chosen])

    def bettered(self, position: Array, angle: Array, value: Array) -> "Refined":
        """Each pose, or the one offered in its place where that is worth more.

        Parameters
        ----------
        position : ndarray of shape (k, 2)
        angle, value : ndarray of shape (k,)

        Returns
        -------
        Refined
        """
        better = value > self.value
        return Refined(
            self.which,
            np.where(better[:, None], position, self.position),
            np.where(better, angle, self.angle),
            np.maximum(self.value, value),
        )

    def one_step_away(self, reach: Array) -> tuple[Array, Array]:
        """The six poses around each: a step ahead and back, to both sides, and turned both ways.

        Parameters
        ----------
        reach : ndarray of shape (k, 3)
            Length of the step ahead, of that to the side, and the turn.

        Returns
        -------
        position : ndarray of shape (k, 6, 2)
        angle : ndarray of shape (k, 6)
        """
        c, s = np.cos(self.angle), np.sin(self.angle)
        ahead, across = reach[:, :1] * np.column_stack([c, s]), reach[:, 1:2] * np.column_stack([-s, c])
        still = np.zeros_like(ahead)
        position = self.position[:, None] + np.stack([ahead, -ahead, across, -across, still, still], axis=1)
        return position, self.angle[:, None] + reach[:, 2:] * np.array([0, 0, 0, 0, 1, -1])


#: Which poses of several importances may be accepted, given how far they still move, in half-widths of level sets.
Stands = Callable[[Sequence[Importance], Refined, float], Bools]

#: Which poses of several importances are the example itself.
IsExample = Callable[[Sequence[Importance], Refined], Bools]


class Rivals:
    """The candidates of several arrangements, in every sense and at every scale.

    Parameters
    ----------
    importances : sequence of Importance
        Those of one arrangement are neighbours.
    batch : Batch
        Of these importances.
    factor : ndarray of shape (importances,)
        What they are multiplied by before those of an arrangement are compared.
    stands : callable, optional
        Which poses may be accepted; None: all.
    is_example : callable, optional
        Which poses are the example itself; None: none.
    """

    def __init__(
        self,
        importances: Sequence[Importance],
        batch: Batch,
        factor: Array,
        stands: Stands | None = None,
        is_example: IsExample | None = None,
    ) -> None:
        self._importances = importances
        self._arrangement = batch.arrangement
        self._unit = batch.unit
        self._factor = factor
        self._stands = stands
        self._is_example = is_example
        #: Number of senses and scales of each arrangement.
        self._ways = np.bincount(batch.arrangement)
        self._candidates = max(PER_PARENT, batch.query.options.candidates)

    def worth(self, poses: Refined) -> Array:
        """What poses of one arrangement are compared by.

        Parameters
        ----------
        poses : Refined

        Returns
        -------
        ndarray of shape (k,)
        """
        return poses.value * self._factor[poses.which]

    def _best(self, poses: Refined, value: Array) -> Array:
        """The best value among the given poses of each arrangement, by its number."""
        top = np.zeros(self._arrangement.max() + 1)
        np.maximum.at(top, self._arrangement[poses.which], value)
        return top

    def shares(self, poses: Refined) -> Array:
        """What poses are worth, as shares of the best one of their arrangement.

        Parameters
        ----------
        poses : Refined

        Returns
        -------
        ndarray of shape (k,)
        """
        value = self.worth(poses)
        return value / np.maximum(self._best(poses, value), np.finfo(float).tiny)[self._arrangement[poses.which]]

    def in_turn(self, poses: Refined, most: int | None = None) -> Indices:
        """Numbers of the poses of every arrangement that has any, the best first.

        Parameters
        ----------
        poses : Refined
        most : int, optional
            Number of each arrangement, times that of its senses and scales; None: all.

        Returns
        -------
        ndarray of shape (arrangements that have poses, most poses of one), int
            Padded with -1.
        """
        room = self._arrangement[poses.which]
        order = np.lexsort((-self.worth(poses), room))
        changes = np.append(True, np.diff(room) != 0)
        row = np.cumsum(changes) - 1
        start = np.flatnonzero(changes)
        place = np.arange(len(room)) - start[row]
        table = np.full((len(start), int(place.max(initial=-1)) + 1), -1, dtype=np.intp)
        table[row, place] = order
        if most is not None:
            table = np.where(np.arange(table.shape[1]) < most * self._ways[room[start]][:, None], table, -1)
        return table

    def acceptable(self, poses: Refined, slack: float) -> Bools:
        """Which candidates may be accepted.

        Parameters
        ----------
        poses : Refined
        slack : float
            How far they still move, in half-widths of level sets.

        Returns
        -------
        ndarray of shape (k,), bool
        """
        if self._stands is None:
            return np.ones(len(poses.which), dtype=bool)
        return self._stands(self._importances, poses, slack)

    def standing(self, poses: Refined, slack: float) -> Indices:
        """The candidates that may be accepted, and those that nothing as good may be accepted in place of.

        Parameters
        ----------
        poses : Refined
        slack : float
            How far they still move, in half-widths of level sets.

        Returns
        -------
        ndarray of int
            In order.
        """
        stands = self.acceptable(poses, slack)
        value = self.worth(poses)
        top = self._best(poses.of(stands), value[stands])
        return np.flatnonzero(stands | (value > top[self._arrangement[poses.which]]))

    def leading(self, poses: Refined, most: int, share: float) -> Indices:
        """The best candidates of each arrangement, one per maximum.

        Parameters
        ----------
        poses : Refined
        most : int
            Number kept of an arrangement of which PER_PARENT results are wanted, times that of its senses and scales.
        share : float
            Of the arrangement's best value, below which none are kept.

        Returns
        -------
        ndarray of int
            In the order of the poses.
        """
        # The example outshines all other places of its room, and is no answer.
        others = np.arange(len(poses.which))
        if self._is_example is not None:
            others = np.flatnonzero(~self._is_example(self._importances, poses))
        good = others[self.shares(poses.of(others)) >= share]
        table = self.in_turn(poses.of(good))
        which = poses.which[good]
        unit = self._unit[which]
        facing = np.column_stack([np.cos(poses.angle[good]), np.sin(poses.angle[good])]) / unit[:, 2:]
        # One that has a better one beside it is the same.
        near = (table[:, :, None] >= 0) & (table[:, None] >= 0)
        for coordinate in (*(poses.position[good] / unit[:, :2]).T, *facing.T):
            place = coordinate[table]
            near &= np.abs(place[:, :, None] - place[:, None]) < SAME_MAXIMUM
        # Of two senses or scales at one place, the one that is worth less may still become the better one.
        near &= which[table][:, :, None] == which[table][:, None]
        alone = ~np.tril(near, -1).any(axis=2) & (table >= 0)
        room = self._arrangement[which[table[:, 0]]]
        wanted = most * self._candidates / PER_PARENT * self._ways[room]
        kept = alone & (np.cumsum(alone, axis=1) <= wanted[:, None])
        return np.sort(good[table[kept]])
