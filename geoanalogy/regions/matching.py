"""Matching regions (algorithm 3.1): from a drawing and a query to the similar regions, with their dense mappings."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import given, real, shown
from ..errors import InputError
from ..geometry.contours import Complex, Contours, Floats
from ..geometry.drawing import Drawing
from ..progress import Progress, Stepper, run, within
from .candidates import candidates
from .consensus import settled
from .evidence import Evidence, corners_met, evidence, marked_evidence, node_support, support
from .fitting import Fit, Fitter
from .guides import Guides
from .marks import laid, of_marks
from .options import RegionOptions
from .query import Query
from .refinement import Refined
from .retraced import retraced, wanting
from .standing import least_shown
from .transformation import Nodes, TransformationFunction

#: Candidates that are fitted to the end, of each place and in all: usually, and where branches may share a place.
FINALISTS, BRANCH_FINALISTS = (4, 24), (32, 40)
#: Two matches are one target where this share of the samples of the lesser has its counterparts on lines of the better.
SHARED = 0.5
#: The same for branches, which share the lines of their trunk.
ALL_SHARED = 0.85
#: Matches, best first, that are laid along their lines by all that agrees with them, of those that are shown.
MOST_SETTLED = 12


class RegionMatch:
    """A region that is similar to the query, and the mapping to it.

    Attributes
    ----------
    similarity : float
        0 to 1; 1 for an identical copy, a little less where it has only a handful of lines.
    mirrored : bool
        Whether the target is a mirror image.
    coverage : float
        Share of the length of the query's lines that has a counterpart in the target; the rest is extrapolated.
    evidence : Evidence
        The factors of the similarity: those of the fit by which the target was found.
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
        """The matches with at least this similarity; nothing is computed again.

        Parameters
        ----------
        threshold : float

        Returns
        -------
        Matches

        Raises
        ------
        InputError
            For a threshold that is no number.
        """
        if not np.isfinite(real(threshold)):
            raise InputError(f"The threshold is {shown(threshold)}: give a number from 0 to 1.")
        return Matches(self.every, float(threshold), self.refined, self.nodes, self.size)

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
    drawing: Drawing,
    query: ArrayLike | Sequence[ArrayLike],
    options: RegionOptions | None = None,
    progress: Progress | None = None,
) -> Matches:
    """Find the regions of a drawing that are similar to a query region or stroke.

    Parameters
    ----------
    drawing : Drawing
    query : (n, 2) array, or sequence of them
        A ring round a region, or an open stroke along a thin shape; several are a brush, whose parts are one region.
        Scene units.
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


def matching(
    drawing: Drawing, query: ArrayLike | Sequence[ArrayLike], options: RegionOptions | None = None
) -> Stepper[Matches]:
    """The stepper of `match_regions`.

    Parameters
    ----------
    drawing : Drawing
    query : array_like, or sequence of them
    options : RegionOptions or None

    Returns
    -------
    Stepper[Matches]
    """
    given(drawing, Drawing, "the drawing", "Drawing([line, …])")
    options = RegionOptions() if options is None else given(options, RegionOptions, "options", "RegionOptions(…)")
    yield 0.0, "reading the query"
    region = Query.of(drawing, query, options)
    contours = drawing.contours
    if not region.rest:
        return Matches([], 0.0)
    nodes = Nodes.of(region.points, region.spacing, options.neighbourhood)
    fitter = Fitter(contours, region, nodes)
    refined: Refined | None = None
    judge: _Judge | None = None
    fits: list[tuple[Fit, Evidence]] = []
    if of_marks(contours, region):
        yield 0.1, "laying marks over marks"
        marked = laid(fitter, contours, region, options)
        fits = [(m.fit, marked_evidence(fitter, m, options.joint_tolerance)) for m in marked]
    else:
        found = yield from within(candidates(drawing, region, nodes, fitter, options), 0.1, 0.8)
        refined = found.refined
        yield 0.8, "fitting to the lines"
        if found.starts:
            judge = _Judge(region, contours, Guides(fitter, found.chains, found.alignments), options)
            fits = judge.weighed(
                fitter.fit(
                    np.array([u for u, _ in found.starts]),
                    np.array([flip for _, flip in found.starts]),
                    BRANCH_FINALISTS if options.branches else FINALISTS,
                    judge.corners,
                ),
                again=True,
            )
    yield 0.9, "choosing"
    fits.sort(key=lambda f: -f[1].similarity)
    kept = list(_separate(fits, fitter, options.branches))[: options.most]
    chosen = [fit for fit, _ in kept]
    alike, corners = np.array([(e.similarity, e.met) for _, e in kept]).reshape(-1, 2).T
    shown = least_shown(alike, corners, options.threshold, options.contrast)
    if judge:
        count = sum(measured.similarity >= shown for _, measured in kept[:MOST_SETTLED])
        chosen[:count] = settled(fitter, chosen[:count], judge.guides, judge.similarity)
    every = [
        RegionMatch(drawing, fit, measured, node_support(fitter, support(fit)))
        for fit, (_, measured) in zip(chosen, kept, strict=True)
    ]
    return Matches(every, shown, refined, nodes, region.size)


@dataclass(frozen=True)
class _Judge:
    """What fits to lines are worth, with the chains and alignments that were found."""

    region: Query
    contours: Contours
    guides: Guides
    options: RegionOptions

    def corners(self, unknowns: Complex, mirrored: NDArray[np.bool_]) -> Floats:
        """Evidence of the chains that agree with functions, (h,) from 0 to 1."""
        chained, _ = self.guides.agreement(unknowns, mirrored)
        return corners_met(chained, self.guides.most)

    def weighed(self, fits: list[Fit], again: bool) -> list[tuple[Fit, Evidence]]:
        """Fits with their evidence; `again`: chains are retraced along those that have little."""
        guides = self.guides
        unknowns = np.array([f.function.unknowns for f in fits])
        chained, along = guides.agreement(unknowns, np.array([f.function.mirrored for f in fits]))
        if again:
            weak = wanting(guides.fitter, fits, corners_met(chained, guides.most))
            found = retraced(self.contours, self.region, guides.fitter, [fits[i] for i in weak], self.options.mirrored)
            chained[weak] = np.maximum(chained[weak], found)
        tolerance = self.options.joint_tolerance
        return [
            (fit, evidence(guides.fitter, self.region, fit, (float(c), guides.most), float(a), tolerance))
            for fit, c, a in zip(fits, chained, along, strict=True)
        ]

    def similarity(self, fits: list[Fit]) -> Floats:
        """How alike the targets of fits are, (k,)."""
        return np.array([measured.similarity for _, measured in self.weighed(fits, again=False)])


def _separate(found: list[tuple[Fit, Evidence]], fitter: Fitter, branches: bool) -> Iterator[tuple[Fit, Evidence]]:
    """The matches, best first, without those that repeat better ones.

    A match repeats where most of its counterparts lie on lines that better matches have taken; of branches, that may
    share a trunk with one and a twig with another, only where nearly all lie on the lines of one better match.
    """
    taken: list[NDArray[np.bool_]] = []
    for fit, measured in found:
        at = fit.counterpart[fit.counterpart >= 0]
        if not len(at):
            continue
        if branches:
            repeats = any(own[at].mean() > ALL_SHARED for own in taken)
        else:
            repeats = bool(taken) and bool(np.any(taken, axis=0)[at].mean() > SHARED)
        if not repeats:
            taken.append(_lines_of(fit, fitter))
            yield fit, measured


def _lines_of(fit: Fit, fitter: Fitter) -> NDArray[np.bool_]:
    """The points of the target's lines that a match takes: those between its counterparts."""
    target = fitter.target
    at = fit.counterpart[fit.counterpart >= 0]
    scale = np.abs(fit.function.factor).mean()
    reach = np.ceil(2.0 * fitter.sampling.samples.step.max() * scale / target.spacing[at]).astype(int)
    out = np.zeros(len(target.points), bool)
    for offset in range(-int(reach.max()), int(reach.max()) + 1):
        beside = target.walk(at, np.where(np.abs(offset) <= reach, offset, 0))
        out[beside[beside >= 0]] = True
    return out
