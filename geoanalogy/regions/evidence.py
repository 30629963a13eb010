"""How alike a target is: the similarity that matches are ranked by.

The thesis ranks by the transformation parameter similarity alone (eq. 3.11). It says how smooth a transformation is,
not whether lines lie where it leads: among near-symmetric shapes the wrong way round is as smooth as the right one.
So the similarity is a product of factors, each from 0 to 1, of which the TPS is one; the others come from the fit to
the lines.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from ..geometry.contours import Complex, Floats, even
from .fitting import Fit, Fitter
from .query import Query
from .transformation import gradient

#: Distance and tilt of a counterpart at which it counts 0.6: extents of the query at the target's scale, radians.
NEAR, ASKEW = 0.03, 0.4
#: Gradient per spacing of the nodes at which the transformation parameter similarity is 1/2.
STRAIN = 0.45
#: Mean squared difference of turn (square radians), and distance, at which the agreement is 1/2.
TURN, DISTANCE = 0.012, 0.006
#: Exponents of the factors: how much each says about a match being the right one.
EXPONENTS = {"coverage": 0.45, "smooth": 0.6, "course": 0.8, "near": 0.25, "own": 0.2, "whole": 0.7}
#: Coverage below which a match is doubtful however well the little agrees: short stretches are alike everywhere.
SCANT = 0.4
#: Factor of mirrored targets: between two that are alike in all else, the one that is not mirrored comes first.
MIRRORED = 0.85
#: Least value of a factor, so that one alone never says everything.
FLOOR = 0.02


@dataclass(frozen=True)
class Evidence:
    """What speaks for a match, each factor from 0 (nothing) to 1 (all).

    Attributes
    ----------
    coverage : float
        Share of the length of the query's lines that has a counterpart.
    smooth : float
        Transformation parameter similarity: harmonic mean over neighbouring nodes (eq. 3.11).
    course : float
        Agreement of the turns of the query's lines, carried along by the function, with those of their counterparts.
    near : float
        Nearness of the counterparts to the images.
    own : float
        Share of the target's lines, inside the image of the region, that are counterparts.
    whole : float
        Share of the lines with counterparts that the counterparts take up: a target is rarely a small part of a line.
    mirrored : bool
        Whether the target is a mirror image.
    """

    coverage: float
    smooth: float
    course: float
    near: float
    own: float
    whole: float
    mirrored: bool

    @property
    def similarity(self) -> float:
        """The factors' weighted product, 0 to 1."""
        product = min(1.0, self.coverage / SCANT) * (MIRRORED if self.mirrored else 1.0)
        for name, exponent in EXPONENTS.items():
            product *= max(getattr(self, name), FLOOR) ** exponent
        return float(product)


def support(fit: Fit) -> Floats:
    """Evidence at each sample, (s,): 1 where its counterpart lies on its image and runs along it, 0 without one.

    Parameters
    ----------
    fit : Fit

    Returns
    -------
    Floats
    """
    out = np.exp(-0.5 * (fit.distance / NEAR) ** 2 - 0.5 * (fit.tilt / ASKEW) ** 2)
    return np.where(fit.counterpart >= 0, out, 0.0)


def node_support(fitter: Fitter, found: Floats) -> Floats:
    """Evidence at each node, (m,): that of the samples near it.

    Parameters
    ----------
    fitter : Fitter
    found : Floats

    Returns
    -------
    Floats
    """
    gap = np.abs(fitter.nodes.at[:, None] - fitter.samples.points[None])
    weight = np.exp(-0.5 * (gap / (2.0 * fitter.nodes.spacing)) ** 2) + 1e-12
    return (weight @ found) / weight.sum(1)


