"""The answers of several importances, laid out one after another: what many poses are compared with at once."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import Elements, ElementType
from ..relations.runs import first_of
from ..relations.table import Positional
from .importance import Importance
from .query import is_length

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]


@dataclass(frozen=True)
class Part:
    """The answers of several importances, or poses, for one type of element, one after another.

    Attributes
    ----------
    element : ElementType
    elements : Elements
        That the entries are about.
    relations : tuple of Positional
    entries, pairs, features : ndarray of shape (importances,), int
        How many each has.
    target : ndarray of shape (e,), int
        The element of each entry.
    sample : ndarray of shape (e, 2)
        In the pose's frame, at the importance's scale.
    value, weight, turn : ndarray of shape (relations, e)
        As in `Answers`; lengths at the importance's scale.
    inner, directed : ndarray of shape (e,), bool
        Whether the sample is on the interior's side, and whether a direction is asked for.
    contact : ndarray of shape (e,)
    accuracy : ndarray of shape (pairs,)
    pair_start, feature_start : ndarray of int
        Counted from the first entry, and the first pair, of their importance.
    has_own_elements : bool
        Whether every entry has an element of its own, in order.
    """

    element: ElementType
    elements: Elements
    relations: tuple[Positional, ...]
    entries: Indices
    pairs: Indices
    features: Indices
    target: Indices
    sample: Array
    value: Array
    weight: Array
    turn: Array
    inner: Bools
    contact: Array
    directed: Bools
    accuracy: Array
    pair_start: Indices
    feature_start: Indices
    has_own_elements: bool = False

    @cached_property
    def first_entry(self) -> Indices:
        """The first entry of each importance."""
        return first_of(self.entries)

    @cached_property
    def first_pair(self) -> Indices:
        """The first pair of each importance."""
        return first_of(self.pairs)

    @cached_property
    def first_feature(self) -> Indices:
        """The first feature of each importance."""
        return first_of(self.features)

    @classmethod
    def of(
        cls, element: ElementType, elements: Elements, importances: Sequence[Importance], first: Sequence[int] | Indices
    ) -> "Part | None":
        """The answers for one type of element.

        Parameters
        ----------
        element : ElementType
        elements : Elements
            Of all arrangements, joined.
        importances : sequence of Importance
            All of the same query.
        first : ndarray of shape (importances,), int
            Number of the first element of each importance's arrangement.

        Returns
        -------
        Part or None
            None: the type is not asked for.
        """
        asked = [(k, i.answers[element]) for k, i in enumerate(importances) if element in i.answers]
        if not asked:
            return None
        answers = [a for _, a in asked]
        relations = answers[0].relations

        def per(count: str) -> Indices:
            size = np.zeros(len(importances), dtype=np.intp)
            for k, a in asked:
                size[k] = len(getattr(a, count))
            return size

        lengths = np.array([is_length(r) for r in relations])[:, None]
        entries = per("target")
        scale = np.repeat([i.scale for i in importances], entries)
        return cls(
            element=element,
            elements=elements,
            relations=relations,
            entries=entries,
            pairs=per("pair_start"),
            features=per("feature_start"),
            target=np.concatenate([a.target for a in answers]) + np.repeat(first, entries),
            sample=np.concatenate([importances[k].samples.take(a.sample, axis=0) for k, a in asked]),
            value=np.where(lengths, scale, 1.0) * np.concatenate([a.value for a in answers], axis=1),
            weight=np.concatenate([a.weight for a in answers], axis=1),
            turn=np.concatenate([a.turn for a in answers], axis=1),
            inner=np.concatenate([a.inner for a in answers]),
            contact=np.concatenate([a.contact for a in answers]),
            directed=np.concatenate([importances[k].directed(element, a.sample) for k, a in asked]),
            accuracy=np.concatenate([a.accuracy for a in answers]),
            pair_start=np.concatenate([a.pair_start for a in answers]),
            feature_start=np.concatenate([a.feature_start for a in answers]),
        )

    def only(
        self, chosen: Indices, accuracy: Array, per_pair: Indices, per_feature: Indices, counts: Sequence[Indices]
    ) -> "Part":
        """Some of the entries.

        Parameters
        ----------
        chosen : ndarray of shape (e,), int
        accuracy, per_pair : ndarray of shape (pairs,)
            Of the pairs that they make up, and the number of entries of each.
        per_feature : ndarray of shape (features,), int
            Number of pairs of each feature.
        counts : sequence of three ndarray of shape (importances,), int
            Number of entries, pairs and features of each importance, or pose.

        Returns
        -------
        Part
        """
        entries, pairs, features = counts
        return replace(
            self,
            entries=entries,
            pairs=pairs,
            features=features,
            target=self.target[chosen],
            has_own_elements=False,
            sample=self.sample.take(chosen, axis=0),
            value=self.value.take(chosen, axis=1),
            weight=self.weight.take(chosen, axis=1),
            turn=self.turn.take(chosen, axis=1),
            inner=self.inner[chosen],
            contact=self.contact[chosen],
            directed=self.directed[chosen],
            accuracy=accuracy,
            pair_start=_starts(per_pair, entries, pairs),
            feature_start=_starts(per_feature, pairs, features),
        )


def _starts(size: Indices, whole: Indices, parts: Indices) -> Indices:
    """Where neighbours of given sizes begin, counted from where the whole that they are parts of begins."""
    return first_of(size) - np.repeat(first_of(whole), parts)
