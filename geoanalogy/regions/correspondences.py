"""First-order correspondences: pairs of points whose neighbourhoods are alike, with the similarity between them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Contours, Floats
from ..geometry.drawing import Drawing
from .alignment import Alignment
from .descriptors import TURNS, confidences, describe, descriptors_of
from .query import Query

#: Best targets that a descriptor of the query keeps, in each orientation.
KEPT = 8
#: Least confidence of a correspondence.
LEAST_CONFIDENCE = 0.35
#: Samples to each side over which an aligned pair of points takes its similarity.
CHORD = 3


@dataclass(frozen=True)
class Correspondences:
    """Correspondences (p, tau): z -> image + factor (z - source), reflected afterwards where mirrored.

    Attributes
    ----------
    source : (n,) complex
        Points of the query.
    image : (n,) complex
        Their counterparts; conjugated where mirrored.
    factor : (n,) complex
        Scale and rotation.
    mirrored : (n,) bool
    confidence : (n,) float
    """

    source: Complex
    image: Complex
    factor: Complex
    mirrored: NDArray[np.bool_]
    confidence: Floats

    def __len__(self) -> int:
        return len(self.source)

    def chosen(self, which: NDArray) -> "Correspondences":
        """Some of them, by mask or by index."""
        return Correspondences(
            self.source[which], self.image[which], self.factor[which], self.mirrored[which], self.confidence[which]
        )

    @classmethod
    def joined(cls, parts: "list[Correspondences]") -> "Correspondences":
        """Several sets in one."""
        return cls(
            *(
                np.concatenate([getattr(p, name) for p in parts])
                for name in ("source", "image", "factor", "mirrored", "confidence")
            )
        )


def described(drawing: Drawing, query: Query, mirrored: bool, largest_scale: float) -> Correspondences:
    """Correspondences of the descriptors of appendix A.

    Parameters
    ----------
    drawing : Drawing
        Its descriptors are computed once and kept.
    query : Query
        The query's own descriptors see its own lines only: what surrounds it is no part of what is looked for.
    mirrored : bool
        Whether reflected targets are wanted.
    largest_scale : float
        Correspondences that scale by more than this, up or down, are left out.

    Returns
    -------
    Correspondences
    """
    contours: Contours = drawing.contours
    parts = [Correspondences(*(np.zeros(0, t) for t in (complex, complex, complex, bool, float)))]
    for turn, every in zip(TURNS, descriptors_of(drawing), strict=True):
        own = describe(contours, every.index[query.inside[every.index]], turn, query.inside)
        outside = np.flatnonzero(~query.inside[every.index])
        if not len(own.index) or not len(outside):
            continue
        source, source_heading = contours.points[own.index], contours.heading[own.index]
        point, heading = contours.points[every.index], contours.heading[every.index]
        for flip in (False, True) if mirrored else (False,):
            for half in (False, True):
                h = confidences(own, every, half, flip)
                h[:, query.inside[every.index]] = 0.0
                ratio = np.abs(np.log(every.walk[None] / own.walk[:, None]))
                h[ratio > np.log(largest_scale)] = 0.0
                kept = min(KEPT, h.shape[1])
                best = np.argpartition(-h, kept - 1, axis=1)[:, :kept]
                i = np.repeat(np.arange(len(h)), kept)
                j = best.ravel()
                good = h[i, j] >= LEAST_CONFIDENCE
                i, j = i[good], j[good]
                image = np.conj(point[j]) if flip else point[j]
                angle = (-heading[j] if flip else heading[j]) - source_heading[i] + (np.pi if half else 0.0)
                factor = np.asarray(every.walk[j] / own.walk[i] * np.exp(1j * angle), dtype=np.complex128)
                parts.append(Correspondences(source[i], image, factor, np.full(len(i), flip), h[i, j].astype(float)))
    return Correspondences.joined(parts)


def aligned(alignments: list[Alignment]) -> Correspondences:
    """Correspondences of consecutive pairs of alignments, as confident as their alignment is good.

    Parameters
    ----------
    alignments : list[Alignment]

    Returns
    -------
    Correspondences
    """
    parts = [Correspondences(*(np.zeros(0, t) for t in (complex, complex, complex, bool, float)))]
    best = max((a.score for a in alignments), default=1.0)
    for a in alignments:
        if len(a.source) <= 2 * CHORD:
            continue
        chord = a.source[2 * CHORD :] - a.source[: -2 * CHORD]
        factor = (a.target[2 * CHORD :] - a.target[: -2 * CHORD]) / np.where(chord == 0.0, 1e-9, chord)
        good = (np.abs(factor) > 1e-3) & (np.abs(factor) < 1e3)
        n = int(good.sum())
        middle = slice(CHORD, -CHORD)
        parts.append(
            Correspondences(
                a.source[middle][good],
                a.target[middle][good],
                factor[good],
                np.full(n, a.mirrored),
                np.full(n, a.score / best),
            )
        )
    return Correspondences.joined(parts)
