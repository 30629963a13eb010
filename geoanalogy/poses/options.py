"""The options of pose propagation (chapter 4), with their defaults."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from math import inf
from typing import Any, Literal

from ..arguments import given, is_flag, is_whole, listed, points_of, real, shown
from ..errors import InputError
from ..relations.table import POSE_RELATIONS, RELATIONS


@dataclass(frozen=True)
class PoseOptions:
    """How a pose is propagated.

    Attributes
    ----------
    relations : tuple of str
        Names of the positional relationship functions that count; each brings its directional partner (section 4.3).
    threshold : float
        Results below this importance are not returned (0 to 1).
    accumulation : {"footprint", "plane", "pose space"}
        Where level sets are accumulated. "plane": positions, keeping the direction of the best match (section 4.5).
        "pose space": positions and directions, sparse (section 4.9). "footprint": sides and corners of the footprint,
        moved rigidly, stand in relations as well as its centre; with a point for a footprint this is "plane". The
        importance reported is always taken in pose space.
    cells : int
        Number of grid points over the parents that can match (section 4.5: 100 000 over the scene).
    direction_bins : int
        Directions of the pose space grid (section 4.9: 100).
    level_set_width : float
        Half-width of the level sets' linear fall-off, as a share of the size of the example's parent (the side of a
        square of equal area).
    direction_width : float
        Half-width of the fall-off over directions, in radians.
    mirror : bool or None
        Whether mirrored poses are wanted (section 4.6). None: where the footprint is its own mirror image, so that a
        mirrored pose needs no mirrored object.
    upright : bool
        Whether the side of the object that is up at the example stays up: y points upwards on a wall, where what is
        turned upside down stands in the same relations, but hangs wrong.
    symmetries : bool
        Whether combinations of a feature's symmetry axes count too (section 4.6): reflections about its own line and
        half turns.
    scale : {"fixed", "room"}
        "fixed": the object keeps its size and lengths count in scene units. "room": each parent is also tried with the
        object and all lengths in proportion to the parent's size, and the better answer is kept; its `scale` says
        which.
    labels : bool
        Whether only features of equal label match (section 4.8).
    other_parents : bool
        Whether parents of another label than the example's may hold answers, where members of equal label (a bed, a
        door) carry them.
    local_importance : {"distance", "constant"}
        I_l of section 4.4, or 1 for every feature (figure 4.13).
    matching_accuracy : {"features", "constant"}
        I_m of section 4.4, or 1 for every pair of features that may match (figure 4.13).
    relation_weights : mapping of str to float
        Factor per relation name or label of the example's features, to mute (0) or stress what the distance alone does
        not tell (figure 4.19).
    validate : bool
        Whether poses that intersect what the example does not are removed (section 4.8), and those that stand before
        openings which the example leaves free are worth less.
    alternative_geometry : mapping of str to sequence of (float, float)
        Ring in scene coordinates per polygon id that stands for the polygon in validation: a door with its swing.
    clearance : mapping of str to float
        Width per label by which polygons of that label are widened in validation.
    max_per : mapping of str to int
        Most results per parent of a label (section 4.8).
    spacing : float or None
        Least distance between two results: the radius of non-maximum suppression (section 4.8, density). None: the
        footprint's own reach.
    candidates : int
        Most results per parent, unless `max_per` says fewer.
    """

    relations: tuple[str, ...] = tuple(r.name for r in POSE_RELATIONS)
    threshold: float = 0.1
    accumulation: Literal["footprint", "plane", "pose space"] = "footprint"
    cells: int = 100_000
    direction_bins: int = 100
    level_set_width: float = 0.03
    direction_width: float = 0.26
    mirror: bool | None = None
    upright: bool = False
    symmetries: bool = False
    scale: Literal["fixed", "room"] = "room"
    labels: bool = True
    other_parents: bool = False
    local_importance: Literal["distance", "constant"] = "distance"
    matching_accuracy: Literal["features", "constant"] = "features"
    relation_weights: Mapping[str, float] = field(default_factory=dict)
    validate: bool = True
    alternative_geometry: Mapping[str, Sequence[tuple[float, float]]] = field(default_factory=dict)
    clearance: Mapping[str, float] = field(default_factory=dict)
    max_per: Mapping[str, int] = field(default_factory=dict)
    spacing: float | None = None
    candidates: int = 12

    def __post_init__(self) -> None:
        known = [r for r, row in RELATIONS.items() if row.directional is not None]
        relations = listed(self.relations, "the option relations", "a list of names of relations")
        unknown = ", ".join(f"{r}" for r in relations if not isinstance(r, str) or r not in known)
        if unknown or not relations:
            raise InputError(f"no relation of poses is called {unknown or 'nothing'}; choose from {', '.join(known)}")
        read: dict[str, Any] = {"relations": relations}
        for name, least in (("cells", 1), ("direction_bins", 4), ("candidates", 1)):
            read[name] = _count(getattr(self, name), f"the option {name}", least)
        for name, most in (("level_set_width", 10.0), ("direction_width", 7.0)):
            value = getattr(self, name)
            if not 0 < real(value) <= most:
                raise InputError(f"the option {name} is {shown(value)}; give a positive number up to {most:g}")
            read[name] = float(value)
        if not 0 <= real(self.threshold) <= 1:
            raise InputError(f"the option threshold is {shown(self.threshold)}; give a number from 0 to 1")
        read["threshold"] = float(self.threshold)
        if self.spacing is not None:
            read["spacing"] = _length(self.spacing, "the option spacing")
        for name in ("mirror", "upright", "symmetries", "labels", "other_parents", "validate"):
            value = getattr(self, name)
            if not is_flag(value) and not (value is None and name == "mirror"):
                raise InputError(f"the option {name} is {shown(value)}; give True or False")
            read[name] = None if value is None else bool(value)
        choices = {
            "accumulation": ("footprint", "plane", "pose space"),
            "scale": ("fixed", "room"),
            "local_importance": ("distance", "constant"),
            "matching_accuracy": ("features", "constant"),
        }
        for name, allowed in choices.items():
            value = getattr(self, name)
            if not isinstance(value, str) or value not in allowed:
                raise InputError(f"the option {name} is {shown(value)}; choose from {', '.join(allowed)}")
        read["relation_weights"] = self._each("relation_weights", "a factor per relation or label", _length)
        read["clearance"] = self._each("clearance", "a width per label", _length)
        read["max_per"] = self._each("max_per", "a number of results per label", _count)
        read["alternative_geometry"] = self._each("alternative_geometry", "a ring per polygon id", _outline)
        for name, value in read.items():
            object.__setattr__(self, name, value)

    def _each(self, name: str, remedy: str, read: Callable[[Any, str], Any]) -> dict[str, Any]:
        """An option that is a mapping, its values read one by one."""
        plain = given(getattr(self, name), Mapping, f"the option {name}", remedy)
        return {str(key): read(value, f"the option {name} of {key!r}") for key, value in plain.items()}

    def to_dict(self) -> dict[str, Any]:
        """What differs from the defaults, as plain data.

        Returns
        -------
        dict
        """
        default = asdict(PoseOptions())
        return {k: list(v) if isinstance(v, tuple) else v for k, v in asdict(self).items() if v != default[k]}

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> "PoseOptions":
        """The options that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        PoseOptions

        Raises
        ------
        InputError
            For a name that is no option.
        """
        given(plain, Mapping, "what is stored as options of pose propagation", "names and values")
        unknown = ", ".join(sorted(str(k) for k in set(plain) - {f.name for f in fields(cls)}))
        if unknown:
            raise InputError(f"{unknown} is no option of pose propagation; it may come from a newer version")
        return cls(**plain)


def _count(value: Any, name: str, least: int = 0) -> int:
    """A whole number of something."""
    if not is_whole(value) or value < least:
        raise InputError(f"{name} is {shown(value)}; give a whole number, at least {least}")
    return int(value)


def _length(value: Any, name: str) -> float:
    """A finite number that is not negative."""
    if not 0 <= real(value) < inf:
        raise InputError(f"{name} is {shown(value)}; give a finite number that is not negative")
    return float(value)


def _outline(value: Any, name: str) -> list[list[float]]:
    """A ring, which may cross itself, as plain data."""
    ring = points_of(value, f"the points of {name}")
    if ring.ndim != 2 or len(ring) < 3:
        raise InputError(f"{name} is {shown(value)}; give the three or more vertices of a ring")
    return ring.tolist()  # type: ignore[no-any-return]
