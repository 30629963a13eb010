"""What a set of examples has in common: weights of relations and similarities among the examples."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.rectangle import Rectangle
from .arrangement import Arrangement
from .boxes import BETWEEN, areas, shared_areas
from .options import PlacementOptions
from .signature import BOX, PARENT_BOX, SAMPLE_COUNTS, Signature, signature
from .similarity import best_assignment, box_agreement, length_widths, outline_agreement

Array = NDArray[np.float64]

#: How sure one is of a relation that a single example shows: what examples share beyond chance, seen on real facades.
PRIOR_RELIABILITY = 0.7


#: Share of the positive examples that must lie between two elements for their gap to be one: there are as many kinds of
#: gaps as pairs of labels, and most mean nothing.
LEAST_BETWEEN = 0.75


#: Scatter of a coordinate below which examples agree in it exactly, in widths of the Gaussians.
HABIT_FLOOR = 0.3


@dataclass(frozen=True)
class Taught:
    """One example, as a model keeps it: without its scene.

    Attributes
    ----------
    rectangle : Rectangle
        In the example's scene.
    size : ndarray of shape (2,)
        Its extent along the frame's axes.
    quarter : int
        Quarter turns from the frame to its direction.
    target : float
    fingerprint : str
        Of the arrangement it was drawn in.
    outside : float
        Share of it that lies outside its parent.
    covered, touched : dict of str to float
        By label: the share of it that elements cover, and the largest share of one element that it covers.
    """

    rectangle: Rectangle
    size: Array
    quarter: int
    target: float
    fingerprint: str
    outside: float
    covered: dict[str, float]
    touched: dict[str, float]

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON."""
        r = self.rectangle
        return {
            "rectangle": [r.x, r.y, r.width, r.height, r.angle],
            "size": self.size.tolist(),
            "quarter": self.quarter,
            "target": self.target,
            "fingerprint": self.fingerprint,
            "outside": self.outside,
            "covered": self.covered,
            "touched": self.touched,
        }

    @classmethod
    def from_dict(cls, plain: dict[str, Any]) -> "Taught":
        """The inverse of `to_dict`."""
        return cls(
            **{
                **plain,
                "rectangle": Rectangle(*plain["rectangle"]),
                "size": np.array(plain["size"], dtype=np.float64),
            }
        )


def coverage(arrangement: Arrangement, boxes: Array) -> tuple[dict[str, Array], dict[str, Array]]:
    """How boxes overlap the drawn elements of every label.

    Parameters
    ----------
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)

    Returns
    -------
    covered : dict of str to ndarray of shape (n,)
        Share of the box that lies under elements of the label (at most 1).
    touched : dict of str to ndarray of shape (n,)
        Largest share of a single element that lies under the box.
    """
    covered, touched = {}, {}
    own = areas(boxes)
    for label, elements in arrangement.drawn.items():
        shared = shared_areas(boxes, elements)
        covered[label] = np.minimum(shared.sum(axis=1) / own, 1.0)
        touched[label] = np.minimum((shared / areas(elements)[None]).max(axis=1), 1.0)
    return covered, touched


@dataclass(frozen=True)
class Match:
    """How the elements of one group around boxes agree with those around examples.

    Attributes
    ----------
    total : ndarray of shape (n, m)
        Utility of the best assignment (eq. 5.4), weighted.
    along_x, along_y : ndarray of shape (n, m)
        Agreement with the element nearest to the example along each axis, 0 to 1; of outlines that in both at once.
    of_boxes : bool
        Whether the group is one of boxes.
    joint : ndarray of shape (n, m)
        Of both axes at once with one element, 0 to 1.
    """

    total: Array
    along_x: Array
    along_y: Array
    joint: Array
    of_boxes: bool


