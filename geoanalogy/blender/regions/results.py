"""The results of region transfers: what was found is kept with the node, and what passes the threshold is shown."""

import base64
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ...operations.region_transfer import RegionTransfer
from .. import names
from ..holders import ensure_holder_with
from ..reading.planes import Plane
from ..tree.store import engine_node
from ..writing.instances import collection_of, ensure_results_collection, results_in
from .contents import Places, carried, points_of
from .drawings import line_curve
from .queries import MARKED, TARGET_COLOUR, mark

Array = NDArray[np.float64]

#: Coverage, and mean confidence, below which a result is a guess that should be looked at.
UNCERTAIN = 0.4

#: Distance between the centres of a decided region and one that is found again, in sizes of the latter, below which
#: they are the same.
SAME_PLACE = 0.25

#: Height of each result above the one before it, in sizes of the drawing: what overlaps must not flicker.
LAYER = 1e-5


@dataclass(frozen=True)
class StoredTarget:
    """A region that was found, with all that is needed to show it.

    Attributes
    ----------
    key : str
        Its centre on the plane, which tells it apart and finds it again after a replay.
    similarity, coverage, confidence : float
    mirrored : bool
    outline : ndarray of shape (n, 2)
        The query's line, mapped.
    points : ndarray of shape (m, 4)
        For all points that are carried over: x and y on the plane, local size, and confidence.
    """

    key: str
    similarity: float
    coverage: float
    confidence: float
    mirrored: bool
    outline: Array
    points: Array

    @property
    def uncertain(self) -> bool:
        """Whether so little supports the mapping that it should be looked at."""
        return min(self.coverage, self.confidence) < UNCERTAIN

    @property
    def centre(self) -> Array:
        """By the key."""
        return np.array([float(v) for v in self.key.split()])

    @property
    def size(self) -> float:
        """Of the outline."""
        return float(np.ptp(self.outline, axis=0).max())

    def to_dict(self) -> dict:
        """Plain data.

        Returns
        -------
        dict
        """
        return {
            "key": self.key,
            "similarity": self.similarity,
            "coverage": self.coverage,
            "confidence": self.confidence,
            "mirrored": self.mirrored,
            "outline": _packed(self.outline - self.centre),
            "points": _packed(self.points - (*self.centre, 0.0, 0.0)),
        }

    @classmethod
    def from_dict(cls, plain: dict) -> "StoredTarget":
        """The target that `to_dict` wrote.

        Parameters
        ----------
        plain : dict

        Returns
        -------
        StoredTarget
        """
        centre = np.array([float(v) for v in plain["key"].split()])
        return cls(
            plain["key"],
            plain["similarity"],
            plain["coverage"],
            plain["confidence"],
            plain["mirrored"],
            _unpacked(plain["outline"], 2) + centre,
            _unpacked(plain["points"], 4) + np.array([*centre, 0.0, 0.0]),
        )


def key_of(outline: Array) -> str:
    """The key of a region by its centre.

    Parameters
    ----------
    outline : ndarray of shape (n, 2)

    Returns
    -------
    str
    """
    x, y = outline.mean(axis=0)
    return f"{x:.6g} {y:.6g}"


def _packed(values: Array) -> str:
    return base64.b85encode(np.asarray(values, "<f4").tobytes()).decode("ascii")


def _unpacked(text: str, width: int) -> Array:
    return np.frombuffer(base64.b85decode(text), "<f4").reshape(-1, width).astype(float)


def write_targets(node: bpy.types.Node, targets: Iterable[StoredTarget], plane: Plane, size: float) -> None:
    """Keep what was found with its node.

    Parameters
    ----------
    node : bpy.types.Node
    targets : iterable of StoredTarget
        Best first.
    plane : Plane
        Of the drawing that they were found in.
    size : float
        Of that drawing.
    """
    plain = {
        "plane": plane.matrix.ravel().tolist(),
        "size": size,
        "targets": [target.to_dict() for target in targets],
    }
    node[names.MATCHES] = json.dumps(plain)


def targets_found(node: bpy.types.Node) -> list[StoredTarget]:
    """All that was found for a node.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    list of StoredTarget
        Best first.
    """
    return _stored(node)[0]


def _stored(node: bpy.types.Node) -> tuple[list[StoredTarget], Plane, float]:
    plain = json.loads(node.get(names.MATCHES) or "{}")
    targets = [StoredTarget.from_dict(one) for one in plain.get("targets", ())]
    plane = Plane.of_matrix(np.reshape(plain["plane"], (4, 4))) if plain else Plane()
    return targets, plane, plain.get("size", 1.0)


def passing(operation: RegionTransfer, targets: Sequence[StoredTarget]) -> list[StoredTarget]:
    """The targets that threshold and decisions let pass.

    Parameters
    ----------
    operation : RegionTransfer
    targets : sequence of StoredTarget

    Returns
    -------
    list of StoredTarget
        Best first.
    """
    accepted = _same(operation.decisions.accepted, targets)
    rejected = _same(operation.decisions.rejected, targets)
    return [t for t in targets if t.key not in rejected and (t.key in accepted or t.similarity >= operation.threshold)]


