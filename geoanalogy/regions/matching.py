"""Matching regions (algorithm 3.1): from a drawing and a query to the similar regions, with their dense mappings."""

from collections.abc import Iterator, Sequence
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..geometry.contours import Complex, Floats
from ..geometry.drawing import Drawing
from ..progress import Progress, Stepper, run, within
from .alignment import align
from .correspondences import Correspondences, aligned, described
from .evidence import Evidence, evidence, node_support, support
from .fitting import FINALISTS, Fit, Fitter
from .groups import laid_over
from .linkage import branched, clusters, similarities
from .options import RegionOptions
from .query import Query
from .refinement import Refined, refine
from .transformation import Nodes, TransformationFunction

#: Aligned lines and sets of correspondences that become candidates at most.
MOST_ALIGNED, MOST_CLUSTERS = 80, 60
#: Candidates of each place, and of each source (aligned lines, sets of correspondences, groups of lines), that are
#: fitted; and those of each place that are fitted to the end where branches may share a place.
EACH_PLACE, EACH_SOURCE, BRANCH_FINALISTS = 6, 32, 16
#: Share of the query points that a set of correspondences must have.
LEAST_SHARE = 0.15
#: Candidates whose query points land on average nearer than this, in extents of the query, are one.
SAME = 0.04
#: Two matches are one target where this share of the samples of the lesser has its counterparts on lines of the better.
SHARED = 0.5
#: The same for branches, which share the lines of their trunk.
ALL_SHARED = 0.85


#: Unknowns of a function to start from, and whether it is mirrored.
Start = tuple[Complex, bool]


class RegionMatch:
    """A region that is similar to the query, and the mapping to it.

    Attributes
    ----------
    similarity : float
        0 to 1; 1 for an identical copy.
    mirrored : bool
        Whether the target is a mirror image.
    coverage : float
        Share of the length of the query's lines that has a counterpart in the target; the rest is extrapolated.
    evidence : Evidence
        The factors of the similarity.
    function : TransformationFunction
        The transformation function in the drawing's frame.
    """

    def __init__(self, drawing: Drawing, fit: Fit, found: Evidence, nodes: Floats):
        self._drawing = drawing
        self._node_support = nodes
        self.function: TransformationFunction = fit.function
        self.evidence = found
        self.similarity = found.similarity
        self.mirrored = found.mirrored
        self.coverage = found.coverage

    def map(self, points: ArrayLike) -> NDArray[np.float64]:
        """The dense mapping: points of the query region to points of the target.

        Parameters
        ----------
        points : (n, 2) array
            Scene units. Points outside the query region are extrapolated.

        Returns
        -------
        (n, 2) float
        """
        return self._drawing.out_of_frame(self.function(self._drawing.into_frame(points)))

    def confidence(self, points: ArrayLike) -> Floats:
        """How well the mapping is supported: 1 where lines of the target agree, 0 where it is extrapolated.

        Parameters
        ----------
        points : (n, 2) array
            Scene units.

        Returns
        -------
        (n,) float
        """
        return self.function.nodes.blend(self._drawing.into_frame(points)) @ self._node_support

    def __repr__(self) -> str:
        mirrored = ", mirrored" if self.mirrored else ""
        return f"RegionMatch(similarity={self.similarity:.3f}, coverage={self.coverage:.2f}{mirrored})"


class Matches(Sequence[RegionMatch]):
    """The matches of a query, best first.

    Parameters
    ----------
    every : sequence of RegionMatch
        All targets that were found, best first, those below the threshold as well.
    threshold : float
        Least similarity of those that are shown.
    refined : Refined, optional
        The refined correspondences, for a view of the transformation space.
    nodes : Nodes, optional
        The query points.
    size : float
        Extent of the query in the drawing's frame.
    """

    def __init__(
        self,
        every: Sequence[RegionMatch],
        threshold: float,
        refined: Refined | None = None,
        nodes: Nodes | None = None,
        size: float = 1.0,
    ):
        self.every = list(every)
        self.threshold = threshold
        self.refined, self.nodes, self.size = refined, nodes, size
        self._shown = [m for m in self.every if m.similarity >= threshold]

    def above(self, threshold: float) -> "Matches":
        """The matches with at least this similarity; nothing is computed again."""
        return Matches(self.every, threshold, self.refined, self.nodes, self.size)

    def __len__(self) -> int:
        return len(self._shown)

    @overload
    def __getitem__(self, index: int) -> RegionMatch: ...

    @overload
    def __getitem__(self, index: slice) -> list[RegionMatch]: ...

    def __getitem__(self, index: int | slice) -> RegionMatch | list[RegionMatch]:
        return self._shown[index]

    def __repr__(self) -> str:
        return f"Matches({self._shown!r})"


def match_regions(
    drawing: Drawing, query: ArrayLike, options: RegionOptions | None = None, progress: Progress | None = None
) -> Matches:
    """Find the regions of a drawing that are similar to a query region or stroke.

    Parameters
    ----------
    drawing : Drawing
    query : (n, 2) array
        A ring round a region, or an open stroke along a thin shape; scene units.
    options : RegionOptions, optional
    progress : callable (fraction, text) -> bool, optional
        Returning False cancels.

    Returns
    -------
    Matches
        Best first. The query region itself is never among them.

    Raises
    ------
    InputError
        When the query cannot be used; the sentence says why.
    Cancelled
        When `progress` returned False.
    """
    return run(matching(drawing, query, options), progress)


