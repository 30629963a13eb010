"""The lines on which targets are looked for, and walking along them."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..geometry.contours import Contours
from .query import Query


class Target:
    """The lines on which targets are looked for: the contours outside the query."""

    def __init__(self, contours: Contours, query: Query):
        keep = ~query.inside
        self.index = np.flatnonzero(keep)
        self.points = contours.points[keep]
        self.heading = contours.heading[keep]
        self.spacing = contours.weight[keep]
        line = contours.line[keep]
        gap = np.flatnonzero(np.diff(self.index) > 1) + 1
        begin = np.unique(np.concatenate([[0], np.flatnonzero(np.diff(line)) + 1, gap])).astype(int)
        self.stretch = np.zeros(len(line), int)
        self.stretch[begin[1:]] = 1
        self.stretch = np.cumsum(self.stretch)
        self.begin = begin
        self.count = np.diff(np.append(begin, len(line)))
        whole = self.count == np.diff(contours.first)[line[begin]]
        self.closed = contours.closed[line[begin]] & whole
        # number of a point along its stretch, and of points once round it
        self.place = np.arange(len(line)) - begin[self.stretch]
        self.around = np.where(self.closed, self.count, 10**9)[self.stretch]
        self.tree = cKDTree(np.stack([self.points.real, self.points.imag], 1))

    def walk(self, start: NDArray[np.intp], offset: NDArray[np.intp]) -> NDArray[np.intp]:
        """Indices `offset` points along the line from `start`; -1 beyond the end of an open one."""
        k = self.stretch[start]
        at = start - self.begin[k] + offset
        n = self.count[k]
        out = self.begin[k] + at % n
        return np.where(self.closed[k] | ((at >= 0) & (at < n)), out, -1)