def _same(keys: Iterable[str], targets: Sequence[StoredTarget]) -> set[str]:
    """The targets that were decided on: the nearest to each key, where it is near enough."""
    found = set()
    for key in keys:
        at = np.array([float(v) for v in key.split()])
        gaps = [np.linalg.norm(t.centre - at) for t in targets]
        if gaps and min(gaps) <= SAME_PLACE * targets[int(np.argmin(gaps))].size:
            found.add(targets[int(np.argmin(gaps))].key)
    return found


def hidden_targets(node: bpy.types.Node) -> list[str]:
    """The regions that a node's threshold hides and that nobody has decided on.

    Parameters
    ----------
    node : bpy.types.Node
        Of a region transfer.

    Returns
    -------
    list of str
        Their keys.
    """
    operation = engine_node(node).operation
    decisions, targets = operation.decisions, targets_found(node)
    kept = _same((*decisions.accepted, *decisions.rejected), targets)
    return [t.key for t in targets if t.similarity < operation.threshold and t.key not in kept]


def contents_of(node: bpy.types.Node) -> list[bpy.types.Object]:
    """The objects that a node carries over.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    list of bpy.types.Object
        Those that have been deleted are left out.
    """
    entries = (node.get(names.CONTENTS) or {}).values()
    return [entry["object"] for entry in entries if entry.get("object") is not None]


def show_targets(scene: bpy.types.Scene, node: bpy.types.Node) -> int:
    """Show what passes: copies of what is carried over, or outlines where there is nothing yet.

    What is shown already and stays is left alone.

    Parameters
    ----------
    scene : bpy.types.Scene
    node : bpy.types.Node
        Of the scene's tree.

    Returns
    -------
    int
        How many regions are shown.
    """
    targets, plane, size = _stored(node)
    shown = [] if node.mute else passing(engine_node(node).operation, targets)
    rank = {target.key: i for i, target in enumerate(targets)}
    holder = ensure_holder_with(ensure_results_collection(scene), names.NODE, node.name)
    wanted = {target.key for target in shown}
    gone = [item for item in results_in(holder) if item[names.KEY] not in wanted]
    _delete(gone)
    there = {item[names.KEY] for item in results_in(holder)}
    contents = [(item, len(points_of(item))) for item in contents_of(node)]
    if sum(count for _, count in contents) != (len(targets[0].points) if targets else 0):
        # Points were added to or taken from what is carried over: its places are known again after a replay.
        node[names.PROBLEM] = "what is carried over has been edited; replay to carry it over as it is now"
        contents = []
    for target in shown:
        if target.key not in there:
            for item in _made(node, target, rank[target.key], contents, plane, size):
                item[names.NODE], item[names.KEY] = node.name, target.key
                item[names.SIMILARITY], item[names.CONFIDENCE] = target.similarity, target.confidence
                item[names.COVERAGE] = target.coverage
                holder.objects.link(item)
    node[names.COUNT] = len(shown)
    node[names.UNCERTAIN] = ", ".join(_name(node, rank[target.key]) for target in shown if target.uncertain)
    return len(shown)


def uncertain_results(node: bpy.types.Node) -> list[str]:
    """The results that are shown of a node though little supports them.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    list of str
        Their names.
    """
    text = node.get(names.UNCERTAIN, "")
    return text.split(", ") if text else []


def _name(node: bpy.types.Node, rank: int) -> str:
    return f"{node.name} {rank + 1:03d}"


def clear_targets(scene: bpy.types.Scene, node: bpy.types.Node) -> None:
    """Delete what is shown of a node, with the data that it alone uses.

    Parameters
    ----------
    scene : bpy.types.Scene
    node : bpy.types.Node
    """
    holder = collection_of(scene, node.name)
    if holder is not None:
        _delete(results_in(holder))


def _delete(items: Sequence[bpy.types.Object]) -> None:
    data = [item.data for item in items if item.data is not None]
    bpy.data.batch_remove(items)
    bpy.data.batch_remove([one for one in dict.fromkeys(data) if one.users == 0])


def _made(
    node: bpy.types.Node,
    target: StoredTarget,
    rank: int,
    contents: Sequence[tuple[bpy.types.Object, int]],
    plane: Plane,
    size: float,
) -> list[bpy.types.Object]:
    """The objects of one target."""
    name = _name(node, rank)
    if not contents:
        return [_outline(name, target, plane, size)]
    # The contents lie where the query is.
    source = Plane.of_matrix(np.reshape(node[names.FRAME].to_list(), (4, 4)))
    found, start = [], 0
    for item, count in contents:
        own = target.points[start : start + count]
        height = source.to_plane(points_of(item))[:, 2] + LAYER * size * rank
        places = Places(np.column_stack([own[:, :2], height]), own[:, 2], own[:, 3], target.mirrored)
        found.append(carried(item, places, source, plane, name))
        start += count
    return found


def _outline(name: str, target: StoredTarget, plane: Plane, size: float) -> bpy.types.Object:
    ring = target.outline - target.centre
    curve = line_curve(name, [np.column_stack([ring, np.zeros(len(ring))])])
    mark(curve, TARGET_COLOUR, MARKED * size)
    item = bpy.data.objects.new(name, curve)
    frame = plane.matrix.copy()
    frame[:3, 3] = plane.to_world([(*target.centre, 0.0)])[0]
    item.matrix_basis = Matrix(frame.tolist())
    item.color = TARGET_COLOUR
    item.show_in_front = True
    item.hide_render = True
    return item
