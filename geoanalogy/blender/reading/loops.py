"""Closed loops of edges: the outlines of joined faces, and of meshes that are edges only."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ...errors import InputError

Indices = NDArray[np.intp]


def joined_faces(face_of_corner: Indices, edge_of_corner: Indices, faces: int) -> Indices:
    """The region of each face: faces that share an edge belong to one.

    Parameters
    ----------
    face_of_corner, edge_of_corner : ndarray of shape (c,), int
        Face and edge of each corner; an edge runs from its corner to the face's next one.
    faces : int
        Number of faces.

    Returns
    -------
    ndarray of shape (faces,), int
        Regions are numbered by their first faces.
    """
    order = np.argsort(edge_of_corner, kind="stable")
    face, edge = face_of_corner[order], edge_of_corner[order]
    shared = np.flatnonzero(edge[1:] == edge[:-1])
    links = coo_array((np.ones(len(shared)), (face[shared], face[shared + 1])), shape=(faces, faces))
    return connected_components(links, directed=False)[1].astype(np.intp)


def outlines(start: Indices, end: Indices) -> list[Indices]:
    """The closed loops that directed edges form.

    Parameters
    ----------
    start, end : ndarray of shape (n,), int
        Vertices of each edge, in one sense along each loop.

    Returns
    -------
    list of ndarray of int
        Vertices of each loop in order, from the start of its first edge.
    """
    following = dict(zip(start.tolist(), end.tolist(), strict=True))
    loops = []
    for first in start.tolist():
        loop = []
        vertex = first
        while vertex in following:
            loop.append(vertex)
            vertex = following.pop(vertex)
        if len(loop) > 2:
            loops.append(np.array(loop, dtype=np.intp))
    return loops


def chains(edges: Indices, vertices: int, name: str) -> list[Indices]:
    """The closed loops of a mesh that has edges only.

    Parameters
    ----------
    edges : ndarray of shape (n, 2), int
    vertices : int
        Number of vertices.
    name : str
        What the mesh is called in messages.

    Returns
    -------
    list of ndarray of int
        Vertices of each loop in order.

    Raises
    ------
    InputError
        Where a line ends or branches.
    """
    degree = np.bincount(edges.ravel(), minlength=vertices)
    if np.any(degree == 1):
        raise InputError(f"{name} has an open line that ends at vertex {int(np.argmax(degree == 1))}; close it")
    if np.any(degree > 2):
        raise InputError(f"{name} has lines that branch at vertex {int(np.argmax(degree > 2))}; draw simple rings")
    neighbours: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    loops = []
    while neighbours:
        loop = [next(iter(neighbours))]
        while True:
            step = next((k for k in neighbours.pop(loop[-1]) if k in neighbours), None)
            if step is None:
                break
            loop.append(step)
        loops.append(np.array(loop, dtype=np.intp))
    return loops
