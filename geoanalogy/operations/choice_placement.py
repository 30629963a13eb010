"""Probabilistic selection among several examples (section 4.8)."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..poses.model import PoseModel
from ..poses.selection import PoseChoice
from ..progress import Stepper
from .element import Element
from .layout import Layout
from .placing import Placing, elements_of, read_by, with_distinct_keys
from .pose_placement import sift
from .settings import counts, number, optional, stored, text, whole


def _read_models(value: Any) -> tuple[PoseModel, ...]:
    return tuple(PoseModel.from_dict(plain) for plain in value)


def _write_models(models: Sequence[PoseModel]) -> list[dict[str, Any]]:
    return [model.to_dict() for model in models]


def _read_meshes(value: Any) -> tuple[str, ...]:
    return tuple(text(name) for name in value)


def _read_weights(value: Any) -> tuple[float, ...]:
    return tuple(number(weight) for weight in value)


@dataclass(frozen=True, kw_only=True)
class ChoicePlacement(Placing):
    """Choose one of several examples in every scope, and put library objects where it answers there.

    Attributes
    ----------
    meshes : tuple of str
        Names of the library objects, one per example.
    label : str
        What later operations see them as.
    models : tuple of PoseModel
        What the examples say.
    scope : str or None
        Label of the polygons in which one example is chosen; None: that of the first example's parent.
    weights : tuple of float
        How often each example is chosen in proportion to the others; empty: equally often.
    seed : int
        For other choices of this operation alone.
    threshold, max_per, spacing
        As in `PosePlacement`.
    """

    type = "choice"
    random = True

    meshes: tuple[str, ...] = field(metadata=stored(_read_meshes, list))
    label: str = field(metadata=stored(text))
    models: tuple[PoseModel, ...] = field(metadata=stored(_read_models, _write_models))
    scope: str | None = field(default=None, metadata=stored(optional(text)))
    weights: tuple[float, ...] = field(default=(), metadata=stored(_read_weights, list))
    seed: int = field(default=0, metadata=stored(whole))
    threshold: float = field(default=0.0, metadata=stored(number, late=True))
    max_per: dict[str, int] = field(default_factory=dict, metadata=stored(counts, dict, late=True))
    spacing: float | None = field(default=None, metadata=stored(optional(number), late=True))

    def __post_init__(self) -> None:
        if len(self.meshes) != len(self.models):
            raise InputError(
                f"there are {len(self.meshes)} library objects for {len(self.models)} examples; give one per example"
            )
        self._choice(0)

    def _choice(self, seed: int) -> PoseChoice:
        return PoseChoice(self.models, self.scope, self.weights or None, seed)

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[tuple[Element, ...]]:
        """Propagate all examples into the scopes that they are chosen in."""
        results = yield from self._choice(seed ^ self.seed).steps(layout.scene)
        found: list[Element] = []
        for one, model, mesh in zip(results, self.models, self.meshes, strict=True):
            found += elements_of(one, model, mesh, self.label, node, layout.scene)
        return with_distinct_keys(sorted(found, key=lambda e: (not e.example, -e.importance)))

    def chosen(self, results: Sequence[Element], examples: Sequence[Element], layout: Layout) -> Sequence[Element]:
        """The results above the threshold that leave each other room, at most so many per parent."""
        return sift(results, examples, layout, self.threshold, self.max_per, self.spacing)

    def reads(self, layout: Layout) -> list[Polygon]:
        """The parents like the examples', what stands in them, and the scopes around them."""
        scene = layout.scene
        read = {p.id for p in read_by(self.models, scene)}
        for model in self.models:
            for parent in model.targets(scene):
                around: Polygon | None = parent
                while around is not None:
                    read.add(around.id)
                    around = scene.parent(str(around.id))
        return [p for p in scene.polygons if p.id in read]
