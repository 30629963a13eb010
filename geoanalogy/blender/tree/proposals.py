"""What an operation has proposed, as text that a .blend keeps: results can be sifted again without computing them."""

import json
from collections.abc import Iterable
from functools import lru_cache

from ...geometry.frame import SPACE, Frame
from ...geometry.surface import GROUND
from ...operations.element import Element
from ...poses.pose import Pose

#: Stretch and novelty of most elements; they are not written.
PLAIN = ((1.0, 1.0), 0.0)

#: Origin and axes of the ground.
LEVEL = (SPACE.origin, SPACE.x, SPACE.y)


def write_proposals(elements: Iterable[Element]) -> str:
    """Elements of one node as text.

    Parameters
    ----------
    elements : iterable of Element

    Returns
    -------
    str
    """
    kinds: dict[tuple, int] = {}
    rows = []
    for e in elements:
        where = () if e.surface == GROUND else (e.owner, e.frame.origin, e.frame.x, e.frame.y)
        kind = kinds.setdefault((e.label, e.mesh, e.footprint, e.surface, *where), len(kinds))
        pose = [*e.pose.position, e.pose.angle, e.pose.mirrored]
        row = [kind, e.parent, e.key, pose, e.scale, e.importance, e.example]
        rows.append(row if (e.stretch, e.novelty) == PLAIN else [*row, e.stretch, e.novelty])
    return json.dumps({"kinds": list(kinds), "elements": rows}, ensure_ascii=False, allow_nan=False)


@lru_cache(maxsize=256)
def read_proposals(text: str, node: str) -> tuple[Element, ...]:
    """The inverse of `write_proposals`.

    Parameters
    ----------
    text : str
        Empty: none.
    node : str
        Id of the node.

    Returns
    -------
    tuple of Element
        The same ones for the same text: they keep the polygons that were derived from them.
    """
    if not text:
        return ()
    plain = json.loads(text)
    kinds = [
        (label, mesh, None if ring is None else tuple((x, y) for x, y in ring), surface, *(where or ("", *LEVEL)))
        for label, mesh, ring, surface, *where in plain["kinds"]
    ]
    found = []
    for kind, parent, key, (x, y, angle, mirrored), scale, importance, example, *more in plain["elements"]:
        label, mesh, ring, surface, owner, origin, x_axis, y_axis = kinds[kind]
        pose = Pose((x, y), angle, mirrored)
        (u, v), novelty = more or PLAIN
        found.append(
            Element(
                label,
                mesh,
                parent,
                pose,
                ring,
                node,
                key,
                surface,
                scale,
                importance,
                example,
                (u, v),
                novelty,
                owner,
                SPACE if surface == GROUND else Frame(tuple(origin), tuple(x_axis), tuple(y_axis)),
            )
        )
    return tuple(found)
