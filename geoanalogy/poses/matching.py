"""Which features of an arrangement answer to which of the example's, and how well (sections 4.4, 4.6 and 4.8)."""

import enum
import operator
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from ..relations.runs import first_of, ranges, run_starts, sizes
from ..relations.table import BOUNDARY_ANGLE, SEGMENT_ANGLE, Kind, Positional
from .arrangement import Arrangement
from .options import PoseOptions
from .query import Query, Question

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

#: Pairs of features of lower matching accuracy are left out: a level set that weak never decides a maximum.
LEAST_ACCURACY = 0.05

#: Segments that turn by less than this along their length, in radians, are straight: the ratio of two such turns says
#: nothing.
STRAIGHT = 1e-3

#: Distance between a footprint and its mirror image, as a share of its extent, within which it is its own mirror image.
MIRROR_TOLERANCE = 0.01


def matching_accuracy(source: Arrangement, target: Arrangement, element: ElementType, options: PoseOptions) -> Array:
    """I_m of section 4.4 for every pair of features of a type.

    As intended, not as printed: equal corners score ``1 - |c1 - c2| / pi`` = 1, and two straight segments have equal
    curvature. Sizes are compared with those of the parents where lengths are in proportion to the room (option
    `scale`).

    Parameters
    ----------
    source, target : Arrangement
    element : ElementType
    options : PoseOptions

    Returns
    -------
    ndarray of shape (source features, target features)
        0 where labels or roles differ.
    """
    a, b = source.elements, target.elements
    # What must be equal to match: whether they are the parent's, and labels where these count.
    roles = [x.roles[element] if options.labels else [r[:1] for r in x.roles[element]] for x in (source, target)]
    known = {role: k for k, role in enumerate(dict.fromkeys(roles[0]))}
    mine, theirs = (np.array([known.get(r, -1) for r in each], dtype=np.intp) for each in roles)
    may = mine[:, None] == theirs
    if options.matching_accuracy == "constant":
        return may.astype(np.float64)
    if element is ElementType.POLYGON:
        accuracy = _ratio(np.array([p.area for p in a.polygons]), np.array([p.area for p in b.polygons]))
    elif element is ElementType.SEGMENT:
        # Curvature times length is the turn along the segment: free of the unit, so that straightness has one limit.
        turn_a, turn_b = a.segment_curvature * a.segment_length, b.segment_curvature * b.segment_length
        straight = np.maximum(turn_a[:, None], turn_b) <= STRAIGHT
        accuracy = _ratio(a.segment_length, b.segment_length)
        accuracy = accuracy * np.where(straight, 1.0, _ratio(a.segment_curvature, b.segment_curvature))
    else:
        accuracy = 1 - np.abs(a.corner_opening[:, None] - b.corner_opening) / np.pi
    return accuracy * may


def _ratio(a: Array, b: Array) -> Array:
    """The smaller divided by the larger, for every pair; 1 - |a - b| / max(a, b)."""
    larger = np.maximum(a[:, None], b)
    return np.divide(np.minimum(a[:, None], b), larger, out=np.ones_like(larger), where=larger > 0)


#: Values, turns (relations, k) and sides (k,) of a question.
Seen = tuple[Array, Array, NDArray[np.bool_]]


class Symmetry(enum.Enum):
    """A symmetry of features that level sets are taken through (section 4.6)."""

    IDENTITY = "identity"
    ACROSS = "across"  #: reflected about the axis that crosses a feature: a perpendicular bisector, a corner's bisector
    BEHIND = "behind"  #: reflected about a segment's own line, to its other side
    HALF_TURN = "half turn"  #: both, one after the other


@dataclass(frozen=True)
class Sense:
    """One of the two grids of section 4.6: whether poses are mirrored, and the symmetries that lead there.

    Attributes
    ----------
    mirrored : bool
    symmetries : tuple of Symmetry
    """

    mirrored: bool
    symmetries: tuple[Symmetry, ...]


def senses(query: Query) -> list[Sense]:
    """The grids that the options ask for, the one that is not mirrored first.

    Parameters
    ----------
    query : Query

    Returns
    -------
    list of Sense
    """
    wanted = query.options.mirror
    if wanted is None:
        wanted = query.footprint is not None and _is_own_mirror_image(query.footprint)
    more = query.options.symmetries
    result = [Sense(False, (Symmetry.IDENTITY, Symmetry.HALF_TURN) if more else (Symmetry.IDENTITY,))]
    if wanted:
        result.append(Sense(True, (Symmetry.ACROSS, Symmetry.BEHIND) if more else (Symmetry.ACROSS,)))
    return result


def _is_own_mirror_image(footprint: Array) -> bool:
    """Whether a ring equals its reflection about the x axis, vertex for vertex."""
    flipped = footprint * (1.0, -1.0)
    gap = np.hypot(*(footprint[:, None] - flipped).transpose(2, 0, 1)).min(axis=1)
    return bool(gap.max() <= MIRROR_TOLERANCE * np.ptp(footprint, axis=0).max())


