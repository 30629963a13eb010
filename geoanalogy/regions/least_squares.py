"""Weighted least squares for transformation functions: where given points should go, by smooth functions.

An unknown position p and factor a of every node take a point z to the sum of w (p + a (z - q)) over the nodes q. The
weights w are real and all that is complex is z - q, so the normal equations follow from four real moments of the
weights instead of complex products of twice the width. One candidate is set up and solved after the other: its matrix
stays in the processor's cache.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..geometry.contours import Complex, Floats
from .transformation import Nodes


@dataclass(frozen=True)
class Blended:
    """Points of the query that functions take along.

    Attributes
    ----------
    nodes : Nodes
    points : (k,) complex
    """

    nodes: Nodes
    points: Complex

    @cached_property
    def rows(self) -> Complex:
        """The linear map (k, 2m) from a function's unknowns (positions, then factors) to the images of the points."""
        return self.nodes.rows(self.points, self._weights)

    @cached_property
    def _weights(self) -> Floats:
        return self.nodes.blend(self.points)

    @cached_property
    def _powers(self) -> Floats:
        """1, x, y and x² + y² of the points, seen from the middle of the nodes, (4, 1, k)."""
        z = self.points - self.nodes.at.mean()
        return np.array([np.ones(len(z)), z.real, z.imag, np.abs(z) ** 2])[:, None, :]

    def solve(self, goal: Complex, weight: Floats, smooth: Complex, toward: Complex | float = 0.0) -> Complex:
        """Unknowns of functions that take the points near their goals.

        Parameters
        ----------
        goal : (h, k) complex
            Where the points should go, for several candidates.
        weight : (h, k) float
            Those of a candidate are divided by their sum.
        smooth : (2m, 2m) complex
            What is added to the matrices of the normal equations; Hermitian and positive definite.
        toward : (h, 2m) complex, or 0
            What is added to their right-hand sides.

        Returns
        -------
        (h, 2m) complex
        """
        share = weight / np.maximum(weight.sum(1, keepdims=True), 1e-12)
        right = (share * goal) @ self.rows.conj() + toward
        return np.array([np.linalg.solve(self._squares(s) + smooth, r) for s, r in zip(share, right, strict=True)])

    def _squares(self, share: Floats) -> Complex:
        """`rows`, conjugated and transposed, times weights (k,), times `rows`, (2m, 2m)."""
        at = self.nodes.at - self.nodes.at.mean()
        m = len(at)
        moments = (self._weights.T * (self._powers * share)).reshape(4 * m, -1) @ self._weights
        count, x, y, square = moments.reshape(4, m, m)
        first = x + 1j * y
        out = np.empty((2 * m, 2 * m), dtype=np.complex128)
        out[:m, :m] = count
        out[:m, m:] = first - count * at
        out[m:, :m] = np.conj(out[:m, m:].T)
        # conj(z - q) (z - r) = |z|² - conj(q) z - r conj(z - q)
        out[m:, m:] = square - np.conj(at)[:, None] * first - at * out[m:, :m]
        return out
