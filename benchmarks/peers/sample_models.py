"""Chapter 5 taken literally: the five sample models on a dense grid, every assignment by the Hungarian algorithm.

Relations are the eight box coordinates of every element; the assignment is one to one per label, over all elements of
the parent; the regression is eq. 5.6 with a fixed λ. This is what `geoanalogy.placements` is measured against, and
where the heat maps of figures 5.4 and 5.12 come from.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

import geoanalogy as ga
from geoanalogy.placements.similarity import SIGMA
from geoanalogy.relations.table import Kind

Array = NDArray[np.float64]

#: Regularisation of eq. 5.6, as a share of the gram matrix's mean diagonal.
LAMBDA = 1e-2
#: Where the five samples lie on a box of unit size.
SAMPLES = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0.5)], float)


def coordinates(points: Array, elements: Array) -> Array:
    """The eight box coordinates of points relative to elements, shape (n, e, 8)."""
    low, high = elements[None, :, :2], elements[None, :, 2:]
    at = points[:, None]
    return np.concatenate([at - low, at - high, at - (low + high) / 2, (at - low) / (high - low)], axis=2)


class SampleModels:
    """The models t_i of section 5.5, learned in upright scenes.

    Parameters
    ----------
    scene : Scene
    label : str
        Of the parents.
    examples : sequence of Rectangle
    tau : float
        The kernel size of section 5.7.
    """

    def __init__(self, scene: ga.Scene, label: str, examples: Sequence[ga.Rectangle], tau: float = 1.0) -> None:
        self.scene, self.label = scene, label
        self.boxes = np.array([r.box(0.0)[0] for r in examples])
        diagonal = float(np.hypot(*(self.boxes[:, 2:] - self.boxes[:, :2]).T).mean())
        length, share = tau * SIGMA[Kind.LENGTH] * diagonal, tau * SIGMA[Kind.RATIO]
        self.widths = np.array([length] * 6 + [share] * 2)
        self.parents = [self._parent_of(b) for b in self.boxes]
        self.known = [[self._features(p, self._sample(i, j)) for j, p in enumerate(self.parents)] for i in range(5)]

    def _sample(self, i: int, j: int) -> Array:
        return (self.boxes[j, :2] + SAMPLES[i] * (self.boxes[j, 2:] - self.boxes[j, :2]))[None]

    def _parent_of(self, box: Array) -> ga.Polygon:
        centre = (box[:2] + box[2:]) / 2
        own = [p for p in self.scene.polygons if p.label == self.label]
        return next(p for p in own if (p.points.min(0) <= centre).all() and (centre <= p.points.max(0)).all())

    def _features(self, parent: ga.Polygon, points: Array) -> dict[str, Array]:
        of: dict[str, list[Array]] = {"": [np.array([*parent.points.min(0), *parent.points.max(0)])]}
        for p in self.scene.members_of(str(parent.id)):
            of.setdefault(p.label, []).append(np.array([*p.points.min(0), *p.points.max(0)]))
        return {label: coordinates(points, np.array(some)) / self.widths for label, some in of.items()}

    @staticmethod
    def _similarity(a: dict[str, Array], at: int, b: dict[str, Array]) -> float:
        total = 0.0
        for label, values in b.items():
            if label in a:
                agreement = np.exp(-0.5 * (a[label][at][:, None] - values[0][None]) ** 2).sum(axis=2)
                rows, columns = linear_sum_assignment(agreement, maximize=True)
                total += float(agreement[rows, columns].sum())
        return total

    def predicted(self, sample: int, parent: ga.Polygon, points: Array) -> Array:
        """Target values t_i of one sample model at points of a parent (eq. 5.6), shape (n,).

        Parameters
        ----------
        sample : int
            Of `SAMPLES`.
        parent : Polygon
        points : ndarray of shape (n, 2)

        Returns
        -------
        ndarray
        """
        known = self.known[sample]
        gram = np.array([[self._similarity(a, 0, b) for b in known] for a in known])
        gram = (gram + gram.T) / 2
        weights = np.linalg.solve(
            gram + LAMBDA * gram.diagonal().mean() * np.eye(len(gram)), np.ones(len(gram), dtype=np.float64)
        )
        here = self._features(parent, points)
        return np.array([[self._similarity(here, n, b) for b in known] for n in range(len(points))]) @ weights
