"""The options of pose propagation (chapter 4), with their defaults."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Literal

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
        unknown = [r for r in self.relations if r not in RELATIONS or RELATIONS[r].directional is None]
        if unknown or not self.relations:
            known = ", ".join(r for r, row in RELATIONS.items() if row.directional is not None)
            raise InputError(f"no relation of poses is called {', '.join(unknown) or 'nothing'}; choose from {known}")
        for name, least in (("cells", 1), ("direction_bins", 4), ("candidates", 1)):
            if getattr(self, name) < least:
                raise InputError(f"the option {name} is {getattr(self, name)}; give at least {least}")
        for name in ("level_set_width", "direction_width"):
            if not getattr(self, name) > 0:
                raise InputError(f"the option {name} is {getattr(self, name)}; give a positive number")
        choices = {
            "accumulation": ("footprint", "plane", "pose space"),
            "scale": ("fixed", "room"),
            "local_importance": ("distance", "constant"),
            "matching_accuracy": ("features", "constant"),
        }
        for name, allowed in choices.items():
            if getattr(self, name) not in allowed:
                raise InputError(f"the option {name} is {getattr(self, name)!r}; choose from {', '.join(allowed)}")

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
        unknown = set(plain) - {f.name for f in fields(cls)}
        if unknown:
            raise InputError(
                f"{', '.join(sorted(unknown))} is no option of pose propagation; it may come from a newer version"
            )
        given: dict[str, Any] = {k: tuple(v) if k == "relations" else v for k, v in plain.items()}
        return cls(**given)
