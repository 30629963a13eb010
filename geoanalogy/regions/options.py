"""The options of matching regions."""

from dataclasses import dataclass

from ..arguments import count, flag, number, word
from ..options import Options, option


@dataclass(frozen=True)
class RegionOptions(Options):
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

    subject = "regions"

    threshold: float = option(0.4, number, 0, 1)
    contrast: float = option(0.5, number, 0, 1)
    query_kind: str = option("auto", word, "auto", "region", "stroke")
    query_points: int = option(50, count, 8, 400)
    reach: float = option(0.1, number, 0.001, 1)
    mirrored: bool = option(True, flag)
    largest_scale: float = option(12.0, number, 1, 100)
    smoothing_radius: float = option(0.15, number, 0.01, 1)
    neighbourhood: float = option(1.5, number, 0.5, 10)
    joint_tolerance: float = option(0.0, number, 0, 1)
    branches: bool = option(False, flag)
    most: int = option(200, count, 1, 10_000)
