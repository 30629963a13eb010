"""Which features of an arrangement answer to which of the example's, and how well (sections 4.4, 4.6 and 4.8)."""

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType, first_of, ranges, run_starts
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
    roles = [[r if options.labels else r[:1] for r in x.roles[element]] for x in (source, target)]
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
class Answers:
    """The pairs of features of one type, laid out for accumulation: an entry per pair and sample.

    Attributes
    ----------
    relations : tuple of Positional
    target, sample : ndarray of shape (e,), int
        The target's feature and the sample of each entry; entries of one pair are neighbours.
    weight, value, turn : ndarray of shape (relations, e)
        As in `Question`, seen through the pair's symmetry.
    inner : ndarray of shape (e,), bool
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
    target: Indices
    sample: Indices
    weight: Array
    value: Array
    turn: Array
    inner: NDArray[np.bool_]
    contact: Array
    per_pair: Indices
    pair_start: Indices
    accuracy: Array
    source_feature: Indices
    target_feature: Indices
    feature_start: Indices

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
        return self._take(np.flatnonzero(self.possible >= share * self.possible.max()))

    @cached_property
    def possible(self) -> Array:
        """The most that each pair can contribute."""
        return self.accuracy * np.add.reduceat(self.weight.sum(axis=0), self.pair_start)

    def _take(self, pairs: Indices) -> "Answers":
        size = self.per_pair[pairs]
        entry = ranges(self.pair_start[pairs], size)
        source = self.source_feature[pairs]
        return Answers(
            relations=self.relations,
            target=self.target[entry],
            sample=self.sample[entry],
            weight=self.weight.take(entry, axis=1),
            value=self.value.take(entry, axis=1),
            turn=self.turn.take(entry, axis=1),
            inner=self.inner[entry],
            contact=self.contact[entry],
            per_pair=size,
            pair_start=first_of(size),
            accuracy=self.accuracy[pairs],
            source_feature=source,
            target_feature=self.target_feature[pairs],
            feature_start=run_starts(source),
        )


def accuracies(query: Query, target: Arrangement) -> dict[ElementType, Array]:
    """I_m of section 4.4 for all types of element that an example asks for.

    Parameters
    ----------
    query : Query
    target : Arrangement

    Returns
    -------
    dict of ElementType to ndarray of shape (source features, target features)
    """
    return {e: matching_accuracy(query.arrangement, target, e, query.options) for e in query.questions}


def answers(query: Query, accuracy: Mapping[ElementType, Array], sense: Sense) -> dict[ElementType, Answers]:
    """Pair the features asked for with those of an arrangement that may answer.

    Parameters
    ----------
    query : Query
    accuracy : mapping of ElementType to ndarray of shape (source features, target features)
        As `accuracies` gives them for the arrangement.
    sense : Sense

    Returns
    -------
    dict of ElementType to Answers
        Without the types of which nothing matches.
    """
    result = {}
    for element, question in query.questions.items():
        seen = [s for s in (_seen_through(y, question, element) for y in sense.symmetries) if s is not None]
        # Entries of one feature are neighbours, and so are its pairs here.
        first = run_starts(question.feature)
        asking = question.feature[first]
        source, feature = np.nonzero(accuracy[element][asking] > LEAST_ACCURACY)
        if not len(source) or not seen:
            continue
        through = np.tile(np.arange(len(seen)), len(source))
        source, feature = np.repeat(source, len(seen)), np.repeat(feature, len(seen))
        size = np.diff(first, append=len(question.feature))[source]
        entry = ranges(first[source], size)
        source, seen_by = asking[source], np.repeat(through, size)
        value, turn = (np.array([s[k] for s in seen]) for k in (0, 1))
        inner = np.array([s[2] for s in seen])
        result[element] = Answers(
            relations=question.relations,
            target=np.repeat(feature, size),
            sample=question.sample[entry],
            weight=question.weight.take(entry, axis=1),
            value=value[seen_by, :, entry].T,
            turn=turn[seen_by, :, entry].T,
            inner=inner[seen_by, entry],
            contact=question.contact[entry],
            per_pair=size,
            pair_start=first_of(size),
            accuracy=accuracy[element][source, feature],
            source_feature=source,
            target_feature=feature,
            feature_start=run_starts(source),
        )
    return result
