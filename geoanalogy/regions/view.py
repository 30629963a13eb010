"""The transformation space of a query as data for a view (appendix B)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Floats
from ..geometry.drawing import Drawing
from .matching import Matches


@dataclass(frozen=True)
class TransformationSpace:
    """Refined correspondences of a query in transformation space.

    Attributes
    ----------
    query_point : (n, 2) float
        Query points, scene units.
    target : (n, 2) float
        Where each correspondence takes its query point.
    translation : (n, 2) float
        From the query point to its target, scene units.
    scale : (n,) float
    rotation : (n,) float
        Radians; of a mirrored correspondence the rotation before it is reflected.
    mirrored : (n,) bool
    magnitude : (n,) float
        Confidence h, 1 for the greatest.
    match : (n,) int
        Number of the match (0 for the best) whose function the correspondence lies on, -1 for none: the inliers.
    """

    query_point: Floats
    target: Floats
    translation: Floats
    scale: Floats
    rotation: Floats
    mirrored: NDArray[np.bool_]
    magnitude: Floats
    match: NDArray[np.intp]

    @property
    def inliers(self) -> float:
        """Share of the correspondences that are of a match (table 3.1)."""
        return float((self.match >= 0).mean()) if len(self.match) else 0.0

    @property
    def weighted_inliers(self) -> float:
        """Share of the confidence that is of a match (table 3.1)."""
        total = float(self.magnitude.sum())
        return float(self.magnitude[self.match >= 0].sum()) / total if total else 0.0


def transformation_space(drawing: Drawing, matches: Matches, least: float = 0.0) -> TransformationSpace:
    """The refined correspondences behind matches, and the match that each belongs to.

    Parameters
    ----------
    drawing : Drawing
    matches : Matches
        As `match_regions` returned them, or filtered by `above`.
    least : float
        Correspondences of less magnitude are left out.

    Returns
    -------
    TransformationSpace

    Notes
    -----
    A correspondence lies on a match's function where their transformations of the query point differ by less than one
    unit of the normalised transformation space (section 3.2).
    """
    refined, nodes = matches.refined, matches.nodes
    if refined is None or nodes is None:
        none = np.zeros((0, 2))
        return TransformationSpace(
            none, none, none, none[:, 0], none[:, 0], np.zeros(0, bool), none[:, 0], np.zeros(0, np.intp)
        )
    shown = refined.chosen(refined.magnitude >= least)
    q = nodes.at[shown.node]
    image = np.where(shown.mirrored, np.conj(shown.image), shown.image)
    owner = np.full(len(shown), -1)
    nearest = np.ones(len(shown))
    for number, match in enumerate(matches):
        f = match.function
        gap = shown.distances(f.position[shown.node], f.factor[shown.node], matches.size)
        gap[shown.mirrored != f.mirrored] = np.inf
        better = gap < nearest
        owner[better], nearest[better] = number, gap[better]
    a, b = drawing.out_of_frame(q), drawing.out_of_frame(image)
    return TransformationSpace(
        a, b, b - a, np.abs(shown.factor), np.angle(shown.factor), shown.mirrored, shown.magnitude, owner
    )
