"""Matching regions (algorithm 3.1): from a drawing and a query to the similar regions, with their dense mappings."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..geometry.contours import Complex, Floats
from ..geometry.drawing import Drawing
from ..progress import Progress, Stepper, run
from .alignment import align
from .evidence import Evidence, evidence, node_support, support
from .fitting import Fit, Fitter
from .options import RegionOptions
from .query import Query
from .transformation import Nodes, TransformationFunction

#: Candidates that are fitted to the lines at most.
MOST_CANDIDATES = 24
#: Candidates whose query points land on average nearer than this, in extents of the query, are one.
SAME = 0.04
#: Two matches are one target where this share of the samples of the lesser has its counterparts on lines of the better.
SHARED = 0.5


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
    """

    def __init__(self, every: Sequence[RegionMatch], threshold: float):
        self.every = list(every)
        self.threshold = threshold
        self._shown = [m for m in self.every if m.similarity >= threshold]

    def above(self, threshold: float) -> "Matches":
        """The matches with at least this similarity; nothing is computed again."""
        return Matches(self.every, threshold)

    def __len__(self) -> int:
        return len(self._shown)

    def __getitem__(self, index):
        return self._shown[index]


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
    """The stepper of `match_regions`."""
    options = options or RegionOptions()
    yield 0.0, "reading the query"
    region = Query.of(drawing, query, options)
    contours = drawing.contours
    if not region.rest:
        return Matches([], options.threshold)
    nodes = Nodes.of(region.points, region.spacing, options.neighbourhood)
    fitter = Fitter(contours, region, nodes)
    yield 0.1, "aligning lines"
    starts: list[tuple[Complex, bool]] = []
    for a in align(contours, region.runs, region.rest, options.mirrored, 3 * MOST_CANDIDATES):
        starts.append((fitter.start(a.source, a.target, np.ones(len(a.source)), (0.1, 0.1)), a.mirrored))
    starts = _distinct(starts, SAME * region.size)[:MOST_CANDIDATES]
    yield 0.5, "fitting"
    found: list[tuple[float, RegionMatch, Fit]] = []
    if starts:
        fits = fitter.fit(np.array([u for u, _ in starts]), np.array([flip for _, flip in starts]))
        for fit in fits:
            e = evidence(fitter, region, fit, options.joint_tolerance)
            match = RegionMatch(drawing, fit, e, node_support(fitter, support(fit)))
            found.append((match.similarity, match, fit))
    yield 0.9, "choosing"
    found.sort(key=lambda f: -f[0])
    chosen = list(_separate(found, fitter, options.branches))
    return Matches(chosen[: options.most], options.threshold)


def _distinct(starts: list[tuple[Complex, bool]], near: float) -> list[tuple[Complex, bool]]:
    """The first of every group of candidates that map the query points to nearly the same places."""
    kept: list[tuple[Complex, bool]] = []
    for u, flip in starts:
        m = len(u) // 2
        if all(flip != other or np.abs(u[:m] - v[:m]).mean() > near for v, other in kept):
            kept.append((u, flip))
    return kept


def _separate(found: list[tuple[float, RegionMatch, Fit]], fitter: Fitter, branches: bool) -> Iterator[RegionMatch]:
    """The matches, best first, without those that mostly repeat a better one."""
    taken = np.zeros(len(fitter.target.points), bool)
    for _, match, fit in found:
        at = fit.counterpart[fit.counterpart >= 0]
        if not len(at):
            continue
        if taken[at].mean() > (0.9 if branches else SHARED):
            continue
        scale = np.abs(fit.function.factor).mean()
        reach = np.ceil(2.0 * fitter.samples.step.max() * scale / fitter.target.spacing[at]).astype(int)
        for offset in range(-int(reach.max()), int(reach.max()) + 1):
            beside = fitter.target.walk(at, np.where(np.abs(offset) <= reach, offset, 0))
            taken[beside[beside >= 0]] = True
        yield match
