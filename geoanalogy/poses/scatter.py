"""Probabilistic pose placement: importance as a distribution that poses are drawn from (section 4.8)."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..arguments import count, number, positive, word
from ..errors import InputError
from ..geometry.scene import Scene
from ..options import Options, option, optional
from ..progress import Progress, Stepper, run
from .arrangement import Arrangement, arrangement_of
from .candidates import accumulate_in_plane
from .model import PoseModel
from .pose import Pose
from .results import PoseResults, PropagatedPose
from .selection import place_generator
from .validation import Validation

Array = NDArray[np.float64]

#: Cells of the distribution, per parent: its kernel is wide, and draws are anywhere in their cell.
CELLS = 2_500

#: Draws that are validated together: shapely takes many outlines as fast as a few.
BATCH = 64


@dataclass(frozen=True)
class ScatterOptions(Options):
    """How poses are drawn.

    Attributes
    ----------
    count : int or None
        Objects per parent.
    density : float or None
        Objects per squared scene unit of the parent, instead of a count; the nearest whole number of them.
    width : float
        Half-width of the kernel as a share of the size of the example's parent: the wider, the more irregular. It takes
        the place of the option `level_set_width`.
    spacing : float or None
        Least distance between two objects, scene units; None: the footprint's greater extent.
    directions : {"best", "random"}
        Whether an object takes the direction of the strongest level set, or any.
    sharpness : float
        Power of the importance that the distribution is proportional to; 1 as in the thesis, more keeps to the best
        places.
    """

    subject = "scatters"

    count: int | None = option(None, optional(count))
    density: float | None = option(None, optional(number, 0))
    width: float = option(0.15, positive)
    spacing: float | None = option(None, optional(number, 0))
    directions: Literal["best", "random"] = option("best", word, "best", "random")
    sharpness: float = option(1.0, number, 0)

    def __post_init__(self) -> None:
        if (self.count is None) == (self.density is None):
            raise InputError("a scatter needs either a count per parent or a density; give one of the two")
        super().__post_init__()

    def number_in(self, area: float) -> int:
        """How many objects a parent gets.

        Parameters
        ----------
        area : float
            Of the parent, squared scene units.

        Returns
        -------
        int
        """
        return self.count if self.count is not None else round((self.density or 0.0) * area)


@dataclass(frozen=True)
class ImportanceField:
    """The importance over one parent, cell by cell.

    Attributes
    ----------
    positions : ndarray of shape (n, 2)
        The cells' centres, where the object may stand.
    importance : ndarray of shape (n,)
        Between 0 and 1, of the best sense and scale.
    angle : ndarray of shape (n,)
        Direction of the strongest level set, radians.
    mirrored : ndarray of shape (n,), bool
    scale : ndarray of shape (n,)
    cell : float
        Distance between neighbouring centres, scene units.
    """

    positions: Array
    importance: Array
    angle: Array
    mirrored: NDArray[np.bool_]
    scale: Array
    cell: float


def importance_field(model: PoseModel, target: Arrangement, cells: int = CELLS) -> ImportanceField:
    """The importance of section 4.5 over a parent, before maxima are looked for.

    Parameters
    ----------
    model : PoseModel
        Its option `level_set_width` is the kernel's width.
    target : Arrangement
        The parent and its members.
    cells : int
        Number of cells over the parent, about.

    Returns
    -------
    ImportanceField
        Cells in which the object's position may be; outside the parent and inside obstacles there are none.
    """
    # One sample: the field is over positions.
    options = replace(model.options, accumulation="plane", threshold=0.0)
    flat = PoseModel(model.source, model.parent, model.pose, model.footprint, options)
    spacing = math.sqrt(target.parent.area / cells)
    fields = target.fields(spacing, spacing)
    source = arrangement_of(model.source, model.parent)
    blocked = Validation(source, model.pose, model.footprint, options).blocked(target, fields, 0.0)
    free = np.flatnonzero(~blocked & fields.covered(0))
    best = np.zeros(len(free))
    angle, scale = np.full(len(free), model.pose.angle), np.ones(len(free))
    mirrored = np.zeros(len(free), dtype=bool)
    for importance in flat.importances(target):
        fields.evaluate(importance.relations)
        value, direction = accumulate_in_plane(importance, fields, free)
        better = value > best
        best[better], angle[better] = value[better], direction[better]
        mirrored[better], scale[better] = importance.mirrored, importance.scale
    return ImportanceField(fields.grid.points[free], best, angle, mirrored, scale, spacing)


class ScatterModel:
    """An example and how poses like it are drawn.

    Parameters
    ----------
    model : PoseModel
        The example.
    options : ScatterOptions
    """

    def __init__(self, model: PoseModel, options: ScatterOptions) -> None:
        self.options = options
        wide = replace(model.options, level_set_width=options.width)
        self.model = PoseModel(model.source, model.parent, model.pose, model.footprint, wide)
        self._source = arrangement_of(model.source, model.parent)
        self._validation = Validation(self._source, model.pose, model.footprint, model.options)
        extent = 0.0 if model.footprint is None else float(np.ptp(model.footprint, axis=0).max())
        self.spacing = extent if options.spacing is None else options.spacing

    def place(self, scene: Scene, seed: int = 0, progress: Progress | None = None) -> PoseResults:
        """Draw poses in every parent that can match.

        Parameters
        ----------
        scene : Scene
        seed : int
            The same seed gives the same poses, in whatever order the scene is.
        progress : callable (fraction, text) -> bool, optional
            Returning False cancels.

        Returns
        -------
        PoseResults
            Parent by parent, as drawn: likely places come early. Fewer than asked for where there is no more room.
            Their importance is the distribution's at their place.

        Raises
        ------
        Cancelled
            When `progress` returned False.
        """
        return run(self.steps(scene, seed), progress)

    def steps(self, scene: Scene, seed: int = 0) -> Stepper[PoseResults]:
        """The stepper behind `place`.

        Parameters
        ----------
        scene : Scene
        seed : int

        Returns
        -------
        generator of (float, str)
            Returns PoseResults.
        """
        targets = [arrangement_of(scene, p) for p in self.model.targets(scene)]
        found: list[PropagatedPose] = []
        for i, target in enumerate(targets):
            yield i / len(targets), f"scattering in {target.parent.label or target.parent.id}"
            found += self._draw(target, place_generator(seed, target.parent, "scatter"))
        scene.memory.settle()
        return PoseResults(found, self.model.footprint)

    def _draw(self, target: Arrangement, generator: np.random.Generator) -> list[PropagatedPose]:
        field = importance_field(self.model, target)
        cells = len(field.importance)
        # A race of exponential clocks: their order is that of drawing without replacement, each cell with a probability
        # in proportion to its weight. Everything is drawn for every cell, so that no draw depends on what was kept.
        clock = generator.exponential(size=cells)
        jitter = generator.uniform(-0.5, 0.5, size=(cells, 2)) * field.cell
        turn = generator.uniform(0.0, 2 * np.pi, size=cells)
        weight = np.where(field.importance > 0, field.importance, 0.0) ** self.options.sharpness
        drawable = np.flatnonzero((weight > 0) & (field.importance > 0))
        order = drawable[np.argsort(clock[drawable] / weight[drawable], kind="stable")]
        angle = turn if self.options.directions == "random" else field.angle
        wanted = self.options.number_in(target.parent.area)
        # Squares as wide as the largest distance that is asked for: what is too near stands in one of nine.
        standing = _Squares(self.spacing * float(field.scale[order].max(initial=0.0)))
        if target.is_at(self._source):
            standing.add(self.model.pose.position)
        kept: list[PropagatedPose] = []
        for first in range(0, len(order), BATCH):
            batch = order[first : first + BATCH]
            places = field.positions[batch] + jitter[batch]
            accepted = self._accepted(target, places, angle[batch], field, batch)
            for cell, place in zip(batch[accepted], places[accepted], strict=True):
                if len(kept) >= wanted:
                    return kept
                if standing.is_free(place, self.spacing * field.scale[cell]):
                    pose = Pose((place[0], place[1]), angle[cell] % (2 * np.pi), bool(field.mirrored[cell]))
                    importance = min(1.0, float(field.importance[cell]))
                    kept.append(PropagatedPose(pose, importance, target.parent, float(field.scale[cell])))
                    standing.add(pose.position)
        return kept

    def _accepted(
        self, target: Arrangement, places: Array, angle: Array, field: ImportanceField, batch: NDArray[np.intp]
    ) -> NDArray[np.bool_]:
        """Which poses are upright and intersect nothing that the example does not (section 4.8)."""
        mirrored, scale = field.mirrored[batch], field.scale[batch]
        accepted = self._validation.accepts(target, places, angle, mirrored, scale)
        if self.options.directions == "best":
            accepted &= self.model.query.is_upright(angle, mirrored)
        return accepted

    def to_dict(self) -> dict[str, Any]:
        """The model as plain data.

        Returns
        -------
        dict
        """
        return {"model": self.model.to_dict(), "options": asdict(self.options)}

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> "ScatterModel":
        """The model that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        ScatterModel

        Raises
        ------
        InputError
            Where something is missing or is not what it should be.
        """
        try:
            return cls(PoseModel.from_dict(plain["model"]), ScatterOptions.from_dict(plain["options"]))
        except (KeyError, TypeError) as error:
            raise InputError(f"the stored scatter lacks or garbles {error}; record the operation again") from error


class _Squares:
    """Places in squares of a grid, so that those near another place are found without looking at all."""

    def __init__(self, side: float) -> None:
        self._side = side
        self._places: dict[tuple[int, int], list[Sequence[float]]] = {}

    def _square(self, place: Sequence[float]) -> tuple[int, int]:
        return (math.floor(place[0] / self._side), math.floor(place[1] / self._side)) if self._side else (0, 0)

    def add(self, place: Sequence[float]) -> None:
        self._places.setdefault(self._square(place), []).append(place)

    def is_free(self, place: Sequence[float], distance: float) -> bool:
        """Whether nothing stands nearer than a distance, which is at most the side of a square."""
        if distance <= 0:
            return True
        x, y = self._square(place)
        near = (self._places.get((x + i, y + j), ()) for i in (-1, 0, 1) for j in (-1, 0, 1))
        return all(math.dist(place, other) >= distance for square in near for other in square)