def _seen_through(symmetry: Symmetry, question: Question, element: ElementType) -> Seen | None:
    """Values, turns and sides of the question as a pose behind a symmetry has them.

    None where such features have no such symmetry.
    """
    value, turn, inner = question.value, question.turn, question.inner
    if symmetry is Symmetry.IDENTITY:
        return value, turn, inner
    if element is not ElementType.SEGMENT and symmetry is not Symmetry.ACROSS:
        return None  # a corner has one axis; a second one of a polygon leads to the same level sets
    if symmetry is not Symmetry.BEHIND:
        value = np.array([_across(r, v) for r, v in zip(question.relations, value, strict=True)])
        # The boundary's direction runs the other way; directions to a corner or a centroid are reflected with the pose.
        turn = np.array([_turned(r, t) for r, t in zip(question.relations, turn, strict=True)])
    if symmetry is not Symmetry.ACROSS:
        turn, inner = -turn, ~inner
    return value, turn, inner


def _across(relation: Positional, value: Array) -> Array:
    """A value as seen through the axis across its feature."""
    if relation.kind is Kind.ANGLE:
        return -value
    if relation.element is ElementType.CORNER and relation.kind is Kind.RATIO:
        return np.where(value <= 1, 1 - value, 3 - value)
    return 1 - value if relation.kind is Kind.RATIO else value


def _turned(relation: Positional, turn: Array) -> Array:
    return np.pi - turn if relation.directional in (BOUNDARY_ANGLE, SEGMENT_ANGLE) else -turn


@dataclass(frozen=True)
class Layout:
    """The pairs of features of one type, laid out for accumulation: an entry per pair and sample.

    It is the same in both senses and at all scales.

    Attributes
    ----------
    relations : tuple of Positional
    entry : ndarray of shape (e,), int
        Of the question, as often as there are symmetries: the number of the symmetry times that of the question's
        entries, and the number of the entry.
    target, sample : ndarray of shape (e,), int
        The target's feature and the sample of each entry; entries of one pair are neighbours.
    weight : ndarray of shape (relations, e)
        As in `Question`.
    contact : ndarray of shape (e,)
    per_pair, pair_start : ndarray of shape (p,), int
        Number of entries of each pair, and the first of them; pairs of one source feature are neighbours.
    accuracy : ndarray of shape (p,)
        I_m of each pair.
    source_feature, target_feature : ndarray of shape (p,), int
    feature_start : ndarray of shape (f,), int
        First pair of each source feature.
    """

    relations: tuple[Positional, ...]
    entry: Indices
    target: Indices
    sample: Indices
    weight: Array
    contact: Array
    per_pair: Indices
    pair_start: Indices
    accuracy: Array
    source_feature: Indices
    target_feature: Indices
    feature_start: Indices

    @classmethod
    def of(cls, question: Question, accuracy: Array, symmetries: int) -> "Layout":
        """The pairs of features that may answer a question.

        Parameters
        ----------
        question : Question
        accuracy : ndarray of shape (source features, target features)
            As `matching_accuracy` gives it.
        symmetries : int
            How many features of the type are taken through.

        Returns
        -------
        Layout
        """
        # Entries of one feature are neighbours, and so are its pairs here.
        first = run_starts(question.feature)
        asking = question.feature[first]
        source, feature = np.nonzero(accuracy[asking] > LEAST_ACCURACY)
        through = np.tile(np.arange(symmetries), len(source))
        source, feature = source.repeat(symmetries), feature.repeat(symmetries)
        size = sizes(first, len(question.feature))[source]
        entry = ranges(first[source], size)
        source = asking[source]
        return cls(
            relations=question.relations,
            entry=entry + len(question.feature) * through.repeat(size),
            target=feature.repeat(size),
            sample=question.sample[entry],
            weight=question.weight.take(entry, axis=1),
            contact=question.contact[entry],
            per_pair=size,
            pair_start=first_of(size),
            accuracy=accuracy[source, feature],
            source_feature=source,
            target_feature=feature,
            feature_start=run_starts(source),
        )

    @cached_property
    def possible(self) -> Array:
        """The most that each pair can contribute."""
        return self.accuracy * np.add.reduceat(self.weight.sum(axis=0), self.pair_start)

    @cached_property
    def worth(self) -> Array:
        """What meeting each entry is worth: the weight times I_m of its pair; shape (relations, e)."""
        return self.weight * np.repeat(self.accuracy, self.per_pair)

    @cached_property
    def looks(self) -> tuple[Indices, Indices, Indices]:
        """The target feature and sample of all entries that differ in them, and which of these each entry has.

        Several features of the example ask about one.
        """
        samples = int(self.sample.max(initial=0)) + 1
        differing, spread = np.unique(self.target * samples + self.sample, return_inverse=True)
        return differing // samples, differing % samples, spread.ravel()

    @cached_property
    def features(self) -> list[tuple[int, int, int]]:
        """First entry, end and number of samples of each source feature: all its pairs have the same samples."""
        start = self.pair_start[self.feature_start].tolist()
        ends = [*start[1:], len(self.target)]
        return list(zip(start, ends, self.per_pair[self.feature_start].tolist(), strict=True))

    @cached_property
    def _strongest(self) -> "dict[float, tuple[Indices, Layout]]":
        return {}

    def chosen(self, share: float) -> "tuple[Indices, Layout]":
        """The pairs that can contribute much: enough to find where maxima are.

        Parameters
        ----------
        share : float
            Of the strongest pair's contribution, below which a pair is left out.

        Returns
        -------
        entries : ndarray of int
            Their entries.
        layout : Layout
            Theirs.
        """
        if share not in self._strongest:
            pairs = np.flatnonzero(self.possible >= share * self.possible.max())
            size = self.per_pair[pairs]
            entry = ranges(self.pair_start[pairs], size)
            source = self.source_feature[pairs]
            self._strongest[share] = (
                entry,
                Layout(
                    relations=self.relations,
                    entry=self.entry[entry],
                    target=self.target[entry],
                    sample=self.sample[entry],
                    weight=self.weight.take(entry, axis=1),
                    contact=self.contact[entry],
                    per_pair=size,
                    pair_start=first_of(size),
                    accuracy=self.accuracy[pairs],
                    source_feature=source,
                    target_feature=self.target_feature[pairs],
                    feature_start=run_starts(source),
                ),
            )
        return self._strongest[share]


