"""What the user can set about placements."""

from dataclasses import asdict, dataclass, fields
from typing import Any

import numpy as np

from ..arguments import given, is_flag, is_whole, real, shown
from ..errors import InputError


@dataclass(frozen=True)
class PlacementOptions:
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

    threshold: float = 0.5
    tau: float = 1.0
    neighbours: int = 3
    aspect_tolerance: float = 1.0
    area_tolerance: float = 1.5
    mirrored: bool = False
    allow_overlaps: float = 0.02
    forbid_intersections: bool = False
    between: bool = True

    def __post_init__(self) -> None:
        for name in ("aspect_tolerance", "area_tolerance"):
            if not (value := real(getattr(self, name))) > 0:
                raise InputError(f"the option {name} is {shown(getattr(self, name))}; give a positive number")
            object.__setattr__(self, name, value)
        if not 0 < real(self.tau) <= 1000:
            raise InputError(f"the option tau is {shown(self.tau)}; give a positive number up to 1000")
        for name in ("threshold", "allow_overlaps"):
            if not 0 <= real(value := getattr(self, name)) <= 1:
                raise InputError(f"the option {name} is {shown(value)}; give a number from 0 to 1")
        for name in ("tau", "threshold", "allow_overlaps"):
            object.__setattr__(self, name, float(getattr(self, name)))
        if not is_whole(self.neighbours) or not 1 <= self.neighbours <= 1000:
            raise InputError(f"the option neighbours is {shown(self.neighbours)}; give a whole number from 1 to 1000")
        object.__setattr__(self, "neighbours", int(self.neighbours))
        for name in ("mirrored", "forbid_intersections", "between"):
            if not is_flag(value := getattr(self, name)):
                raise InputError(f"the option {name} is {shown(value)}; give True or False")
            object.__setattr__(self, name, bool(value))

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON.

        Returns
        -------
        dict
            An infinite tolerance is None there.
        """
        return {k: None if isinstance(v, float) and np.isinf(v) else v for k, v in asdict(self).items()}

    @classmethod
    def from_dict(cls, plain: dict[str, Any]) -> "PlacementOptions":
        """The inverse of `to_dict`.

        Parameters
        ----------
        plain : dict

        Returns
        -------
        PlacementOptions

        Raises
        ------
        InputError
            For a name that is no option, and for values out of range.
        """
        given(plain, dict, "what is stored as options of placements", "names and values")
        unknown = ", ".join(sorted(str(k) for k in set(plain) - {f.name for f in fields(cls)}))
        if unknown:
            raise InputError(f"{unknown} is no option of placements; it may come from a newer version")
        values: dict[str, Any] = {k: np.inf if v is None else v for k, v in plain.items()}
        return cls(**values)
