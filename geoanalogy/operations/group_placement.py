"""Transfer of a group of objects in local coordinates (section 4.7)."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..poses.group_transfer import GroupTransfer
from ..poses.pose import Pose
from ..progress import Stepper
from .element import Element, plain_ring
from .keys import key_of
from .layout import Layout
from .placing import Placing, holds, with_distinct_keys
from .settings import flag, stored, text


def _read_names(value: Any) -> tuple[str, ...]:
    return tuple(text(name) for name in value)


@dataclass(frozen=True, kw_only=True)
class GroupPlacement(Placing):
    """Put a group of library objects into every polygon like the one that it is in, not rigidly.

    Attributes
    ----------
    meshes, labels : tuple of str
        Name of the library object and label, per object of the group.
    group : GroupTransfer
        The polygon, the objects in it, and how they are mapped.
    own : bool
        Whether the group itself is placed by this operation; not, where earlier operations have placed it.
    everything : bool
        Whether objects are placed too for whose coordinates a polygon has no room; they stand on its medial axis.
    """

    type = "local coordinates"

    meshes: tuple[str, ...] = field(metadata=stored(_read_names, list))
    labels: tuple[str, ...] = field(metadata=stored(_read_names, list))
    group: GroupTransfer = field(metadata=stored(GroupTransfer.from_dict, GroupTransfer.to_dict))
    own: bool = field(default=True, metadata=stored(flag))
    everything: bool = field(default=False, metadata=stored(flag, late=True))

    def __post_init__(self) -> None:
        if not len(self.meshes) == len(self.labels) == len(self.group.objects):
            raise InputError(
                f"there are {len(self.meshes)} library objects and {len(self.labels)} labels for "
                f"{len(self.group.objects)} objects of the group; give one of each per object"
            )

    @property
    def bent_outlines(self) -> dict[str, NDArray[np.float64]]:
        """By the library object: its outline before it is bent, in the frame of its pose; empty where none is bent."""
        if self.group.options.shape != "outline":
            return {}
        pairs = zip(self.meshes, self.group.outlines, strict=True)
        return {mesh: outline for mesh, outline in pairs if outline is not None}

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[tuple[Element, ...]]:
        """Take the group to every polygon; importance is 0 where a polygon has no room for the coordinates."""
        moved = yield from self.group.steps(layout.scene)
        found = []
        if self.own and holds(layout.scene, self.group.source):
            for i, o in enumerate(self.group.objects):
                found.append(self._element(i, o.pose, o.footprint, self.group.source, node, example=True))
        for m in moved:
            found.append(self._element(m.index, m.pose, m.footprint, m.parent, node, reached=m.reached))
        return with_distinct_keys(found)

    def _element(
        self,
        index: int,
        pose: Pose,
        footprint: NDArray[np.float64] | None,
        parent: Polygon,
        node: str,
        reached: bool = True,
        example: bool = False,
    ) -> Element:
        return Element(
            self.labels[index],
            self.meshes[index],
            str(parent.id),
            pose,
            plain_ring(footprint),
            node,
            key_of(pose.position, parent),
            importance=float(reached),
            example=example,
        )

    def chosen(self, results: Sequence[Element], examples: Sequence[Element], layout: Layout) -> Sequence[Element]:
        """Those objects that polygons have room for, or all."""
        return results if self.everything else [e for e in results if e.importance > 0]

    def reads(self, layout: Layout) -> list[Polygon]:
        """The polygons of the group's label."""
        return [p for p in layout.scene.polygons if p.label == self.group.source.label]
