"""Region transfer: what is painted on one region of a drawing goes to all similar regions (chapter 3)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..geometry.drawing import Drawing
from ..progress import Stepper
from ..regions.matching import Matches, matching
from ..regions.options import RegionOptions
from .decisions import Decisions
from .layout import Layout
from .operation import Operation
from .settings import number, stored

Points = NDArray[np.float64]

#: Distance, in extents of the query's lines, below which a line of a drawing is one of them: single precision, and the
#: rounding of stored coordinates.
SAME_LINE = 2e-3

#: Difference in length, as a share, below which the lines in a query are those that it was drawn round.
SAME_LENGTH = 0.02

#: Distance of the query's own lines from another drawing that they are put beside, in extents of the larger of the two.
BESIDE = 0.1


@dataclass(frozen=True)
class Target:
    """A region of a drawing that is similar to the query.

    Attributes
    ----------
    similarity : float
        0 to 1.
    mirrored : bool
    coverage : float
        Share of the query's lines that have a counterpart.
    map : callable
        Points (n, 2) of the query to points (n, 2) of the drawing.
    confidence : callable
        Points (n, 2) of the query to how well the mapping is supported there, (n,).
    """

    similarity: float
    mirrored: bool
    coverage: float
    map: Callable[[ArrayLike], Points]
    confidence: Callable[[ArrayLike], Points]


@dataclass(frozen=True)
class Found:
    """What was found in a drawing.

    Attributes
    ----------
    targets : list of Target
        Best first; those below the threshold as well.
    threshold : float
        Least similarity of those that are shown.
    matches : Matches
        The engine's matches behind the targets.
    here : bool
        Whether the query was found in the drawing itself; where not, its own lines were compared with it.
    drawing : Drawing
        What was matched: with the query's own lines, where those were compared with it.
    """

    targets: list[Target]
    threshold: float
    matches: Matches
    here: bool
    drawing: Drawing


def _read_line(value: Any) -> tuple[tuple[float, float], ...]:
    points = tuple((number(x), number(y)) for x, y in value)
    if len(points) < 2:
        raise InputError("a line has fewer than two points")
    return points


def _read_lines(value: Any) -> tuple[tuple[tuple[float, float], ...], ...]:
    return tuple(_read_line(line) for line in value)


def _write_line(line: Sequence[Sequence[float]]) -> list[list[float]]:
    return [[float(x), float(y)] for x, y in line]


def _write_lines(lines: Sequence[Sequence[Sequence[float]]]) -> list[list[list[float]]]:
    return [_write_line(line) for line in lines]


@dataclass(frozen=True, kw_only=True)
class RegionTransfer(Operation):
    """Find the regions of a drawing that are similar to a query, to carry what is painted on it to all of them.

    It works on a drawing, not on the polygons of a layout: there, it passes on what comes in.

    Attributes
    ----------
    query : tuple of (x, y)
        The ring or stroke that the user drew, in the coordinates of the drawing's plane.
    lines : tuple of tuples of (x, y)
        The lines in the query: what is looked for in other drawings.
    options : RegionOptions
    threshold : float
        Targets of less similarity are not shown; nothing is computed again.
    decisions : Decisions
        Targets accepted and rejected by hand.
    """

    type = "region transfer"

    query: tuple[tuple[float, float], ...] = field(metadata=stored(_read_line, _write_line))
    lines: tuple[tuple[tuple[float, float], ...], ...] = field(metadata=stored(_read_lines, _write_lines))
    options: RegionOptions = field(
        default_factory=RegionOptions, metadata=stored(RegionOptions.from_dict, RegionOptions.to_dict)
    )
    threshold: float = field(default=0.0, metadata=stored(number, late=True))
    decisions: Decisions = field(
        default_factory=Decisions, metadata=stored(Decisions.from_dict, Decisions.to_dict, late=True)
    )

    @classmethod
    def of(cls, lines: Sequence[ArrayLike], query: ArrayLike, options: RegionOptions | None = None) -> "RegionTransfer":
        """The operation of a query in a drawing.

        Parameters
        ----------
        lines : sequence of (n, 2) arrays
            The drawing.
        query : (n, 2) array
            A ring or a stroke in the drawing.
        options : RegionOptions, optional

        Returns
        -------
        RegionTransfer

        Raises
        ------
        InputError
            When query or lines have coordinates that are not finite, or no line lies in the query.
        """
        options = options or RegionOptions()
        ring = np.asarray(query, float)
        if ring.ndim != 2 or ring.shape[1:] != (2,) or len(ring) < 2 or not np.isfinite(ring).all():
            raise InputError("The query is no line of finite points: draw it again.")
        inside = _clipped([np.asarray(line, float) for line in lines], region_of(ring, options))
        if not inside:
            raise InputError("No line of the drawing lies in the query: draw the query round the lines to be matched.")
        plain = tuple(tuple((float(x), float(y)) for x, y in line) for line in inside)
        return cls(query=tuple((float(x), float(y)) for x, y in ring), lines=plain, options=options)

    @property
    def region(self) -> shapely.Geometry:
        """The region of the query; of a stroke everything within its reach."""
        return region_of(np.array(self.query), self.options)

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[None]:
        """Nothing: a layout has no drawing."""
        yield from ()

    def decide(self, proposed: None, layout: Layout, node: str) -> tuple[Layout, ...]:
        """What comes in."""
        return (layout,)

    def find_steps(self, lines: Sequence[ArrayLike], smoothing: float = 0.0) -> Stepper[Found]:
        """Find the targets in a drawing, as a stepper.

        Parameters
        ----------
        lines : sequence of (n, 2) arrays
            The drawing; a closed line repeats its first point.
        smoothing : float
            Of noisy lines, as `Drawing` takes it.

        Returns
        -------
        generator of (float, str)
            Returns Found. Where the drawing does not hold the lines of the query where they were drawn, as another
            drawing does not, they are put beside it; then every region of the drawing can be a target.

        Raises
        ------
        InputError
            For what the engine refuses.
        """
        drawn = [np.asarray(line, float) for line in lines]
        if self.is_in(drawn):
            shift = np.zeros(2)
            drawing = Drawing(drawn, smoothing=smoothing)
        else:
            own = [np.array(line) for line in self.lines]
            shift = _beside(own, drawn)
            drawing = Drawing([*(line + shift for line in own), *drawn], smoothing=smoothing)
        matches = yield from matching(drawing, np.array(self.query) + shift, self.options)
        targets = [
            Target(m.similarity, m.mirrored, m.coverage, _after(m.map, shift), _after(m.confidence, shift))
            for m in matches.every
        ]
        return Found(targets, matches.threshold, matches, not shift.any(), drawing)

    def is_in(self, lines: Sequence[ArrayLike]) -> bool:
        """Whether a drawing holds the lines of the query where they were drawn, and no others there.

        Parameters
        ----------
        lines : sequence of (n, 2) arrays

        Returns
        -------
        bool
        """
        now = _clipped([np.asarray(line, float) for line in lines], self.region)
        if not now:
            return False
        before = shapely.multilinestrings([shapely.linestrings(line) for line in self.lines])
        there = shapely.multilinestrings([shapely.linestrings(line) for line in now])
        if abs(there.length - before.length) > SAME_LENGTH * before.length:
            return False
        corners = shapely.points(shapely.get_coordinates(before))
        shapely.prepare(there)
        size = float(np.ptp(shapely.get_coordinates(before), axis=0).max())
        return bool(shapely.dwithin(there, corners, SAME_LINE * size).all())


def region_of(query: Points, options: RegionOptions) -> shapely.Geometry:
    """The region of a query: the inside of a ring, or everything within the reach of a stroke.

    Parameters
    ----------
    query : (n, 2) float
    options : RegionOptions
        Says whether it is a ring; "auto" takes one whose ends meet for a ring.

    Returns
    -------
    shapely geometry
    """
    ring = options.query_kind == "region"
    if options.query_kind == "auto":
        steps = np.linalg.norm(np.diff(query, axis=0), axis=1)
        ring = len(query) > 3 and bool(np.linalg.norm(query[-1] - query[0]) <= 1.5 * steps.max())
    if ring and len(query) > 2:
        return shapely.make_valid(shapely.polygons(query))
    line = shapely.linestrings(query)
    return line.buffer(options.reach * line.length)


def _clipped(lines: Sequence[Points], region: shapely.Geometry) -> list[Points]:
    """The parts of lines that lie in a region; what lies inside as a whole keeps its points and its closing."""
    found = []
    shapely.prepare(region)
    for line in lines:
        if len(line) < 2 or line.ndim != 2 or not np.isfinite(line).all():
            continue
        drawn = shapely.linestrings(line)
        if shapely.covers(region, drawn):
            found.append(line)
        elif shapely.intersects(region, drawn):
            cut = shapely.line_merge(shapely.intersection(drawn, region))
            found += [shapely.get_coordinates(part) for part in shapely.get_parts(cut) if part.length > 0.0]
    return found


def _beside(own: Sequence[Points], drawn: Sequence[Points]) -> Points:
    """How far lines must be moved to stand free at the left of others."""
    if not drawn:
        return np.zeros(2)
    a, b = np.vstack(own), np.vstack([line.reshape(-1, 2) for line in drawn])
    gap = BESIDE * max(float(np.ptp(a, axis=0).max()), float(np.ptp(b, axis=0).max()))
    return np.array([b[:, 0].min() - gap - a[:, 0].max(), b[:, 1].mean() - a[:, 1].mean()])


def _after(function: Callable[[ArrayLike], Points], shift: Points) -> Callable[[ArrayLike], Points]:
    """A function of points that are moved before."""
    return lambda points: function(np.asarray(points, float).reshape(-1, 2) + shift)
