"""Why a result stands where it stands: the relations that carry it (figure 4.14)."""

from dataclasses import dataclass

import bpy
import numpy as np

from ...errors import InputError
from ...geometry.scene import Scene
from ...operations.element import Element
from ...operations.keys import key_of
from ...operations.pose_placement import PosePlacement
from ...operations.rectangle_placement import LEAST_SCORE, RectanglePlacement, placement_key
from ...operations.scatter_placement import ScatterPlacement
from ...placements.model import PlacementModel
from ...poses.arrangement import arrangement_of
from ...poses.explanation import explain as explained_by
from ...poses.model import PoseModel
from .. import names
from .refresh import proposed_by
from .sites import site_under, sites_before
from .store import engine_node, require_operations

#: Relations that are listed, and the least part of the importance that is; the rest is one line.
MOST_LISTED, LEAST_LISTED = 8, 0.01


@dataclass(frozen=True)
class Reason:
    """One line of an explanation.

    Attributes
    ----------
    text : str
        The relation, and what it is to.
    share : float
        Its part of the importance, 0 to 1.
    """

    text: str
    share: float


#: Explanations by scene and object, for the panel to draw.
_explained: dict[tuple[str, str], tuple[Reason, ...]] = {}


def forget_explanations() -> None:
    """Forget all explanations: what they are about may be gone."""
    _explained.clear()


def explanation_of(scene: bpy.types.Scene, item: bpy.types.Object | None) -> tuple[Reason, ...] | None:
    """What was found out about a result.

    Parameters
    ----------
    scene : bpy.types.Scene
    item : bpy.types.Object or None

    Returns
    -------
    tuple of Reason, or None
        None where nobody has asked.
    """
    return None if item is None or names.KEY not in item else _explained.get(_name(scene, item))


def _name(scene: bpy.types.Scene, item: bpy.types.Object) -> tuple[str, str]:
    return scene.name, f"{item[names.NODE]}/{item[names.KEY]}"


def explain(context: bpy.types.Context, item: bpy.types.Object | None) -> tuple[Reason, ...]:
    """Find out which relations carry a result, and keep it for the panel.

    Parameters
    ----------
    context : bpy.types.Context
    item : bpy.types.Object or None

    Returns
    -------
    tuple of Reason
        Largest first.

    Raises
    ------
    InputError
        Where the object is no result of a propagation.
    """
    if item is None or names.KEY not in item:
        raise InputError(f"no result is active; click one in the collection {names.COLLECTION!r}")
    node = require_operations(context.scene).nodes.get(item[names.NODE])
    e = next((e for e in proposed_by(node) if e.key == item[names.KEY]), None) if node else None
    operation = engine_node(node).operation if node else None
    model = getattr(operation, "model", None)
    if isinstance(operation, ScatterPlacement):
        model = operation.model.model
    known = isinstance(operation, PosePlacement | ScatterPlacement | RectanglePlacement)
    at = site_under(sites_before(context, node), e) if e is not None and known else None
    if at is None:
        raise InputError(f"object {item.name!r} was not placed by single relations; there is nothing to list")
    find = _placement_reasons if isinstance(operation, RectanglePlacement) else _reasons
    reasons = _explained[_name(context.scene, item)] = find(model, e, at.scene)
    return reasons


def _placement_reasons(model: PlacementModel, e: Element, scene: Scene) -> tuple[Reason, ...]:
    for placement in model.place(scene, LEAST_SCORE):
        key = key_of((placement.rectangle.x, placement.rectangle.y), placement.parent)
        if placement.parent.id == e.parent and key == placement_key(e.key):
            return tuple(Reason(relation.text, relation.weight) for relation in placement.relations[:MOST_LISTED])
    return (Reason("drawn as an example", 1.0),)


def _reasons(model: PoseModel, e: Element, scene: Scene) -> tuple[Reason, ...]:
    target = arrangement_of(scene, scene.polygon(e.parent))
    fitting = [
        i for i in model.importances(target) if i.sense.mirrored == e.pose.mirrored and np.isclose(i.scale, e.scale)
    ]
    position = np.array(e.pose.position)
    shares = max(
        (explained_by(i, position, e.pose.angle) for i in fitting), key=lambda s: sum(r.weight for r in s), default=()
    )
    sums: dict[str, float] = {}
    for share in shares:
        of = scene.polygon(share.target).label if share.target in {p.id for p in scene.polygons} else ""
        text = f"{share.relation.replace('_', ' ')} · {of or share.target}"
        sums[text] = sums.get(text, 0.0) + share.weight
    ranked = sorted(sums.items(), key=lambda pair: -pair[1])
    reasons = [Reason(text, weight) for text, weight in ranked[:MOST_LISTED] if weight >= LEAST_LISTED]
    rest = sum(sums.values()) - sum(reason.share for reason in reasons)
    return tuple([*reasons, Reason("others", rest)] if rest >= LEAST_LISTED else reasons)