_SHARED = tuple(f.name for f in fields(Layout))
_shared: Callable[[Layout], tuple[Any, ...]] = operator.attrgetter(*_SHARED)


@dataclass(frozen=True)
class Answers(Layout):
    """The pairs of features of one type, and what they are asked in one sense.

    Attributes
    ----------
    layout : Layout
        That of the pairs.
    value, turn : ndarray of shape (relations, e)
        As in `Question`, seen through each pair's symmetry.
    inner : ndarray of shape (e,), bool
    """

    layout: Layout
    value: Array
    turn: Array
    inner: NDArray[np.bool_]

    @classmethod
    def to(cls, layout: Layout, value: Array, turn: Array, inner: NDArray[np.bool_]) -> "Answers":
        """What pairs are asked.

        Parameters
        ----------
        layout : Layout
        value, turn : ndarray of shape (relations, e)
        inner : ndarray of shape (e,), bool

        Returns
        -------
        Answers
        """
        shared = dict(zip(_SHARED, _shared(layout), strict=True))
        return cls(**shared, layout=layout, value=value, turn=turn, inner=inner)

    def strongest(self, share: float) -> "Answers":
        """The pairs that can contribute much: enough to find where maxima are.

        Parameters
        ----------
        share : float
            Of the strongest pair's contribution, below which a pair is left out.

        Returns
        -------
        Answers
        """
        entry, layout = self.layout.chosen(share)
        return Answers.to(layout, self.value.take(entry, axis=1), self.turn.take(entry, axis=1), self.inner[entry])


class Matching:
    """Which features of an arrangement may answer to those that an example asks for.

    Parameters
    ----------
    query : Query
    target : Arrangement
    """

    def __init__(self, query: Query, target: Arrangement) -> None:
        self._query = query
        self._accuracy = {e: matching_accuracy(query.arrangement, target, e, query.options) for e in query.questions}
        self._layouts: dict[tuple[ElementType, int], Layout] = {}
        self._answers: dict[Sense, dict[ElementType, Answers]] = {}

    def answers(self, sense: Sense) -> dict[ElementType, Answers]:
        """Pair the features asked for with those that may answer, in one sense.

        Parameters
        ----------
        sense : Sense

        Returns
        -------
        dict of ElementType to Answers
            Without the types of which nothing matches. The same at all scales; not to be changed.
        """
        if sense not in self._answers:
            every = ((element, self._of(element, sense)) for element in self._query.questions)
            self._answers[sense] = {element: a for element, a in every if a is not None}
        return self._answers[sense]

    def _of(self, element: ElementType, sense: Sense) -> Answers | None:
        symmetries, value, turn, inner = _asked(self._query, element, sense)
        layout = self._layouts.get((element, symmetries))
        if layout is None:
            layout = Layout.of(self._query.questions[element], self._accuracy[element], symmetries)
            self._layouts[element, symmetries] = layout
        if not len(layout.entry):
            return None
        return Answers.to(
            layout, value.take(layout.entry, axis=1), turn.take(layout.entry, axis=1), inner[layout.entry]
        )


def _asked(query: Query, element: ElementType, sense: Sense) -> tuple[int, Array, Array, NDArray[np.bool_]]:
    """Number of symmetries that a type of feature has in a sense, and what is asked through them, one after another."""
    known = query.derived.get((element, sense))
    if known is None:
        seen = [_seen_through(y, query.questions[element], element) for y in sense.symmetries]
        there = [s for s in seen if s is not None]
        value, turn, inner = (np.concatenate([s[k] for s in there], axis=-1) for k in range(3))
        known = query.derived[element, sense] = len(there), value, turn, inner
    return known  # type: ignore[no-any-return]