class Lesson:
    """What is learned from the examples; everything follows from what is kept of each.

    Parameters
    ----------
    taught : list of Taught
    kept : Signature
        Feature vectors of the examples, in the same order.
    options : PlacementOptions
    """

    def __init__(self, taught: list[Taught], kept: Signature, options: PlacementOptions) -> None:
        self.taught = taught
        self.kept = kept
        self.options = options
        self.targets = np.array([t.target for t in taught])
        self.positive = np.flatnonzero(self.targets > 0)
        self.sizes = np.array([t.size for t in taught])
        self.widths = length_widths(self.sizes[self.positive], options.tau)

    @classmethod
    def of(cls, taught: list[Taught], kept: list[Signature], options: PlacementOptions) -> "Lesson":
        """A lesson from the signatures of single examples, which may have seen different labels.

        Parameters
        ----------
        taught : list of Taught
        kept : list of Signature
            One row each.
        options : PlacementOptions

        Returns
        -------
        Lesson
        """
        boxes = _side_by_side([k.boxes for k in kept])
        positive = np.array([t.target > 0 for t in taught])
        for key in [k for k in boxes if k.startswith(BOX + BETWEEN)]:
            if _lies_within(boxes[key][positive, 0]).mean() < LEAST_BETWEEN:
                del boxes[key]
        return cls(taught, Signature(boxes, _side_by_side([k.outlines for k in kept])), options)

    @cached_property
    def labels(self) -> list[str]:
        """Labels of the elements and gaps that were seen around examples."""
        return [key.removeprefix(BOX) for key in self.kept.boxes if key != PARENT_BOX]

    @cached_property
    def weights(self) -> dict[str, Array]:
        """Weight of every relation of every example, by group, in the shape of what is kept of the group.

        The samples it counts for, times how well the counterparts around the other positive examples agree in it: the
        better half of them, for there may be two kinds of examples. A relation in which they differ is no part of what
        they have in common (figure 5.11), one in which they agree keeps its whole weight; the distances to one wall can
        matter and those to another not. With a single example all keep theirs.
        """
        half = len(self.positive) // 2  # of the others, rounded up
        return {
            key: self._counts(key, values) * self.agreement(key, max(half, 1))
            for key, values in (self.kept.boxes | self.kept.outlines).items()
        }

    def agreement(self, key: str, most: int) -> Array:
        """How well every relation of every example agrees with its counterparts around the other positive examples.

        Parameters
        ----------
        key : str
            Of the group.
        most : int
            Only so many of the others count, for each relation those that agree best.

        Returns
        -------
        ndarray in the shape of what is kept of the group
            Between 0 and 1; 1 where there are no others.
        """
        values = (self.kept.boxes | self.kept.outlines)[key]
        p = self.positive
        if len(p) < 2:
            return np.ones_like(values)
        agreement = self._agreement(key, values, values[p])
        rest = _REST[values.ndim]
        utility = np.einsum(f"nmpq{rest},{rest}->nmpq", agreement, self._counts(key, values))
        column = best_assignment(utility.astype(np.float64))[1]
        index = column.reshape(*column.shape, 1, *(1,) * (agreement.ndim - 4))
        matched = np.take_along_axis(agreement, index, axis=3)[:, :, :, 0]
        matched[np.arange(len(values))[:, None] == p[None]] = -1.0
        return np.sort(matched, axis=1)[:, -min(most, len(p) - 1) :].mean(axis=1)

    def _counts(self, key: str, values: Array) -> Array:
        """How many samples each relation of a group stands for, as a share of all samples."""
        if key in self.kept.boxes:
            return np.broadcast_to((SAMPLE_COUNTS / SAMPLE_COUNTS.sum())[None, :, None], (2, 3, 4)).copy()
        return np.full(values.shape[2:], 1.0 / values.shape[2])

    def _agreement(self, key: str, a: Array, b: Array) -> NDArray[Any]:
        if key in self.kept.boxes:
            return box_agreement(a, b, self.widths, self.options.tau)
        return outline_agreement(key, a, b, self.widths, self.options.tau)

    def match(self, seen: Signature, neighbours: int | None = None) -> dict[str, Match]:
        """Agreement of boxes with every example, group by group.

        Parameters
        ----------
        seen : Signature
            Of n boxes.
        neighbours : int, optional
            Only the nearest few elements of each example count; None: all that are kept.

        Returns
        -------
        dict of str to Match
            For every group of the examples; nothing agrees with a group that the boxes do not see. Outlines are left
            out where the boxes' signature has none.
        """
        found = {}
        for key, values in (self.kept.boxes | self.kept.outlines).items():
            if key in self.kept.outlines and not seen.outlines:
                continue
            kept = values[:, :neighbours]
            there = seen.boxes.get(key, seen.outlines.get(key))
            if there is None:
                nothing = np.zeros((len(seen.boxes[PARENT_BOX]), len(values)))
                found[key] = Match(nothing, nothing, nothing, nothing, key in self.kept.boxes)
                continue
            agreement = self._agreement(key, there, kept)
            weight = self.weights[key][:, :neighbours].astype(np.float32)
            if key in self.kept.boxes:
                by_axis = np.einsum("nmpqxsr,mqxsr->xnmpq", agreement, weight)
                utility = by_axis.sum(axis=0)
                whole = np.maximum(weight.sum(axis=(3, 4)).transpose(2, 0, 1), 1e-9)  # axis, example, element
                x, y = by_axis / whole[:, None, :, None, :]
                first = x[..., 0] * y[..., 0]
                found[key] = Match(
                    best_assignment(utility)[0].astype(np.float64),
                    x[..., 0].max(axis=2).astype(np.float64),
                    y[..., 0].max(axis=2).astype(np.float64),
                    first.max(axis=2).astype(np.float64),
                    True,
                )
            else:
                utility = np.einsum("nmpqsr,mqsr->nmpq", agreement, weight)
                total = best_assignment(utility)[0].astype(np.float64)
                there = np.isfinite(kept[:, :, 0, 0])
                whole = np.maximum((weight.sum(axis=(2, 3)) * there).sum(axis=1), 1e-9)
                share = np.minimum(total / whole, 1.0)
                found[key] = Match(total, share, share, share, False)
        return found

    @cached_property
    def _among_examples(self) -> dict[str, Match]:
        return self.match(self.kept)

    @cached_property
    def gram(self) -> Array:
        """Similarity of every two examples (eq. 5.7), 1 on the diagonal, shape (m, m)."""
        return self.similarities(self._among_examples)

    @cached_property
    def _whole(self) -> Array:
        """The utility of each example with itself, shape (m,)."""
        totals = np.sum([m.total for m in self._among_examples.values()], axis=0)
        return np.maximum(totals.diagonal(), 1e-9)

    def similarities(self, matches: dict[str, Match]) -> Array:
        """The adapted SL0 similarity (eq. 5.5) as a share of the example's with itself.

        Parameters
        ----------
        matches : dict of str to Match

        Returns
        -------
        ndarray of shape (n, m)
        """
        return np.sum([m.total for m in matches.values()], axis=0) / self._whole

    @cached_property
    def reliability(self) -> dict[str, tuple[float, float, float]]:
        """How surely a positive example agrees with another one, by group: along x, along y, in both at once."""
        found = {}
        p = self.positive
        others = ~np.eye(len(p), dtype=bool)
        for key, match in self._among_examples.items():
            parts = []
            for value in (match.along_x, match.along_y, match.joint):
                best = np.where(others, value[np.ix_(p, p)], 0.0).max(axis=1)
                parts.append(float(best.mean()) if len(p) > 1 else PRIOR_RELIABILITY * float(value[p[0], p[0]] > 0))
            found[key] = (parts[0], parts[1], parts[2])
        return found

    @cached_property
    def habits(self) -> dict[str, tuple[Array, Array, Array]]:
        """What each edge keeps to, by group: medians of its box coordinates, their scatter, and their weights.

        Of all coordinates of an edge, to the nearest element of any group, those that scatter least among the positive
        examples weigh most: it is what the edge follows, be it the window's corner or a share of the parent.

        Returns
        -------
        dict of str to tuple of ndarray
            Arrays of shape (2, 2, 4): axis, edge (low, high), coordinate; the scatter in scene units; weights add up
            to 1 over the groups and coordinates of an edge.
        """
        found: dict[str, tuple[Array, Array, Array]] = {}
        floor = HABIT_FLOOR * self.widths[:2, None, None]
        for key, values in self.kept.boxes.items():
            edges = values[self.positive, 0][:, :, [0, 2]]
            if not np.isfinite(edges).all():
                continue
            middle = np.median(edges, axis=0)
            scatter = edges.std(axis=0)
            scatter[..., 3] *= (edges[..., 0] - edges[..., 1]).mean(axis=0)  # shares of the elements' mean extent
            found[key] = middle, scatter, 1.0 / (scatter**2 + floor**2)
        whole = sum(weight.sum(axis=2, keepdims=True) for _, _, weight in found.values())
        return {key: (middle, scatter, weight / whole) for key, (middle, scatter, weight) in found.items()}

    def habitual(self, seen: Signature) -> tuple[Array, Array]:
        """How well each edge of boxes keeps to what it keeps to among the examples.

        Parameters
        ----------
        seen : Signature
            Of n boxes.

        Returns
        -------
        kept : ndarray of shape (n, 2, 2)
            By axis and edge (low, high), between 0 and 1: in all coordinates, by their weights.
        explained : ndarray of shape (n, 2, 2)
            In the best of the coordinates that the examples agree in exactly; 1 where there is none. Whatever is drawn
            by a rule, however many rules would do, keeps to one of them.
        """
        n = len(seen.boxes[PARENT_BOX])
        kept, explained, exact = np.zeros((n, 2, 2)), np.zeros((n, 2, 2)), np.zeros((2, 2), dtype=bool)
        for key, (middle, scatter, weight) in self.habits.items():
            tight = scatter <= HABIT_FLOOR * self.widths[:2, None, None]
            exact |= tight.any(axis=2)
            if key not in seen.boxes:
                continue
            edges = seen.boxes[key][:, 0][:, :, [0, 2]]
            off = edges - middle
            off[..., 3] *= edges[..., 0] - edges[..., 1]
            width = scatter + self.widths[:2, None, None]
            agreement = np.nan_to_num(np.exp(-0.5 * (off / width) ** 2))
            kept += (weight * agreement).sum(axis=3)
            explained = np.maximum(explained, (tight * agreement).max(axis=3))
        return kept, np.where(exact, explained, 1.0)

    @cached_property
    def one_each(self) -> bool:
        """Whether every positive example is the only one in its arrangement."""
        where = [self.taught[i].fingerprint for i in self.positive]
        return len(set(where)) == len(where)

    @cached_property
    def cohesion(self) -> float:
        """How similar a positive example is to the one most similar to it, on average; 1 where there is but one."""
        p = self.positive
        if len(p) < 2:
            return 1.0
        gram = self.gram[np.ix_(p, p)]
        return float(np.where(np.eye(len(p), dtype=bool), 0.0, gram).max(axis=1).mean())


