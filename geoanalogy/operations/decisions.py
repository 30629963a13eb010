"""Corrections by hand: results accepted, rejected, or pinned elsewhere; kept by keys, so that they survive a replay."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..poses.pose import Pose
from .element import Element
from .keys import find, from_parent, to_parent


@dataclass(frozen=True)
class Pin:
    """Where the user has put a result, relative to the polygon it stands in.

    Attributes
    ----------
    parent : str
        Id of the polygon.
    position : (float, float)
        From the polygon's centroid, along its main orientation, in sizes of the polygon.
    angle : float
        Direction in radians from the polygon's main orientation.
    mirrored : bool
    scale : float
    """

    parent: str
    position: tuple[float, float]
    angle: float = 0.0
    mirrored: bool = False
    scale: float = 1.0

    @classmethod
    def of(cls, pose: Pose, parent: Polygon, scale: float = 1.0) -> "Pin":
        """The pin that keeps an object where it stands.

        Parameters
        ----------
        pose : Pose
        parent : Polygon
            The polygon of the scene it stands in.
        scale : float

        Returns
        -------
        Pin
        """
        u, v = to_parent([pose.position], parent)[0]
        return cls(str(parent.id), (float(u), float(v)), pose.angle - parent.main_orientation, pose.mirrored, scale)

    def pose(self, parent: Polygon) -> Pose:
        """The pose it stands for.

        Parameters
        ----------
        parent : Polygon

        Returns
        -------
        Pose
            Scene coordinates.
        """
        x, y = from_parent([self.position], parent)[0]
        return Pose((x, y), self.angle + parent.main_orientation, self.mirrored)

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON.

        Returns
        -------
        dict
        """
        return {
            "parent": self.parent,
            "position": list(self.position),
            "angle": self.angle,
            "mirrored": self.mirrored,
            "scale": self.scale,
        }

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> "Pin":
        """The pin that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        Pin

        Raises
        ------
        InputError
            Where something is missing or no number.
        """
        try:
            x, y = plain["position"]
            return cls(
                str(plain["parent"]),
                (float(x), float(y)),
                float(plain.get("angle", 0.0)),
                bool(plain.get("mirrored", False)),
                float(plain.get("scale", 1.0)),
            )
        except (KeyError, TypeError, ValueError):
            raise InputError("a pinned result has no parent or no position; pin it again") from None


@dataclass(frozen=True)
class Decisions:
    """What the user has decided about single results of an operation.

    Attributes
    ----------
    accepted : tuple of str
        Keys of results that stay whatever the threshold and the most per parent say.
    rejected : tuple of str
        Keys of results that are left out. Their places stay empty: no other result moves up.
    pinned : mapping of str to Pin
        Results by their key, and where they stand instead; they stand there even where the replay no longer finds
        them, as long as the polygon they stand in is there.
    """

    accepted: tuple[str, ...] = ()
    rejected: tuple[str, ...] = ()
    pinned: Mapping[str, Pin] = field(default_factory=dict)

    def accept(self, key: str) -> "Decisions":
        """The decisions with one more result accepted.

        Parameters
        ----------
        key : str

        Returns
        -------
        Decisions
        """
        return replace(self, accepted=_with(self.accepted, key), rejected=_without(self.rejected, key))

    def reject(self, key: str) -> "Decisions":
        """The decisions with one more result rejected.

        Parameters
        ----------
        key : str

        Returns
        -------
        Decisions
        """
        pinned = {k: pin for k, pin in self.pinned.items() if k != key}
        return Decisions(_without(self.accepted, key), _with(self.rejected, key), pinned)

    def pin(self, key: str, pin: Pin) -> "Decisions":
        """The decisions with one more result pinned.

        Parameters
        ----------
        key : str
            Key of the result as the operation proposed it; it keeps that key.
        pin : Pin

        Returns
        -------
        Decisions
        """
        return replace(self, rejected=_without(self.rejected, key), pinned={**self.pinned, key: pin})

    def forget(self, key: str) -> "Decisions":
        """The decisions without any about one result.

        Parameters
        ----------
        key : str

        Returns
        -------
        Decisions
        """
        pinned = {k: pin for k, pin in self.pinned.items() if k != key}
        return Decisions(_without(self.accepted, key), _without(self.rejected, key), pinned)

    def following(self, present: Sequence[str]) -> "Decisions":
        """The same about results by the keys that they have now, which say where a result stands.

        Parameters
        ----------
        present : sequence of str
            Keys of all that the operation proposes.

        Returns
        -------
        Decisions
            What nothing is near to keeps its key.
        """
        found = find([*self.rejected, *self.accepted, *self.pinned], present)
        return Decisions(
            tuple(found.get(key, key) for key in self.accepted),
            tuple(found.get(key, key) for key in self.rejected),
            {found.get(key, key): pin for key, pin in self.pinned.items()},
        )

    def apply(
        self, proposed: Sequence[Element], chosen: Sequence[Element], template: Element | None, scene: Scene
    ) -> list[Element]:
        """The results after the corrections.

        Parameters
        ----------
        proposed : sequence of Element
            All results of the operation.
        chosen : sequence of Element
            Those that its settings let pass, in order.
        template : Element or None
            What a pinned result looks like that is no longer among the proposed ones; None: it is left out.
        scene : Scene
            Where the polygons are that pinned results stand in.

        Returns
        -------
        list of Element
            The chosen ones in their order without the rejected, then accepted and pinned ones that were not chosen.
        """
        by_key = {e.key: e for e in proposed}
        decided = [*self.rejected, *self.accepted, *self.pinned]
        found = find(decided, [e.key for e in proposed])
        out = {found[key] for key in self.rejected if key in found}
        kept = {e.key: e for e in chosen if e.key not in out}
        for key in self.accepted:
            if key in found:
                kept.setdefault(found[key], by_key[found[key]])
        ids = {p.id for p in scene.polygons}
        for key, pin in self.pinned.items():
            element = by_key.get(found[key]) if key in found else template
            if element is not None and pin.parent in ids:
                pose = pin.pose(scene.polygon(pin.parent))
                there = found.get(key, key)
                kept[there] = replace(element, pose=pose, parent=pin.parent, scale=pin.scale, key=there)
        return list(kept.values())

    def to_dict(self) -> dict[str, Any]:
        """What has been decided, as plain data.

        Returns
        -------
        dict
            Without the sorts of decisions that there are none of.
        """
        plain: dict[str, Any] = {}
        if self.accepted:
            plain["accepted"] = list(self.accepted)
        if self.rejected:
            plain["rejected"] = list(self.rejected)
        if self.pinned:
            plain["pinned"] = {key: pin.to_dict() for key, pin in self.pinned.items()}
        return plain

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> "Decisions":
        """The decisions that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        Decisions

        Raises
        ------
        InputError
            For a pin that is incomplete.
        """
        return cls(
            tuple(str(key) for key in plain.get("accepted", ())),
            tuple(str(key) for key in plain.get("rejected", ())),
            {str(key): Pin.from_dict(pin) for key, pin in plain.get("pinned", {}).items()},
        )


def _with(keys: tuple[str, ...], key: str) -> tuple[str, ...]:
    return keys if key in keys else (*keys, key)


def _without(keys: tuple[str, ...], key: str) -> tuple[str, ...]:
    return tuple(k for k in keys if k != key)
