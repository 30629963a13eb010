"""What a propagation returns: ranked poses, thinned without recomputation (sections 4.5 and 4.8)."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isnan
from typing import overload

import numpy as np
import shapely
from numpy.typing import NDArray

from ..arguments import is_whole, real, shown
from ..errors import InputError
from ..geometry.polygon import Polygon
from ..tolerances import TOUCHING_SHARE
from .pose import Pose


@dataclass(frozen=True)
class RelationShare:
    """One relation that carries a result (figure 4.14).

    Attributes
    ----------
    relation : str
        Name of the positional relationship function.
    source, target : str
        Ids of the polygons whose features were matched: the example's and the result's.
    source_feature, target_feature : int
        Number of the feature among those of its type in its polygon.
    weight : float
        Its part of the importance; the weights of a result add up to it.
    """

    relation: str
    source: str
    target: str
    source_feature: int
    target_feature: int
    weight: float


@dataclass(frozen=True)
class PropagatedPose:
    """One place for the object.

    Attributes
    ----------
    pose : Pose
    importance : float
        1 where every relation of the example is met, and no more stands before doors and windows than there.
    parent : Polygon
        The polygon it stands in.
    scale : float
        Size of the object in proportion to the example's for which the relations hold (1 unless the option `scale` is
        "room").
    explain : callable
        Returns what `relations` is; evaluated only when asked for.
    """

    pose: Pose
    importance: float
    parent: Polygon
    scale: float = 1.0
    explain: Callable[[], tuple[RelationShare, ...]] = field(default=tuple, repr=False, compare=False)

    @property
    def mirrored(self) -> bool:
        """Whether the object is mirrored (section 4.6)."""
        return self.pose.mirrored

    @cached_property
    def relations(self) -> tuple[RelationShare, ...]:
        """What carried it, largest first; the weights add up to the importance (figure 4.14)."""
        shares = self.explain()
        # What scale and fronts take off, all of them lose alike.
        total = sum(s.weight for s in shares)
        return tuple(replace(s, weight=s.weight * self.importance / total) for s in shares) if total else shares


class PoseResults(Sequence[PropagatedPose]):
    """Propagated poses, best first.

    Parameters
    ----------
    poses : sequence of PropagatedPose
        In order.
    footprint : ndarray of shape (n, 2) or None
        The object's ring in its own frame, for `disjoint`.
    """

    def __init__(self, poses: Sequence[PropagatedPose], footprint: NDArray[np.float64] | None = None) -> None:
        self._poses = tuple(poses)
        self._footprint = footprint

    def __len__(self) -> int:
        return len(self._poses)

    @overload
    def __getitem__(self, index: int) -> PropagatedPose: ...
    @overload
    def __getitem__(self, index: slice) -> "PoseResults": ...
    def __getitem__(self, index: int | slice) -> "PropagatedPose | PoseResults":
        return PoseResults(self._poses[index], self._footprint) if isinstance(index, slice) else self._poses[index]

    def __iter__(self) -> Iterator[PropagatedPose]:
        return iter(self._poses)

    def __repr__(self) -> str:
        return f"PoseResults({len(self)} poses)"

    def above(self, threshold: float) -> "PoseResults":
        """Those of at least an importance.

        Parameters
        ----------
        threshold : float

        Returns
        -------
        PoseResults

        Raises
        ------
        InputError
            For a threshold that is no number.
        """
        if isnan(real(threshold)):
            raise InputError(f"the threshold is {shown(threshold)}; give a number from 0 to 1")
        return PoseResults([p for p in self._poses if p.importance >= threshold], self._footprint)

    def max_per(self, label: str, count: int) -> "PoseResults":
        """The best few in every parent of a label; other parents keep all of theirs (section 4.8).

        Parameters
        ----------
        label : str
        count : int

        Returns
        -------
        PoseResults

        Raises
        ------
        InputError
            For a count that is no whole number, or negative.
        """
        if not isinstance(label, str):
            raise InputError(f"the label is {shown(label)}; give the text that parents are labelled with")
        if not is_whole(count) or count < 0:
            raise InputError(f"the number of results per {label!r} is {shown(count)}; give a whole number from 0 on")
        taken: dict[str | None, int] = {}
        kept = []
        for p in self._poses:
            if p.parent.label == label:
                taken[p.parent.id] = taken.get(p.parent.id, 0) + 1
                if taken[p.parent.id] > count:
                    continue
            kept.append(p)
        return PoseResults(kept, self._footprint)

    def apart(self, spacing: float) -> "PoseResults":
        """The best ones that keep a distance from all better ones in their parent (section 4.8, density).

        Parameters
        ----------
        spacing : float
            Least distance between two positions, scene units.

        Returns
        -------
        PoseResults

        Raises
        ------
        InputError
            For a distance that is no number.
        """
        if isnan(real(spacing)):
            raise InputError(f"the spacing of the results is {shown(spacing)}; give a distance")
        kept: list[PropagatedPose] = []
        near: dict[str | None, list[tuple[float, float]]] = {}
        for p in self._poses:
            others = near.setdefault(p.parent.id, [])
            if all(np.hypot(p.pose.position[0] - x, p.pose.position[1] - y) >= spacing for x, y in others):
                others.append(p.pose.position)
                kept.append(p)
        return PoseResults(kept, self._footprint)

    def disjoint(self) -> "PoseResults":
        """The best ones whose footprints do not intersect those of better ones: results that can all be placed.

        Returns
        -------
        PoseResults
            All of them where the object is a point.
        """
        if self._footprint is None:
            return self
        outlines = [shapely.Polygon(p.pose.to_scene(self._footprint * p.scale)) for p in self._poses]
        kept: list[int] = []
        per_parent: dict[str | None, list[int]] = {}
        for i, p in enumerate(self._poses):
            others = per_parent.setdefault(p.parent.id, [])
            shared = shapely.area(shapely.intersection([outlines[k] for k in others], outlines[i]))
            if not (shared > TOUCHING_SHARE * outlines[i].area).any():
                others.append(i)
                kept.append(i)
        return PoseResults([self._poses[i] for i in kept], self._footprint)
