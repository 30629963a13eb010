"""Candidates: transformation functions from which the fit to the lines starts.

Four sources complement each other: chains of chords (corners), elastic alignments (courses), sets of refined
correspondences linked by the transformation parameter similarity (sections 3.4 and 3.5: whatever the lines look like),
and groups of lines that stand by themselves (many short strokes).
"""

from dataclasses import dataclass

import numpy as np

from ..geometry.contours import Complex
from ..geometry.drawing import Drawing
from ..progress import Stepper, within
from .alignment import Alignment, align
from .chains import Chains, chain
from .correspondences import Correspondences, aligned, described
from .fitting import Fitter, distinct
from .groups import laid_over
from .linkage import branched, clusters, similarities
from .options import RegionOptions
from .query import Query
from .refinement import Refined, refine
from .transformation import Nodes

#: Alignments, chains and sets of correspondences that become candidates at most.
MOST_ALIGNED, MOST_CHAINED, MOST_CLUSTERS = 60, 60, 40
#: Candidates of chains, alignments, sets and groups that are kept as the best of their kind: of each place, and in all.
#: What a part was cut from brings fewer lines onto lines than what is wrong, but its chain is as good.
QUOTAS = ((8, 28), (6, 20), (2, 8), (2, 6))
#: Candidates of each place, of each source, and in all, of which those are added that bring most lines onto lines.
EACH_PLACE, EACH_SOURCE, MOST_STARTS = 12, 64, 88
#: Share of the query points that a set of correspondences must have.
LEAST_SHARE = 0.15
#: Candidates whose query points land on average nearer than this, in extents of the query, are one.
SAME = 0.04

#: Unknowns of a function to start from, and whether it is mirrored.
Start = tuple[Complex, bool]


@dataclass(frozen=True)
class Candidates:
    """What a fit starts from, and what it is compared with afterwards.

    Attributes
    ----------
    starts : list of (complex array, bool)
    alignments : list of Alignment
    chains : Chains
    refined : Refined
        The refined correspondences.
    """

    starts: list[Start]
    alignments: list[Alignment]
    chains: Chains
    refined: Refined


def refined_correspondences(
    drawing: Drawing, region: Query, alignments: list[Alignment], options: RegionOptions
) -> Stepper[Refined]:
    """First-order correspondences of the descriptors and of the alignments, refined (section 3.4).

    Parameters
    ----------
    drawing : Drawing
    region : Query
    alignments : list[Alignment]
    options : RegionOptions

    Returns
    -------
    Stepper[Refined]
    """
    noisy = Correspondences.joined(
        [described(drawing, region, options.mirrored, options.largest_scale), aligned(alignments)]
    )
    return (yield from refine(region.points, noisy, region.size, options.smoothing_radius * region.size))


def candidates(
    drawing: Drawing, region: Query, nodes: Nodes, fitter: Fitter, options: RegionOptions
) -> Stepper[Candidates]:
    """Candidates of all sources.

    Parameters
    ----------
    drawing : Drawing
    region : Query
    nodes : Nodes
    fitter : Fitter
    options : RegionOptions

    Returns
    -------
    Stepper[Candidates]
    """
    contours = drawing.contours
    yield 0.0, "aligning lines"
    alignments = align(contours, region.runs, region.rest, options.mirrored, MOST_ALIGNED)
    chains = chain(contours, region.runs, region.rest, options.mirrored)
    yield 0.2, "comparing descriptors"
    refined = yield from within(refined_correspondences(drawing, region, alignments, options), 0.2, 0.6)
    alike = similarities(nodes, refined, options.joint_tolerance)
    least = max(3, round(LEAST_SHARE * len(region.points)))
    sets = (yield from within(clusters(nodes, refined, alike, least), 0.6, 1.0))[:MOST_CLUSTERS]
    if options.branches:
        sets += [branched(s, nodes, refined, alike) for s in sets]
    linked = [
        (
            fitter.through(refined.node[c], refined.image[c], refined.factor[c], refined.magnitude[c]),
            bool(refined.mirrored[c[0]]),
        )
        for c in (s.members for s in sets)
    ]
    along = [
        [(fitter.start(c.source, c.target, np.ones(len(c.source)), (0.1, 0.1)), c.mirrored) for c in some]
        for some in (chains.found[:MOST_CHAINED], alignments)
    ]
    laid = [
        (np.concatenate([a * nodes.at + b, np.full(len(nodes.at), a)]), flip)
        for a, b, flip in laid_over(
            fitter.target, fitter.sampling.samples.points, region.size, options.mirrored, options.largest_scale
        )
    ]
    near = SAME * region.size
    sources = [_distinct(some, near) for some in (*along, linked, laid)]
    best = [s for some, quota in zip(sources, QUOTAS, strict=True) for s in _first(some, fitter, *quota)]
    others = [s for some in sources for s in _first(some, fitter, EACH_PLACE, EACH_SOURCE)]
    starts = _distinct(best + _promising(others, fitter), near)[: max(MOST_STARTS, len(best))]
    return Candidates(starts, alignments, chains, refined)


def _first(starts: list[Start], fitter: Fitter, each: int, most: int) -> list[Start]:
    """The first candidates of every place, in their order."""
    if not starts:
        return []
    unknowns, mirrored = np.array([u for u, _ in starts]), np.array([flip for _, flip in starts])
    return [starts[i] for i in fitter.apart(unknowns, mirrored, each, most)]


def _promising(starts: list[Start], fitter: Fitter) -> list[Start]:
    """The candidates that bring most lines onto lines, each place with some of its own."""
    if not starts:
        return []
    unknowns, mirrored = np.array([u for u, _ in starts]), np.array([flip for _, flip in starts])
    order = np.argsort(-fitter.promise(unknowns, mirrored), kind="stable")
    return _first([starts[i] for i in order], fitter, EACH_PLACE, MOST_STARTS)


def _distinct(starts: list[Start], near: float) -> list[Start]:
    """The first of every group of candidates that map the query points to nearly the same places."""
    if not starts:
        return []
    unknowns, mirrored = np.array([u for u, _ in starts]), np.array([flip for _, flip in starts])
    return [starts[i] for i in distinct(unknowns, mirrored, np.full(len(starts), near))]
