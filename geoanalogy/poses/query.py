"""What the example says: relation values, directions and local importance at its samples (sections 4.2 to 4.4)."""

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from ..relations.observation import Observation
from ..relations.table import RELATIONS, Kind, Positional
from .arrangement import Arrangement
from .options import PoseOptions
from .pose import Pose

Array = NDArray[np.float64]

#: Share of the normalisation radius n of section 4.4 over which a *sample of a footprint* attends to a feature.
#: Samples lie on the object's sides, nearer to what the side stands in relation to than the centre is, and a side's
#: contact with a wall should outweigh its distance to things across the room. Of 0.25, 0.4, 0.7 and 1 tried on
#: furnished rooms, 0.4 placed most fixtures right.
FOOTPRINT_REACH = 0.4

#: Distance from a boundary, in sizes of its polygon, at which a sample lies on it.
ON_BOUNDARY = 1e-6

#: Cosine of how far what is upright may lean: 45 degrees.
UPRIGHT = 0.7071

#: Weight with which the centre of a footprint attends to everything in the room, however far: where what is near leaves
#: several places (the corners of a rectangular room), the door across it decides.
CONTEXT = 0.05

#: Features of lower local importance than this are left out: they cost as much as the others and decide nothing.
LEAST_IMPORTANCE = 0.02


def footprint_samples(footprint: Array | None) -> Array:
    """The points of an object that stand in relations: its centre, and the sides and corners of its box.

    Parameters
    ----------
    footprint : ndarray of shape (n, 2) or None
        Ring in the pose's frame; None: a point.

    Returns
    -------
    ndarray of shape (9, 2) or (1, 2)
        In the pose's frame; the pose's own position is the first.
    """
    if footprint is None:
        return np.zeros((1, 2))
    low, high = footprint.min(axis=0), footprint.max(axis=0)
    x, y = (low + high) / 2
    sides = [(low[0], y), (high[0], y), (x, low[1]), (x, high[1])]
    corners = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    return np.array([(0.0, 0.0), *sides, *corners])


@dataclass(frozen=True)
class Question:
    """What the example asks of one type of element.

    Attributes
    ----------
    relations : tuple of Positional
    feature, sample : ndarray of shape (k,), int
        The example's feature and the sample of each entry; ordered by feature, then sample.
    weight : ndarray of shape (relations, k)
        Local importance I_l of the feature for the sample, times the user's weights.
    value : ndarray of shape (relations, k)
        The relation's value at the sample.
    turn : ndarray of shape (relations, k)
        Directional relation: the pose's direction less the reference direction.
    inner : ndarray of shape (k,), bool
        Whether the sample is on the interior's side of the feature's boundary; and
    contact : ndarray of shape (k,)
        its distance from where the side changes: near it the side means nothing.
    """

    relations: tuple[Positional, ...]
    feature: NDArray[np.intp]
    sample: NDArray[np.intp]
    weight: Array
    value: Array
    turn: Array
    inner: NDArray[np.bool_]
    contact: Array


