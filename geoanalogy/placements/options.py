"""What the user can set about placements."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from math import inf, isinf
from typing import Any, Self

from ..arguments import count, flag, number, positive
from ..options import Options, option


@dataclass(frozen=True)
class PlacementOptions(Options):
    """Options of learning and placing.

    Attributes
    ----------
    threshold : float
        Results with a lower score are not returned, unless `place` is told otherwise.
    tau : float
        The kernel size of section 5.7: below 1 for precise placements, above for tolerant ones.
    neighbours : int
        Elements of every label that a placement has relations to: the nearest ones.
    aspect_tolerance, area_tolerance : float
        The tolerances of eq. 5.9: widths of the Gaussians of the logarithm of the change in aspect and area, against
        the example that is most alike; inf lets a placement take any shape.
    mirrored : bool
        Whether boxes that are found turned inside out (negative width or height) stay, mirrored; section 5.5 removes
        them.
    allow_overlaps : float
        Share of the smaller of two results that they may share.
    forbid_intersections : bool
        Whether results that intersect elements of a label which no example intersects are removed outright (section
        5.5). They always score lower.
    between : bool
        Whether the gap between two neighbours counts as an element where most examples lie in one: "between A and B".

    Raises
    ------
    InputError
        For values out of range.
    """

    subject = "placements"

    threshold: float = option(0.5, number, 0, 1)
    tau: float = option(1.0, positive, 1000)
    neighbours: int = option(3, count, 1, 1000)
    aspect_tolerance: float = option(1.0, positive, inf)
    area_tolerance: float = option(1.5, positive, inf)
    mirrored: bool = option(False, flag)
    allow_overlaps: float = option(0.02, number, 0, 1)
    forbid_intersections: bool = option(False, flag)
    between: bool = option(True, flag)

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON.

        Returns
        -------
        dict
            An infinite tolerance is None there.
        """
        return {k: None if isinstance(v, float) and isinf(v) else v for k, v in asdict(self).items()}

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> Self:
        """The inverse of `to_dict`.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        PlacementOptions

        Raises
        ------
        InputError
            For a name that is no option, and for values out of range.
        """
        if isinstance(plain, Mapping):
            plain = {k: inf if v is None else v for k, v in plain.items()}
        return super().from_dict(plain)
