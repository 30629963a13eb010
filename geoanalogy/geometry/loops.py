"""Loops of directed edges: outlines of what is made of pieces."""

from collections import defaultdict
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError

Array = NDArray[np.float64]


def uncancelled(edges: Iterable[tuple[int, int, int]]) -> list[tuple[int, int, int]]:
    """Edges without pairs that run against each other.

    Parameters
    ----------
    edges : iterable of (int, int, int)
        From which vertex to which, and a number that stays with the edge.

    Returns
    -------
    list of (int, int, int)
        In order.
    """
    waiting: defaultdict[tuple[int, int], list[int]] = defaultdict(list)
    for a, b, number in edges:
        if waiting.get((b, a)):
            waiting[b, a].pop()
        else:
            waiting[a, b].append(number)
    return [(a, b, number) for (a, b), numbers in waiting.items() for number in numbers]


def linked_loops(
    edges: list[tuple[int, int, int]], points: Array, along: Array | None = None
) -> list[list[tuple[int, int]]]:
    """Edges as loops round single areas on their left: where several meet, the sharpest left turn goes on.

    Parameters
    ----------
    edges : list of (int, int, int)
        From which vertex to which, and a number that stays with the edge.
    points : ndarray of shape (n, 2)
        Of all vertices.
    along : ndarray of shape (m, 2), optional
        Directions of the edges by their number; None: from their points.

    Returns
    -------
    list of list of (int, int)
        Vertex, and number of the edge that leaves it.

    Raises
    ------
    InputError
        Where fewer edges leave a vertex than reach it.
    """
    leaving: defaultdict[int, list[int]] = defaultdict(list)
    for i, (a, _, _) in enumerate(edges):
        leaving[a].append(i)
    following = []
    for a, b, number in edges:
        choices = leaving[b]
        if not choices:
            raise InputError("the edges of a face form no loops; simplify the outline")
        if len(choices) > 1:
            came = points[b] - points[a] if along is None else along[number]
            going = [points[edges[i][1]] - points[b] if along is None else along[edges[i][2]] for i in choices]
            turns = [float(np.arctan2(came[0] * go[1] - came[1] * go[0], came @ go)) for go in going]
            following.append(choices.pop(int(np.argmax(turns))))
        else:
            following.append(choices.pop())
    loops, done = [], [False] * len(edges)
    for i in range(len(edges)):
        loop = []
        while not done[i]:
            done[i] = True
            loop.append((edges[i][0], edges[i][2]))
            i = following[i]
        if loop:
            loops.append(loop)
    return loops


def border(triangles: NDArray[np.intp], points: Array) -> list[list[int]]:
    """Loops of vertices round triangles of one plane, the triangles on their left.

    Parameters
    ----------
    triangles : ndarray of shape (k, 3), int
    points : ndarray of shape (n, 2)
        Of all vertices, in the plane.

    Returns
    -------
    list of list of int
    """
    edges = zip(triangles.ravel().tolist(), triangles[:, [1, 2, 0]].ravel().tolist(), strict=True)
    found = linked_loops(uncancelled((a, b, 0) for a, b in edges), points)
    return [[vertex for vertex, _ in loop] for loop in found]