def evidence(fitter: Fitter, query: Query, fit: Fit, joint_tolerance: float = 0.0) -> Evidence:
    """Measure a fit.

    Parameters
    ----------
    fitter : Fitter
    query : Query
    fit : Fit
    joint_tolerance : float
        Share, from 0 to 1, of half of the pairs of nodes whose gradients are forgiven, largest first.

    Returns
    -------
    Evidence

    Notes
    -----
    Eq. 3.11 takes a harmonic mean of Gaussians that reach 0. With 1 / (1 + g^2) in place of exp(-g^2), the same for
    small gradients, the harmonic mean is 1 / (1 + mean g^2): bounded, and one large gradient still counts more than
    many small ones.
    """
    found = support(fit)
    at = fit.counterpart[fit.counterpart >= 0]
    if not len(at):
        return Evidence(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, fit.function.mirrored)
    distance = float((fit.distance[fit.counterpart >= 0] ** 2).mean())
    own, whole = _explained(fitter, query, fit, at)
    return Evidence(
        float(found.mean()),
        _smooth(fitter, fit, found, joint_tolerance),
        1.0 / (1.0 + _course(fitter, fit) / TURN),
        1.0 / (1.0 + distance / DISTANCE**2),
        own,
        whole,
        fit.function.mirrored,
    )


def _smooth(fitter: Fitter, fit: Fit, found: Floats, joint_tolerance: float) -> float:
    """Transformation parameter similarity of a fit, over the pairs of nodes that are supported at both ends."""
    f, n = fit.function, fitter.nodes
    strain, bend = gradient(f.position[None], f.factor[None], n)
    square = (strain[0] ** 2 + bend[0] ** 2) / STRAIN**2
    at = node_support(fitter, found)
    weight = n.weight * (0.05 + np.minimum(at[n.first], at[n.second]))
    if joint_tolerance > 0.0:
        order = np.argsort(-square, kind="stable")
        forgiven = np.cumsum(weight[order]) <= 0.5 * joint_tolerance * weight.sum()
        weight = weight.copy()
        weight[order[forgiven]] = 0.0
    return float(1.0 / (1.0 + (weight * square).sum() / weight.sum()))


def _course(fitter: Fitter, fit: Fit) -> float:
    """Mean squared difference between the turns of the images of the query's lines and of the lines there."""
    s, t = fitter.samples, fitter.target
    before = np.roll(fit.counterpart, 1)
    both = (s.step > 0.0) & (fit.counterpart >= 0) & (before >= 0)
    both[both] = t.stretch[fit.counterpart[both]] == t.stretch[before[both]]
    if not both.any():
        return 1.0
    unknowns = np.concatenate([fit.function.position, fit.function.factor])
    way = np.angle(fitter.ahead @ unknowns - fitter.rows @ unknowns)
    turn = (-1.0 if fit.function.mirrored else 1.0) * (way - np.roll(way, 1))[both]
    miss = t.heading[fit.counterpart[both]] - t.heading[before[both]] - turn
    miss = (miss + np.pi / 2) % np.pi - np.pi / 2
    return float((miss**2).mean())


def _explained(fitter: Fitter, query: Query, fit: Fit, at: NDArray[np.intp]) -> tuple[float, float]:
    """How much the counterparts are of the lines inside the region's image, and of the lines they lie on."""
    t, s = fitter.target, fitter.samples
    scale = float(np.abs(fit.function.factor).mean())
    step = float(np.median(s.step[s.step > 0.0])) * scale
    image = fit.function(_outline(query))
    low, high = (image.real.min(), image.imag.min()), (image.real.max(), image.imag.max())
    box = np.flatnonzero(
        (t.points.real >= low[0]) & (t.points.real <= high[0]) & (t.points.imag >= low[1]) & (t.points.imag <= high[1])
    )
    region = shapely.polygons(np.stack([image.real, image.imag], 1))
    region = region if region.is_valid else region.buffer(0.0)
    box = box[shapely.contains_xy(region, t.points.real[box], t.points.imag[box])]
    own = 1.0
    if len(box):
        gap = np.abs(t.points[box][:, None] - t.points[at][None]).min(1)
        own = float((t.spacing[box] * (gap < 1.5 * step)).sum() / t.spacing[box].sum())
    used = np.unique(t.stretch[at])
    length = float((t.spacing[t.begin[used]] * t.count[used]).sum())
    return own, min(1.0, len(at) * step / max(length, 1e-12))


def _outline(query: Query) -> Complex:
    """Points along the outline of the query's shape."""
    xy = shapely.get_coordinates(shapely.get_exterior_ring(query.shape))
    return even((xy[:, 0] + 1j * xy[:, 1])[:-1], True, 96)
