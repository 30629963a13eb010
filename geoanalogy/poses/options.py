"""The options of pose propagation (chapter 4), with their defaults."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from ..arguments import count, flag, listed, number, points_of, positive, shown, word
from ..errors import InputError
from ..options import Options, each, option, optional
from ..relations.table import POSE_RELATIONS, RELATIONS


def _relations(value: Any, name: str) -> tuple[str, ...]:
    """Names of relations that a pose can stand in."""
    known = [r for r, row in RELATIONS.items() if row.directional is not None]
    relations = listed(value, name, "a list of names of relations")
    unknown = ", ".join(f"{r}" for r in relations if not isinstance(r, str) or r not in known)
    if unknown or not relations:
        raise InputError(f"no relation of poses is called {unknown or 'nothing'}; choose from {', '.join(known)}")
    return relations


def _outline(value: Any, name: str) -> list[list[float]]:
    """A ring, which may cross itself, as plain data."""
    ring = points_of(value, f"the points of {name}")
    if ring.ndim != 2 or len(ring) < 3:
        raise InputError(f"{name} is {shown(value)}; give the three or more vertices of a ring")
    return ring.tolist()  # type: ignore[no-any-return]


@dataclass(frozen=True)
class PoseOptions(Options):
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

    subject = "pose propagation"

    relations: tuple[str, ...] = option(tuple(r.name for r in POSE_RELATIONS), _relations)
    threshold: float = option(0.1, number, 0, 1)
    accumulation: Literal["footprint", "plane", "pose space"] = option(
        "footprint", word, "footprint", "plane", "pose space"
    )
    cells: int = option(100_000, count, 1)
    direction_bins: int = option(100, count, 4)
    level_set_width: float = option(0.03, positive, 10)
    direction_width: float = option(0.26, positive, 7)
    mirror: bool | None = option(None, optional(flag))
    upright: bool = option(False, flag)
    symmetries: bool = option(False, flag)
    scale: Literal["fixed", "room"] = option("room", word, "fixed", "room")
    labels: bool = option(True, flag)
    other_parents: bool = option(False, flag)
    local_importance: Literal["distance", "constant"] = option("distance", word, "distance", "constant")
    matching_accuracy: Literal["features", "constant"] = option("features", word, "features", "constant")
    relation_weights: Mapping[str, float] = option({}, each("a factor per relation or label", number, 0))
    validate: bool = option(True, flag)
    alternative_geometry: Mapping[str, Sequence[tuple[float, float]]] = option(
        {}, each("a ring per polygon id", _outline)
    )
    clearance: Mapping[str, float] = option({}, each("a width per label", number, 0))
    max_per: Mapping[str, int] = option({}, each("a number of results per label", count))
    spacing: float | None = option(None, optional(number, 0))
    candidates: int = option(12, count, 1)
