"""How alike a target is: the similarity that matches are ranked by.

The thesis ranks by the transformation parameter similarity alone (eq. 3.11). It says how smooth a transformation is,
not whether lines lie where it leads: among near-symmetric shapes the wrong way round is as smooth as the right one.
So the similarity is a product of factors, each from 0 to 1, of which the TPS is one; the others come from the fit to
the lines.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..geometry.contours import Complex, Floats, even
from .alignment import GAIN
from .fitting import Fit, Fitter
from .marks import Marked
from .query import Query
from .transformation import gradient

#: Distance and tilt of a counterpart at which it counts 0.6: extents of the query at the target's scale, radians.
NEAR, ASKEW = 0.03, 0.4
#: Gradient per spacing of the nodes at which the transformation parameter similarity is 1/2.
STRAIN = 0.45
#: Mean squared difference of turn (square radians), and distance, at which the agreement is 1/2.
TURN, DISTANCE = 0.012, 0.006
#: Exponents of the factors: how much each says about a match being the right one, over the one number that makes
#: similarities spread over 0 to 1. `benchmarks/regions_calibration.py` says where they come from, and fits others.
EXPONENTS = {
    "coverage": 0.1,
    "smooth": 1.05,
    "course": 0.44,
    "near": 0.79,
    "own": 0.31,
    "whole": 1.13,
    "chained": 1.72,
    "corners": 1.68,
    "aligned": 0.29,
    "turns": 0.73,
    "unmirrored": 0.5,
}
SPREAD = 5.0
#: Evidence of corners beyond which more of it says no more: three or four times out of a million by chance.
ENOUGH = 15.0
#: Share of what a perfect alignment, or chain, is worth that is as good as perfect: bent lines are a little longer here
#: and there, and corners of smooth lines fall a little differently.
AS_GOOD = 0.8
#: Root of the product of the sums of squared turns (square radians) below which two lines are evenly bent, and alike.
LEAST_SPREAD = 1e-3
#: Coverage below which a match is a guess: whatever else is measured, is measured on too few lines to say much.
COVERED = 0.3
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
    chained : float
        Evidence of the chains of chords that agree with the match, as a share of what an identical copy would have.
    corners : float
        The same, where more than ENOUGH evidence counts as all: 1 / e for none.
    aligned : float
        Reward of the elastic alignment that agrees with the match, as a share of that of a perfect one: 1 / e for none.
    turns : float
        Correlation of the turns of the query's lines with those of their counterparts, from -1 to 1 as 0 to 1.
    unmirrored : float
        1, and 1 / e where the target is a mirror image: between two that are alike in all else, that comes second.
    mirrored : bool
        Whether the target is a mirror image.
    """

    coverage: float
    smooth: float
    course: float
    near: float
    own: float
    whole: float
    chained: float
    corners: float
    aligned: float
    turns: float
    unmirrored: float
    mirrored: bool

    @property
    def met(self) -> float:
        """Evidence of corners as a share of what is enough, 0 to 1."""
        return float(1.0 + np.log(self.corners))

    @property
    def similarity(self) -> float:
        """The factors' weighted product, 0 to 1; less for a guess."""
        total = sum(weight * np.log(max(getattr(self, name), FLOOR)) for name, weight in EXPONENTS.items())
        return float(np.exp(total / SPREAD) * trusted(self.coverage))


def trusted(coverage: ArrayLike) -> NDArray[np.float64]:
    """Share of a similarity that is left where it was measured on few of the query's lines.

    Parameters
    ----------
    coverage : (...) float

    Returns
    -------
    (...) float
        1 from COVERED on, and falling with the square of the coverage below.
    """
    share = np.minimum(1.0, np.asarray(coverage, dtype=np.float64) / COVERED)
    return np.asarray(share**2, dtype=np.float64)


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
    gap = np.abs(fitter.nodes.at[:, None] - fitter.sampling.samples.points[None])
    weight = np.exp(-0.5 * (gap / (2.0 * fitter.nodes.spacing)) ** 2) + 1e-12
    return (weight @ found) / weight.sum(1)


def corners_met(chained: Floats, most: float) -> Floats:
    """Evidence of chains as a share of ENOUGH, or of what an identical copy would have, where that is less.

    Parameters
    ----------
    chained : (h,) float
    most : float
        What an identical copy would have.

    Returns
    -------
    (h,) float
        0 to 1.
    """
    enough = min(ENOUGH, most)
    return np.clip(chained / enough, 0.0, 1.0) if enough > 0.0 else np.ones(len(chained))


