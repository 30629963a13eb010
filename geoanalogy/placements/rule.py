"""The learned rule in words, with weights (section 5.7, figure 5.11)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .lesson import Lesson, Match
from .signature import BOX, PARENT_BOX

Array = NDArray[np.float64]

#: Agreement among the examples from which a relation is part of the rule.
TOLD = 0.5
#: Agreement with an example from which an element is a reason.
LEAST_REASON = 0.1
#: Offsets below this share of the examples' size are said as "flush" or "same".
FLUSH = 0.02
#: Names of the edges by axis: low and high.
EDGES = (("left edge", "right edge"), ("lower edge", "upper edge"))
#: Where something lies against an edge, by axis, below and above.
SIDES = (("left of", "right of"), ("below", "above"))
EXTENTS = ("width", "height")


@dataclass(frozen=True)
class Relation:
    """One part of a rule.

    Attributes
    ----------
    text : str
        "0.2 below the lower edge of the window".
    weight : float
        How surely the examples agree in it, 0 to 1.
    label : str
        Label of the element it is a relation to; "" for the parent, and for a size, which is a relation to nothing.
    """

    text: str
    weight: float
    label: str


def learned_rule(lesson: Lesson, parent_label: str) -> list[Relation]:
    """What the examples have in common with the element of each label that is nearest to them, and with each other.

    Parameters
    ----------
    lesson : Lesson
    parent_label : str
        What the parent is called.

    Returns
    -------
    list of Relation
        The surest first.
    """
    found = _relations(lesson, parent_label)
    for axis, sure in enumerate(_alike(lesson)):
        if sure >= TOLD and not any(r.text.startswith(f"same {EXTENTS[axis]} as") for r in found):
            size = np.median(lesson.sizes[lesson.positive, axis])
            found.append(Relation(f"{size:.3g} {('wide', 'high')[axis]}", float(sure), ""))
    return sorted(found, key=lambda r: (-r.weight, r.text))


def _alike(lesson: Lesson) -> Array:
    """How surely the examples agree in their widths and heights."""
    sizes = lesson.sizes[lesson.positive]
    if len(sizes) < 2:
        return np.ones(2)
    first, second = np.triu_indices(len(sizes), 1)
    apart: Array = (sizes[first] - sizes[second]) / lesson.widths[:2]
    return np.exp(-(apart**2) / 2).mean(axis=0)  # type: ignore[no-any-return]


def _relations(lesson: Lesson, parent_label: str) -> list[Relation]:
    found = []
    for key, values in lesson.kept.boxes.items():
        seen = values[lesson.positive, 0]
        seen = seen[np.isfinite(seen[:, 0, 0, 0])]
        if not len(seen):
            continue
        weight = lesson.agreement(key, len(lesson.positive))[lesson.positive, 0].mean(axis=0)
        share = len(seen) / len(lesson.positive)
        label = "" if key == PARENT_BOX else key.removeprefix(BOX)
        name = (parent_label or "parent") if key == PARENT_BOX else (label or "element")
        for axis in (0, 1):
            for text, sure in _along(axis, seen[:, axis], weight[axis], lesson.sizes[:, axis].mean()):
                if sure * share >= TOLD:
                    found.append(Relation(text.format(name=name), float(sure * share), label))
    return sorted(found, key=lambda r: (-r.weight, r.text))


def reasons(lesson: Lesson, parent_label: str, matches: dict[str, Match]) -> list[tuple[Relation, ...]]:
    """Why boxes are where they are: the groups of elements that agree with those of an example.

    Parameters
    ----------
    lesson : Lesson
    parent_label : str
    matches : dict of str to Match
        Of n boxes.

    Returns
    -------
    list of tuple of Relation
        For each box, the surest first.
    """
    told: dict[str, str] = {}
    for relation in _relations(lesson, parent_label):
        told[relation.label] = f"{told[relation.label]}, {relation.text}" if relation.label in told else relation.text
    keys = [key for key, match in matches.items() if match.of_boxes]
    strength = np.stack(
        [matches[key].joint[:, lesson.positive].max(axis=1) * lesson.reliability[key][2] for key in keys], axis=1
    )
    found = []
    for row in strength:
        relations = []
        for i in np.argsort(-row, kind="stable"):
            label = "" if keys[i] == PARENT_BOX else keys[i].removeprefix(BOX)
            if row[i] >= LEAST_REASON:
                relations.append(
                    Relation(told.get(label) or f"near the {label or parent_label or 'parent'}", float(row[i]), label)
                )
        found.append(tuple(relations))
    return found


def _along(axis: int, values: Array, weight: Array, size: float) -> list[tuple[str, float]]:
    """Phrases on one axis from coordinates (m, 3, 4) and their agreement (3, 4): the surest ways to say it."""
    middle = np.median(values, axis=0)
    flush = FLUSH * size
    low, high = EDGES[axis]
    # Each edge against the edge of the element that it keeps its distance from best.
    sides = []
    for position, edge in ((0, low), (2, high)):
        origin = int(np.argmax(weight[position, :2]))
        sides.append(
            (_offset(edge, middle[position, origin], (low, high)[origin], axis, flush), weight[position, origin])
        )
    both = min(weight[0, 0], weight[2, 1])
    phrases = []
    if both >= TOLD and abs(middle[0, 0]) <= flush and abs(middle[2, 1]) <= flush:
        phrases.append((f"same {EXTENTS[axis]} as the {{name}}", both))
    elif middle[2, 0] <= flush or middle[0, 1] >= -flush:  # wholly beside it: one distance says where
        position, origin, side = (2, 0, 0) if middle[2, 0] <= flush else (0, 1, 1)
        gap = abs(middle[position, origin])
        where = (
            f"touching the {(low, high)[origin]} of the {{name}}"
            if gap <= flush
            else f"{gap:.3g} {SIDES[axis][side]} the {{name}}"
        )
        phrases.append((where, weight[position, origin]))
    elif weight[1, 2] >= TOLD and abs(middle[1, 2]) <= flush:
        across = ("horizontally", "vertically")[axis]
        phrases.append((f"centred {across} on the {{name}}", weight[1, 2]))
    else:
        phrases += sides
    shares = weight[[0, 2], 3].min()
    if shares >= TOLD and shares > max(sure for _, sure in phrases) + 0.1:
        phrases = [(f"from {middle[0, 3]:.0%} to {middle[2, 3]:.0%} of the {EXTENTS[axis]} of the {{name}}", shares)]
    return [(text, float(sure)) for text, sure in phrases]


def _offset(edge: str, value: float, origin: str, axis: int, flush: float) -> str:
    if abs(value) <= flush:
        return f"{edge} flush with the {origin} of the {{name}}"
    return f"{edge} {abs(value):.3g} {SIDES[axis][int(value > 0)]} the {origin} of the {{name}}"
