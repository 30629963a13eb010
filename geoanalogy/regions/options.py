"""The options of matching regions."""

from dataclasses import dataclass

from ..arguments import is_flag, is_whole, real, shown
from ..errors import InputError


@dataclass(frozen=True)
class RegionOptions:
    """What a user may set. Lengths are shares of the query's extent, so that no option depends on units.

    Attributes
    ----------
    threshold : float
        How far a match must stand out of its drawing to be shown (`geoanalogy.regions.standing`), 0 to 1; 0 shows all.
        The least similarity that follows from it, at least the middle of the widest gap between similarities, is the
        `threshold` of the matches. They keep their similarity, so a slider filters them without computing anything
        again (`Matches.above`).
    contrast : float
        The same as a share of how far the best one does: where one place is much more alike than all others, the
        others are clutter.
    query_kind : str
        "region" for a ring, "stroke" for an open line, "auto": a ring where the gap between its ends is no larger than
        one and a half times the longest of its edges, a stroke elsewhere.
    query_points : int
        About how many points the query is sampled with (section 3.4).
    reach : float
        Lines within this distance of a stroke belong to the query: a share of the stroke's length.
    mirrored : bool
        Whether mirrored targets are wanted as well.
    largest_scale : float
        Targets are at most this many times larger, or smaller, than the query.
    smoothing_radius : float
        r_s of eq. 3.3: correspondences within about this distance of a query point speak for it.
    neighbourhood : float
        r_n of eq. 3.8, in spacings of the query points. The thesis prints 0.003 b, ten times less than the spacing of
        its own fifty points; larger values bridge occlusions.
    joint_tolerance : float
        0 asks for transformations that change smoothly everywhere; towards 1, jumps as at a joint are forgiven
        (limitation 3.12c).
    branches : bool
        Whether several targets may share lines, as the branches that leave one trunk do. Otherwise the better of two
        targets that share most of their lines is kept.
    most : int
        Matches that are returned at most.
    """

    threshold: float = 0.4
    contrast: float = 0.5
    query_kind: str = "auto"
    query_points: int = 50
    reach: float = 0.1
    mirrored: bool = True
    largest_scale: float = 12.0
    smoothing_radius: float = 0.15
    neighbourhood: float = 1.5
    joint_tolerance: float = 0.0
    branches: bool = False
    most: int = 200

    def __post_init__(self) -> None:
        for name, low, high in _RANGES:
            value, counts = getattr(self, name), name in _COUNTS
            if not low <= real(value) <= high or (counts and not is_whole(value)):
                number = "whole number" if counts else "number"
                raise InputError(f"The option {name} is {shown(value)}: give a {number} from {low:g} to {high:g}.")
            object.__setattr__(self, name, int(value) if counts else float(value))
        for name in ("mirrored", "branches"):
            if not is_flag(value := getattr(self, name)):
                raise InputError(f"The option {name} is {shown(value)}: give True or False.")
            object.__setattr__(self, name, bool(value))
        if not isinstance(self.query_kind, str) or self.query_kind not in ("auto", "region", "stroke"):
            kind = shown(self.query_kind)
            raise InputError(f'The option query_kind is {kind}: give "auto", "region" or "stroke".')


#: Options that count something.
_COUNTS = ("query_points", "most")

_RANGES = (
    ("threshold", 0.0, 1.0),
    ("contrast", 0.0, 1.0),
    ("query_points", 8, 400),
    ("reach", 0.001, 1.0),
    ("largest_scale", 1.0, 100.0),
    ("smoothing_radius", 0.01, 1.0),
    ("neighbourhood", 0.5, 10.0),
    ("joint_tolerance", 0.0, 1.0),
    ("most", 1, 10_000),
)