#: Subscripts of the relations of a group by its number of dimensions.
_REST = {5: "xsr", 4: "sr"}


def _lies_within(values: Array) -> NDArray[np.bool_]:
    """Whether boxes overlap the elements that their coordinates (n, 2, 3, 4) are relative to; shape (n,)."""
    return ((values[:, :, 0, 1] < 0) & (values[:, :, 2, 0] > 0)).all(axis=1)


def _side_by_side(parts: list[dict[str, Array]]) -> dict[str, Array]:
    """Rows of several dictionaries under each other; a group that one lacks is nil elements there."""
    shapes = {key: value.shape for part in parts for key, value in part.items()}
    return {
        key: np.concatenate([part.get(key, np.full((1, *shapes[key][1:]), np.nan)) for part in parts])
        for key in sorted(shapes)
    }


def teach(
    arrangement: Arrangement, rectangle: Rectangle, target: float, options: PlacementOptions
) -> tuple[Taught, Signature]:
    """What is kept of one example.

    Parameters
    ----------
    arrangement : Arrangement
        Where it was drawn.
    rectangle : Rectangle
    target : float
    options : PlacementOptions

    Returns
    -------
    taught : Taught
    kept : Signature
        One row.
    """
    box, quarter = rectangle.box(arrangement.frame)
    covered, touched = coverage(arrangement, box[None])
    return (
        Taught(
            rectangle,
            box[2:] - box[:2],
            quarter,
            target,
            arrangement.fingerprint,
            float(arrangement.share_outside(box[None])[0]),
            {label: float(v[0]) for label, v in covered.items()},
            {label: float(v[0]) for label, v in touched.items()},
        ),
        signature(arrangement, box[None], options.neighbours),
    )