def evidence(
    fitter: Fitter, query: Query, fit: Fit, chained: tuple[float, float], aligned: float, joint_tolerance: float = 0.0
) -> Evidence:
    """Measure a fit.

    Parameters
    ----------
    fitter : Fitter
    query : Query
    fit : Fit
    chained : (float, float)
        Score of the chains that agree with it, and the one that an identical copy would have.
    aligned : float
        Score of the alignment that agrees with it.
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
    mirrored = fit.function.mirrored
    worth, most = chained
    factors = {
        "chained": min(1.0, (max(worth, 0.0) + 1.0) / (AS_GOOD * (most + 1.0))),
        "corners": float(np.exp(corners_met(np.array([worth]), most)[0] - 1.0)),
        "aligned": float(np.exp(min(1.0, aligned / (AS_GOOD * GAIN)) - 1.0)),
        "unmirrored": float(np.exp(-1.0)) if mirrored else 1.0,
    }
    if not len(at):
        return Evidence(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, turns=0.0, mirrored=mirrored, **factors)
    distance = float((fit.distance[fit.counterpart >= 0] ** 2).mean())
    own, whole = _explained(fitter, query, fit, at)
    course, turns = _course(fitter, fit)
    return Evidence(
        float(found.mean()),
        _smooth(fitter, fit, found, joint_tolerance),
        1.0 / (1.0 + course / TURN),
        1.0 / (1.0 + distance / DISTANCE**2),
        own,
        whole,
        turns=turns,
        mirrored=mirrored,
        **factors,
    )


def marked_evidence(fitter: Fitter, marked: Marked, joint_tolerance: float = 0.0) -> Evidence:
    """Measure a fit of marks: what only lines have, their courses, turns and corners, counts as met.

    Parameters
    ----------
    fitter : Fitter
    marked : Marked
    joint_tolerance : float
        As for `evidence`.

    Returns
    -------
    Evidence
    """
    fit = marked.fit
    return Evidence(
        coverage=marked.coverage,
        smooth=_smooth(fitter, fit, support(fit), joint_tolerance),
        course=1.0,
        near=1.0 / (1.0 + (marked.near / NEAR) ** 2),
        own=marked.own,
        whole=marked.coverage,
        chained=marked.coverage,
        corners=1.0,
        aligned=1.0,
        turns=1.0,
        unmirrored=float(np.exp(-1.0)) if fit.function.mirrored else 1.0,
        mirrored=fit.function.mirrored,
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


def _course(fitter: Fitter, fit: Fit) -> tuple[float, float]:
    """Agreement of the turns of the query's lines with those of their counterparts.

    The mean squared difference between the turns of the images of the query's lines and of the lines there, and the
    correlation of the turns themselves, from -1 to 1 as 0 to 1.
    """
    s, t = fitter.sampling.samples, fitter.target
    before = np.roll(fit.counterpart, 1)
    both = (s.step > 0.0) & (fit.counterpart >= 0) & (before >= 0)
    both[both] = t.stretch[fit.counterpart[both]] == t.stretch[before[both]]
    if not both.any():
        return 1.0, 0.5
    sense = -1.0 if fit.function.mirrored else 1.0
    unknowns = fit.function.unknowns
    way = np.angle(fitter.sampling.ahead @ unknowns - fitter.sampling.rows @ unknowns)
    turned = t.heading[fit.counterpart[both]] - t.heading[before[both]]
    turned = (turned + np.pi) % (2.0 * np.pi) - np.pi
    miss = turned - sense * (way - np.roll(way, 1))[both]
    miss = (miss + np.pi / 2) % np.pi - np.pi / 2
    own = sense * s.turn[both]
    own, turned = own - own.mean(), turned - turned.mean()
    spread = float(np.sqrt((own**2).sum() * (turned**2).sum()))
    alike = float((own * turned).sum()) / spread if spread > LEAST_SPREAD else 1.0
    return float((miss**2).mean()), (1.0 + alike) / 2.0


def _explained(fitter: Fitter, query: Query, fit: Fit, at: NDArray[np.intp]) -> tuple[float, float]:
    """How much the counterparts are of the lines inside the region's image, and of the lines they lie on."""
    t, s = fitter.target, fitter.sampling.samples
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
    """Points along the outline of the query's shape, or round its parts."""
    shape = query.shape if query.shape.geom_type == "Polygon" else query.shape.convex_hull
    xy = shapely.get_coordinates(shapely.get_exterior_ring(shape))
    return even((xy[:, 0] + 1j * xy[:, 1])[:-1], True, 96)