def matching(drawing: Drawing, query: ArrayLike, options: RegionOptions | None = None) -> Stepper[Matches]:
    """The stepper of `match_regions`.

    Parameters
    ----------
    drawing : Drawing
    query : ndarrayLike
    options : RegionOptions or None

    Returns
    -------
    Stepper[Matches]
    """
    options = options or RegionOptions()
    yield 0.0, "reading the query"
    region = Query.of(drawing, query, options)
    contours = drawing.contours
    if not region.rest:
        return Matches([], options.threshold)
    nodes = Nodes.of(region.points, region.spacing, options.neighbourhood)
    fitter = Fitter(contours, region, nodes)
    yield 0.1, "aligning lines"
    alignments = align(contours, region.runs, region.rest, options.mirrored, MOST_ALIGNED)
    yield 0.2, "comparing descriptors"
    noisy = Correspondences.joined(
        [described(drawing, region, options.mirrored, options.largest_scale), aligned(alignments)]
    )
    refined = yield from within(
        refine(region.points, noisy, region.size, options.smoothing_radius * region.size), 0.3, 0.6
    )
    alike = similarities(nodes, refined, options.joint_tolerance)
    least = max(3, round(LEAST_SHARE * len(region.points)))
    sets = (yield from within(clusters(nodes, refined, alike, least), 0.6, 0.8))[:MOST_CLUSTERS]
    aligned_starts = [
        (fitter.start(a.source, a.target, np.ones(len(a.source)), (0.1, 0.1)), a.mirrored) for a in alignments
    ]
    if options.branches:
        sets += [branched(s, nodes, refined, alike) for s in sets]
    linked = [
        (
            fitter.through(refined.node[c], refined.image[c], refined.factor[c], refined.magnitude[c]),
            bool(refined.mirrored[c[0]]),
        )
        for c in (s.members for s in sets)
    ]
    laid = [
        (np.concatenate([a * nodes.at + b, np.full(len(nodes.at), a)]), flip)
        for a, b, flip in laid_over(
            fitter.target, fitter.samples.points, region.size, options.mirrored, options.largest_scale
        )
    ]
    starts: list[Start] = []
    for some in (aligned_starts, linked, laid):
        starts += _chosen(_distinct(some, SAME * region.size), fitter)
    starts = _distinct(starts, SAME * region.size)
    yield 0.8, "fitting to the lines"
    found: list[tuple[float, RegionMatch, Fit]] = []
    if starts:
        finalists = BRANCH_FINALISTS if options.branches else FINALISTS
        fits = fitter.fit(np.array([u for u, _ in starts]), np.array([flip for _, flip in starts]), finalists)
        for fit in fits:
            e = evidence(fitter, region, fit, options.joint_tolerance)
            match = RegionMatch(drawing, fit, e, node_support(fitter, support(fit)))
            found.append((match.similarity, match, fit))
    yield 0.9, "choosing"
    found.sort(key=lambda f: -f[0])
    chosen = list(_separate(found, fitter, options.branches))
    best = chosen[0].similarity if chosen else 0.0
    least_shown = max(options.threshold, options.contrast * best)
    return Matches(chosen[: options.most], least_shown, refined, nodes, region.size)


def _chosen(starts: list[Start], fitter: Fitter) -> list[Start]:
    """The first candidates of every place, best first."""
    if not starts:
        return []
    apart = fitter.apart(np.array([u for u, _ in starts]), np.array([flip for _, flip in starts]), EACH_PLACE)
    return [starts[i] for i in apart[:EACH_SOURCE]]


def _distinct(starts: list[Start], near: float) -> list[Start]:
    """The first of every group of candidates that map the query points to nearly the same places."""
    kept: list[Start] = []
    for u, flip in starts:
        m = len(u) // 2
        if all(flip != other or np.abs(u[:m] - v[:m]).mean() > near for v, other in kept):
            kept.append((u, flip))
    return kept


def _separate(found: list[tuple[float, RegionMatch, Fit]], fitter: Fitter, branches: bool) -> Iterator[RegionMatch]:
    """The matches, best first, without those that repeat better ones.

    A match repeats where most of its counterparts lie on lines that better matches have taken; of branches, that may
    share a trunk with one and a twig with another, only where nearly all lie on the lines of one better match.
    """
    taken: list[NDArray[np.bool_]] = []
    for _, match, fit in found:
        at = fit.counterpart[fit.counterpart >= 0]
        if not len(at):
            continue
        if branches:
            repeats = any(own[at].mean() > ALL_SHARED for own in taken)
        else:
            repeats = bool(taken) and bool(np.any(taken, axis=0)[at].mean() > SHARED)
        if not repeats:
            taken.append(_lines_of(fit, fitter))
            yield match


def _lines_of(fit: Fit, fitter: Fitter) -> NDArray[np.bool_]:
    """The points of the target's lines that a match takes: those between its counterparts."""
    target = fitter.target
    at = fit.counterpart[fit.counterpart >= 0]
    scale = np.abs(fit.function.factor).mean()
    reach = np.ceil(2.0 * fitter.samples.step.max() * scale / target.spacing[at]).astype(int)
    out = np.zeros(len(target.points), bool)
    for offset in range(-int(reach.max()), int(reach.max()) + 1):
        beside = target.walk(at, np.where(np.abs(offset) <= reach, offset, 0))
        out[beside[beside >= 0]] = True
    return out
