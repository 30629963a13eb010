"""Evaluating all nodes of a tree and showing what comes of it: what trees need that make solids.

There, a window that is placed elsewhere changes the wall that it is cut into, so that no node's results can be shown
for themselves. What has not changed is not evaluated again.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import bpy

from ...operations.layout import Layout
from ...operations.node import Node
from ...progress import Stepper, run, within
from .. import names
from ..counting import counted
from ..reading.identity import keep_ids
from ..writing.instances import arrange_collections, clear_results, collection_of, is_instance
from ..writing.masses import write_masses
from .evaluating import Surroundings, read_surroundings, write_node
from .links import forget_changes
from .store import builds, ordered_nodes, placed_by, recorded_nodes, require_operations, works_everywhere


@dataclass(frozen=True)
class Shown:
    """What stands in the scene.

    Attributes
    ----------
    objects : int
        Library objects in their places, as results of operations.
    masses : int
        Solids and outlines.
    problems : tuple of str
        What could not be done, a sentence each; the rest has been.
    """

    objects: int
    masses: int
    problems: tuple[str, ...]

    @property
    def text(self) -> str:
        """What to tell the user."""
        solids = f", {self.masses} solids and outlines" if self.masses else ""
        return told(f"{counted(self.objects, 'object')}{solids}", self.problems)


def told(done: str, problems: Sequence[str]) -> str:
    """What was done, and the first of the problems.

    Parameters
    ----------
    done : str
    problems : sequence of str

    Returns
    -------
    str
    """
    if not problems:
        return done
    more = f" (and {len(problems) - 1} more problems)" if len(problems) > 1 else ""
    return f"{done}; {problems[0]}{more}"


def whole_steps(
    every: Sequence[Surroundings], changed: Iterable[Node] = (), seed: int | None = None
) -> Stepper[list[Layout]]:
    """Evaluate all nodes, as a stepper.

    Parameters
    ----------
    every : sequence of Surroundings
    changed : iterable of Node
        Nodes that are added to the trees, or put in place of those of their names.
    seed : int, optional
        None: the trees' own.

    Returns
    -------
    generator of (float, str)
        Returns what has flowed out in the end, a Layout per plane.
    """
    found = []
    for i, around in enumerate(every):
        for node in changed:
            around.engine = around.engine.with_node(node)
        steps = around.engine.layout_steps(around.ground.scene, None, around.seed if seed is None else seed)
        found.append((yield from within(steps, i / len(every), (i + 1) / len(every))))
    return found


def write_whole(
    scene: bpy.types.Scene, tree: bpy.types.NodeTree, every: Sequence[Surroundings], layouts: Sequence[Layout]
) -> Shown:
    """Show what has flowed out of a tree in place of what was shown before.

    Parameters
    ----------
    scene : bpy.types.Scene
    tree : bpy.types.NodeTree
    every : sequence of Surroundings
    layouts : sequence of Layout
        By `whole_steps`.

    Returns
    -------
    Shown
    """
    nodes = ordered_nodes(tree)
    rank = [node.name for node in nodes]
    keep_ids(scene, [around.ground.scene for around in every])
    made = {item[names.NODE] for item in scene.objects if names.KEY in item}
    gone = made - {node.name for node in recorded_nodes(tree)}
    clear_results(scene, [name for name in sorted(gone) if collection_of(scene, name)])
    count, library = 0, set()
    for node in nodes:
        own = [
            (around, layout.elements)
            for around, layout in zip(every, layouts, strict=True)
            if works_everywhere(node) or node in around.nodes
        ]
        count += write_node(node, own) if own else 0
        library |= {one.mesh for one in placed_by(node) if one.item is not None}
    parts = [(around.plane, layout) for around, layout in zip(every, layouts, strict=True)] if builds(tree) else []
    masses = write_masses(scene, parts, library, tree.merged)
    arrange_collections(scene, rank)
    problems = [*every[0].problems, *(p for layout in layouts for p in layout.problems)]
    instances = (e for layout in layouts for e in layout.elements if is_instance(e))
    missing = {str(e.mesh): e.node for e in instances if e.mesh not in library}
    problems += [
        f"node {node!r}: the library object {name!r} is missing; outlines take its places, add an object of that name"
        for name, node in missing.items()
    ]
    for node in nodes:
        told = next((p for p in problems if p.startswith(f"node {node.name!r}: ")), None)
        if told is not None:
            node[names.PROBLEM] = told.partition(": ")[2]
    forget_changes(tree)
    return Shown(count, masses, tuple(dict.fromkeys(problems)))


def show_whole(context: bpy.types.Context) -> Shown:
    """Show what the nodes' settings and decisions give now.

    Parameters
    ----------
    context : bpy.types.Context

    Returns
    -------
    Shown

    Raises
    ------
    InputError
        Where the scene has no operations, or one of them cannot be evaluated.
    """
    tree = require_operations(context.scene)
    every = read_surroundings(context)
    return write_whole(context.scene, tree, every, run(whole_steps(every)))
