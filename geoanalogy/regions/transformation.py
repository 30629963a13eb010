"""Transformation functions (section 3.2): a similarity at every query point, blended over the region.

In complex numbers a similarity at node q is z -> p + a (z - q): it takes q to p, turns by arg a and scales by |a|.
That is the recentred form at the end of appendix A: nothing depends on the origin, scales are ratios and angles wrap.
A mirrored function is one of the conjugate plane.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Floats

#: Width of the blending Gaussian, in spacings of the nodes. Narrower ones show steps between nodes, wider ones blur
#: bends.
BLEND = 1.0


@dataclass(frozen=True)
class Nodes:
    """The nodes of transformation functions of one query.

    Attributes
    ----------
    at : (m,) complex
        Positions: the query points.
    spacing : float
        Distance of neighbouring nodes.
    first, second : (e,) int
        Pairs of neighbouring nodes, each pair in both directions.
    weight : (e,) float
        n_ij of eq. 3.8.
    """

    at: Complex
    spacing: float
    first: NDArray[np.intp]
    second: NDArray[np.intp]
    weight: Floats

    @classmethod
    def of(cls, at: Complex, spacing: float, neighbourhood: float) -> "Nodes":
        """Join nodes that are near each other, and the parts that would stay apart by their nearest nodes."""
        gap = np.abs(at[:, None] - at[None])
        weight = np.exp(-0.5 * (gap / (neighbourhood * spacing)) ** 2)
        np.fill_diagonal(weight, 0.0)
        weight[gap > 2.0 * neighbourhood * spacing] = 0.0
        part = np.arange(len(at))
        while True:
            for _ in range(len(at)):
                least = np.where(weight > 0.0, part[None], len(at)).min(1, initial=len(at))
                grown = np.minimum(part, least)
                if (grown == part).all():
                    break
                part = grown
            own = part == part[0]
            if own.all():
                break
            far = np.where(own[:, None] & ~own[None], gap, np.inf)
            i, j = np.unravel_index(int(far.argmin()), far.shape)
            weight[i, j] = weight[j, i] = np.exp(-2.0)
            part[part == part[j]] = part[0]
        first, second = np.nonzero(weight)
        return cls(at, spacing, first, second, weight[first, second])

    def blend(self, z: Complex) -> Floats:
        """Weights of the nodes at points, (k, m), each row with sum 1; far outside, those of the nearest nodes."""
        square = np.abs(z[:, None] - self.at[None]) ** 2 / (2.0 * (BLEND * self.spacing) ** 2)
        weight = np.exp(square.min(1, keepdims=True) - square)
        return weight / weight.sum(1, keepdims=True)

    def rows(self, z: Complex, weight: Floats | None = None) -> Complex:
        """The linear map (k, 2m) from a function's unknowns (positions, then factors) to the images of points.

        `weight` is what `blend` gives for them, where it is known.
        """
        weight = self.blend(z) if weight is None else weight
        return np.concatenate([weight, weight * (z[:, None] - self.at[None])], 1)


@dataclass(frozen=True)
class TransformationFunction:
    """f: Q -> T of eq. 3.1.

    Attributes
    ----------
    nodes : Nodes
        Where it is sampled.
    position : (m,) complex
        Images of the nodes; of a mirrored function their conjugates.
    factor : (m,) complex
        Scale and rotation at the nodes, before the reflection of a mirrored function.
    mirrored : bool
        Whether the image is reflected (conjugated).
    """

    nodes: Nodes
    position: Complex
    factor: Complex
    mirrored: bool

    @property
    def unknowns(self) -> Complex:
        """Positions, then factors, (2m,): what a fit solves for."""
        return np.concatenate([self.position, self.factor])

    def __call__(self, z: Complex) -> Complex:
        """Images of points of the query, (k,) complex."""
        image = self.nodes.rows(z) @ self.unknowns
        return np.conj(image) if self.mirrored else image


def smoothness(nodes: Nodes) -> tuple[Complex, Complex]:
    """Two quadratic forms (2m, 2m) that measure how a function changes between neighbouring nodes.

    Parameters
    ----------
    nodes : Nodes

    Returns
    -------
    strain, bend : (2m, 2m) complex
        The averages over pairs, weighted by n_ij, of |p_j - p_i - a_i (q_j - q_i)|^2 / |q_j - q_i|^2 (the recentred
        translation gradient of appendix A) and of |a_j - a_i|^2 / |q_j - q_i|^2 (scale and rotation), both times the
        squared spacing: squared difference quotients (eq. 3.5), in a form whose minimum is one linear solve.
    """
    i, j, m = nodes.first, nodes.second, len(nodes.at)
    pair = np.arange(len(i))
    step = nodes.at[j] - nodes.at[i]
    share = nodes.weight / nodes.weight.sum() * (nodes.spacing / np.abs(step)) ** 2
    shift = np.zeros((len(i), 2 * m), complex)
    shift[pair, j], shift[pair, i], shift[pair, m + i] = 1.0, -1.0, -step
    turn = np.zeros((len(i), 2 * m), complex)
    turn[pair, m + i], turn[pair, m + j] = nodes.spacing, -nodes.spacing
    penalties = [np.asarray((d.conj().T * share) @ d, dtype=np.complex128) for d in (shift, turn)]
    return penalties[0], penalties[1]


def gradient(position: Complex, factor: Complex, nodes: Nodes) -> tuple[Floats, Floats]:
    """Relative change of functions between neighbouring nodes, per spacing.

    Parameters
    ----------
    position, factor : (h, m) complex
        Several functions of the same nodes.
    nodes : Nodes

    Returns
    -------
    strain : (h, e) float
        |p_j - p_i - a_i (q_j - q_i)| / |a_i (q_j - q_i)|: translation, recentred, in units of the target.
    bend : (h, e) float
        |log(a_j / a_i)| spacing / |q_j - q_i|: scales as ratios, angles wrapped.
    """
    i, j = nodes.first, nodes.second
    step = nodes.at[j] - nodes.at[i]
    safe = np.where(np.abs(factor) > 0.0, factor, 1e-300)
    moved = safe[:, i] * step
    strain = np.abs(position[:, j] - position[:, i] - moved) / np.abs(moved)
    bend = np.abs(np.log(safe[:, j] / safe[:, i])) * nodes.spacing / np.abs(step)
    return strain, bend