class Query:
    """The example: a pose in its arrangement, reduced to what is asked of other places.

    Parameters
    ----------
    arrangement : Arrangement
        The example's parent and its members.
    pose : Pose
    footprint : ndarray of shape (n, 2) or None
        Ring in the pose's frame.
    options : PoseOptions

    Attributes
    ----------
    samples : ndarray of shape (s, 2)
        In the pose's frame.
    questions : dict of ElementType to Question
    total : float
        Sum of all weights: the importance of a perfect copy before normalisation.
    width : float
        Half-width of level sets in scene units.
    """

    def __init__(self, arrangement: Arrangement, pose: Pose, footprint: Array | None, options: PoseOptions) -> None:
        self.arrangement = arrangement
        self.pose = pose
        self.footprint = footprint
        self.options = options
        self.rigid = footprint is not None and options.accumulation == "footprint"
        self.samples = footprint_samples(footprint if self.rigid else None)
        self.width = options.level_set_width * arrangement.parent.size
        seen = Observation(arrangement.elements, pose.to_scene(self.samples))
        self._context = self.rigid
        #: What is made of the example for any arrangement that it is compared with.
        self.derived: dict[Hashable, Any] = {}
        self.questions = {t: q for t in ElementType if (q := self._question(t, seen)) is not None}
        self.total = float(sum(q.weight.sum() for q in self.questions.values()))
        if not self.total and not self._context:
            # In the middle of a circle the importance of section 4.4 is 0 for everything: only the context is left.
            self._context = True
            self.questions = {t: q for t in ElementType if (q := self._question(t, seen)) is not None}
            self.total = float(sum(q.weight.sum() for q in self.questions.values()))

    def is_upright(self, angle: Array, mirrored: bool | NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Whether the side that is up at the example is up, where the option `upright` asks for it.

        Parameters
        ----------
        angle : ndarray of shape (m,)
            Directions of poses, radians.
        mirrored : bool or ndarray of shape (m,), bool
            Whether they are mirrored.

        Returns
        -------
        ndarray of shape (m,), bool
        """
        if not self.options.upright:
            return np.ones(len(angle), dtype=bool)
        # A mirrored object is flipped across its direction before it is turned.
        flipped = np.asarray(mirrored) != self.pose.mirrored
        up = np.where(flipped, -np.cos(angle + self.pose.angle), np.cos(angle - self.pose.angle))
        return np.asarray(up > UPRIGHT)

    def _question(self, element: ElementType, seen: Observation) -> Question | None:
        relations = tuple(r for r in map(RELATIONS.__getitem__, self.options.relations) if r.element is element)
        if not relations:
            return None
        importance = self._local_importance(element, seen)
        feature, sample = np.nonzero(importance >= LEAST_IMPORTANCE)
        weights = self.options.relation_weights
        roles = self.arrangement.roles[element]
        stress = np.array([weights.get(label, 1.0) * weights.get(own, 1.0) for _, label, own in roles]).reshape(-1)
        at = (feature, sample)
        return Question(
            relations=relations,
            feature=feature,
            sample=sample,
            weight=np.array([importance[at] * stress[feature] * weights.get(r.name, 1.0) for r in relations]),
            value=np.array([r.value(seen)[at] for r in relations]),
            turn=np.array([self.pose.angle - reference(r, seen)[at] for r in relations]),
            inner=side(element, seen)[at],
            contact=turning(element, seen)[at],
        )

    def _local_importance(self, element: ElementType, seen: Observation) -> Array:
        """I_l of section 4.4 for every feature and sample."""
        away = distance(element, seen)
        if self.options.local_importance == "constant":
            return np.ones_like(away)
        polygon = seen.elements.polygon_of(element)
        inside = self._inside(seen)
        # Of few polygons is the example inside, and the largest circle in one takes long to find.
        within = zip(seen.elements.polygons, inside.any(axis=1).tolist(), strict=True)
        inscribed = np.array([p.inscribed_radius if holds else 0.0 for p, holds in within])
        enclosing = np.array([2 * p.enclosing_radius for p in seen.elements.polygons])
        # A member as wide as the room would else be attended to across all of it.
        outside = np.minimum(enclosing, 2 * self.arrangement.parent.enclosing_radius)
        radius = np.where(inside[polygon], inscribed[polygon, None], outside[polygon, None])
        importance = np.maximum(0.0, 1 - away / (radius * (FOOTPRINT_REACH if self.rigid else 1.0)))
        if self._context:
            across = 2 * self.arrangement.parent.enclosing_radius
            # Of many alike (hedges, chairs) none says where in the room a place is.
            labels = [p.label for p in seen.elements.polygons[1:]]
            alike = np.array([1, *(labels.count(label) for label in labels)])[polygon]
            importance[:, 0] += CONTEXT / alike * np.maximum(0.0, 1 - away[:, 0] / across)
        return importance

    def _inside(self, seen: Observation) -> NDArray[np.bool_]:
        """Whether samples count as inside polygons, for section 4.4; shape (polygons, samples).

        Of an object whose centre is inside the parent all are: those at a wall lie a rounding error, or what a hand
        slips, to either side of it. Those on a boundary are inside.
        """
        size = np.array([p.size for p in seen.elements.polygons])
        inside: NDArray[np.bool_] = seen.inside | (seen.boundary.distance <= ON_BOUNDARY * size[:, None])
        inside[0] |= inside[0, 0]
        return inside


def distance(element: ElementType, seen: Observation) -> Array:
    """Distance R_fd from elements to points: what the local importance of section 4.4 is taken from.

    Parameters
    ----------
    element : ElementType
    seen : Observation

    Returns
    -------
    ndarray of shape (elements, points)
    """
    if element is ElementType.POLYGON:
        return seen.boundary.distance
    return seen.segment.distance if element is ElementType.SEGMENT else seen.corner[0]


def side(element: ElementType, seen: Observation) -> NDArray[np.bool_]:
    """Whether points lie on the interior's side of elements.

    Distances have no sign: without this a place inside a bed would answer to one beside it. Corners need no side,
    their ratio tells it.

    Parameters
    ----------
    element : ElementType
    seen : Observation

    Returns
    -------
    ndarray of shape (elements, points), bool
    """
    if element is ElementType.CORNER:
        return np.ones((len(seen.elements.corner_vertex), len(seen.points)), dtype=bool)
    return seen.boundary.left if element is ElementType.POLYGON else seen.segment.left


def turning(element: ElementType, seen: Observation) -> Array:
    """Distance of points from where the side of elements changes: boundaries, and the lines that segments lie on.

    Parameters
    ----------
    element : ElementType
    seen : Observation

    Returns
    -------
    ndarray of shape (elements, points)
    """
    return np.abs(seen.segment.across) if element is ElementType.SEGMENT else distance(element, seen)


def reference(relation: Positional, seen: Observation) -> Array:
    """Reference direction of a relation's directional partner.

    Parameters
    ----------
    relation : Positional
        With a directional partner.
    seen : Observation

    Returns
    -------
    ndarray of shape (elements, points), radians
    """
    assert relation.directional is not None
    return relation.directional.reference(seen)


def is_length(relation: Positional) -> bool:
    """Whether a relation's values scale with the scene.

    Parameters
    ----------
    relation : Positional

    Returns
    -------
    bool
    """
    return relation.kind is Kind.LENGTH
