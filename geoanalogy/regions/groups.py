"""Whole groups of lines as candidates: what stands by itself may be the target as a whole.

Drawings of many short strokes have no course to align and too little line for descriptors whose scale is a turn. Lines
that lie near each other and far from the rest are then the best evidence: the query is laid over each such group, by
its centre and size, in every direction, and the directions that bring lines onto lines are kept.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ..geometry.contours import Complex
from .target import Target

#: Gaps, in extents of the query, that part groups.
GAPS = (0.05, 0.12, 0.25)
#: Directions that are tried, and kept for each group.
DIRECTIONS, KEPT = 24, 3
#: Distance, in extents of the query at the target's scale, beyond which a line is as good as absent.
FAR = 0.1
#: Groups at most, largest first, and about how many points of the lines tell them.
MOST_GROUPS, MOST_POINTS = 24, 20_000


def groups(target: Target, gap: float) -> list[NDArray[np.intp]]:
    """Sets of points of lines that are nearer than a gap to each other, most line first.

    Parameters
    ----------
    target : Target
    gap : float

    Returns
    -------
    list of (n,) int
    """
    stride = max(1, int(0.25 * gap / float(np.median(target.spacing))), len(target.points) // MOST_POINTS)
    some = np.flatnonzero(target.place % stride == 0)  # of every line its first point, however short it is
    xy = np.stack([target.points[some].real, target.points[some].imag], 1)
    near = cKDTree(xy).sparse_distance_matrix(cKDTree(xy), gap, output_type="coo_matrix")
    _, part = connected_components(near, directed=False)
    found = np.split(some[np.argsort(part, kind="stable")], np.cumsum(np.bincount(part))[:-1])
    found.sort(key=lambda g: -round(float(target.spacing[g].sum()), 9))
    return found[:MOST_GROUPS]


def laid_over(
    target: Target, samples: Complex, size: float, mirrored: bool, largest_scale: float
) -> list[tuple[complex, complex, bool]]:
    """Similarities that lay the samples of the query's lines over groups of lines.

    Parameters
    ----------
    target : Target
    samples : (s,) complex
        Points of the query's lines.
    size : float
        Extent of the query.
    mirrored : bool
        Whether mirrored targets are wanted.
    largest_scale : float
        Groups that differ more in size than this are left out.

    Returns
    -------
    list of (complex, complex, bool)
        (a, b, mirrored): z -> a z + b, conjugated afterwards where mirrored; best first.
    """
    middle, spread = samples.mean(), _spread(samples)
    tried: list[tuple[float, complex, complex, bool]] = []
    seen: set[tuple[int, int]] = set()
    for gap in GAPS:
        for group in groups(target, gap * size):
            points = target.points[group]
            scale = _spread(points) / spread
            if not 1.0 / largest_scale <= scale <= largest_scale or (int(group[0]), int(group[-1])) in seen:
                continue
            seen.add((int(group[0]), int(group[-1])))
            tree = cKDTree(np.stack([points.real, points.imag], 1))
            for flip in (False, True) if mirrored else (False,):
                goal = np.conj(points.mean()) if flip else points.mean()
                turn = scale * np.exp(2j * np.pi * np.arange(DIRECTIONS) / DIRECTIONS)
                image = turn[:, None] * (samples - middle) + goal
                shown = np.conj(image) if flip else image
                unit = FAR * size * scale
                there, _ = tree.query(np.stack([shown.real, shown.imag], -1), distance_upper_bound=unit)
                miss = np.minimum(there / unit, 1.0).mean(1)
                best = [k for k in range(DIRECTIONS) if miss[k] <= min(miss[k - 1], miss[(k + 1) % DIRECTIONS])]
                for k in sorted(best, key=lambda k: float(miss[k]))[:KEPT]:
                    tried.append((float(miss[k]), complex(turn[k]), complex(goal - turn[k] * middle), flip))
    tried.sort(key=lambda t: t[0])
    return [(a, b, flip) for _, a, b, flip in tried]


def _spread(z: Complex) -> float:
    """Root mean square distance from the centre."""
    return float(np.sqrt((np.abs(z - z.mean()) ** 2).mean()))
