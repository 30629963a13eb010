"""What comes of applying an operations tree: the elements with their meshes, and what could not be done."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ..geometry.frame import Frame
from ..geometry.mesh import Mesh
from ..geometry.surface import Surface
from .element import Element
from .layout import Layout


class Applied(list[Element]):
    """The elements, node by node; within a node the examples, then the results, best first.

    The mesh of an element is the name of the library object that stands there, or what it was extruded to, in space.

    Parameters
    ----------
    layout : Layout
        What has flowed out of the tree.
    hit_rate : float
        Share of the evaluations on surfaces that equal surfaces had made before.
    library : mapping of str to Mesh, optional
        Library objects in their own coordinates, to be put in their places; None: they stay names.

    Attributes
    ----------
    layout : Layout
    problems : tuple of str
        What could not be done, a sentence each; the rest has been.
    hit_rate : float
    """

    def __init__(self, layout: Layout, hit_rate: float = 0.0, library: Mapping[str, Mesh] | None = None) -> None:
        super().__init__(with_geometry(e, library) for e in layout.elements)
        self.layout = layout
        self.hit_rate = hit_rate
        self.problems = (*layout.problems, *missing(layout.elements, library))

    @property
    def surfaces(self) -> list[Surface]:
        """All surfaces: those chosen by the user, and those of the solids."""
        return list(Layout(self.layout.ground, self.layout.elements, chosen=self.layout.chosen).surfaces())


@dataclass(frozen=True)
class Instance:
    """A shape and where it stands; equal shapes are one object.

    Attributes
    ----------
    element : Element
    mesh : Mesh or str
        In its own coordinates; the name of a library object.
    frame : Frame
        The place.
    scale : (float, float, float)
        Sizes along the frame's axes in proportion to the mesh.
    """

    element: Element
    mesh: Mesh | str
    frame: Frame
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)


def instances(elements: Iterable[Element]) -> list[Instance]:
    """What stands in the scene, as instances: for writing thousands of equal objects at once.

    Parameters
    ----------
    elements : iterable of Element
        Of a layout.

    Returns
    -------
    list of Instance
        Without elements that have become part of others, and without points and flat outlines.
    """
    found = []
    for e in elements:
        if e.absorbed_by:
            continue
        if e.solid is not None:
            found.append(Instance(e, e.solid.mesh, e.place))
        elif isinstance(e.mesh, str) and e.mesh:
            (x, y), s = e.stretch, e.scale
            found.append(Instance(e, e.mesh, e.place, (s * x, s * y * (-1.0 if e.pose.mirrored else 1.0), s)))
    return found


def with_geometry(element: Element, library: Mapping[str, Mesh] | None = None) -> Element:
    """The element with the mesh that it has in space, where it is known.

    Parameters
    ----------
    element : Element
    library : mapping of str to Mesh, optional

    Returns
    -------
    Element
    """
    if element.solid is None and element.mesh:
        shape = None if library is None else library.get(str(element.mesh))
        if shape is None:
            return element
        (x, y), s = element.stretch, element.scale
        scaled = Mesh(
            shape.vertices * (s * x, s * y * (-1.0 if element.pose.mirrored else 1.0), s),
            shape.faces[:, ::-1] if element.pose.mirrored else shape.faces,
            shape.uv,
            shape.materials,
            shape.material_index,
        )
        return element.changed(mesh=scaled.placed(element.place))
    made = element.geometry
    return element if made is None else element.changed(mesh=made)


def missing(elements: Iterable[Element], library: Mapping[str, Mesh] | None) -> list[str]:
    """A sentence for every library object that there is not.

    Parameters
    ----------
    elements : iterable of Element
    library : mapping of str to Mesh or None
        None: not known here.

    Returns
    -------
    list of str
    """
    if library is None:
        return []
    names = {str(e.mesh): e.node for e in elements if isinstance(e.mesh, str) and e.mesh and e.solid is None}
    return [
        f"node {node!r}: the library object {name!r} is missing; its places stay empty, add it to the library"
        for name, node in names.items()
        if name not in library
    ]
