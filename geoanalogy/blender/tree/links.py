"""Links that are changed in the node editor: circles are refused, and what they have put out of date is marked."""

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial

import bpy

from .. import names
from . import node_settings, node_tree
from .store import operation_nodes, ordered_nodes, sources_by_node

#: How many seconds the tree tells what was refused.
READING_TIME = 12.0


def circle_in(tree: bpy.types.NodeTree) -> list[bpy.types.Node]:
    """The nodes that depend on each other in a circle.

    Parameters
    ----------
    tree : bpy.types.NodeTree

    Returns
    -------
    list of bpy.types.Node
        And those that depend on them.
    """
    waiting: dict[str, set[str]] = {node.name: set() for node in tree.nodes}
    for link in tree.links:
        waiting[link.to_node.name].add(link.from_node.name)
    while free := [name for name, sources in waiting.items() if not sources & waiting.keys()]:
        for name in free:
            del waiting[name]
    return [tree.nodes[name] for name in waiting]


def refuse_circles(tree: bpy.types.NodeTree) -> str | None:
    """Take back the links that were drawn last until nodes no longer depend on each other in a circle.

    Parameters
    ----------
    tree : bpy.types.NodeTree

    Returns
    -------
    str or None
        What was refused; None where there was no circle.
    """
    told = None
    while stuck := circle_in(tree):
        names_ = {node.name for node in stuck}
        link = next(k for k in reversed(tree.links) if {k.from_node.name, k.to_node.name} <= names_)
        told = (
            f"{link.from_node.name!r} cannot be linked to {link.to_node.name!r}, which it builds on itself: the nodes "
            "would form a circle; link it to a later one"
        )
        tree.links.remove(link)
    return told


def _sources_text(node: bpy.types.Node, sources: Sequence[tuple[bpy.types.Node, int]]) -> str:
    return json.dumps([sorted([source.name, output] for source, output in sources), node.mute])


#: Names of the trees whose links nobody looks at for the moment.
_unwatched: set[str] = set()


@contextmanager
def unwatched(tree: bpy.types.NodeTree) -> Iterator[None]:
    """Many nodes are added at once, and their links are known to be sound.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    """
    _unwatched.add(tree.name)
    try:
        yield
    finally:
        _unwatched.discard(tree.name)
        forget_changes(tree)


def check_links(tree: bpy.types.NodeTree) -> None:
    """Look at links that have been changed.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    """
    if tree.name in _unwatched:
        return
    told = refuse_circles(tree)
    if told is not None:
        _tell(tree, told)
    changed: set[str] = set()
    by_node = sources_by_node(tree)
    for node in ordered_nodes(tree):
        sources = by_node.get(node.name, [])
        now = _sources_text(node, sources)
        relinked = names.SOURCES in node and node[names.SOURCES] != now
        if relinked or any(source.name in changed for source, _ in sources):
            changed.add(node.name)
            node[names.STALE] = True
        if node.get(names.SOURCES) != now:
            node[names.SOURCES] = now
    if changed and told is None:
        tree.pop(names.PROBLEM, None)


def mark_edited(node: bpy.types.Node) -> None:
    """Mark an operation whose settings have been edited, and all that build on it.

    Parameters
    ----------
    node : bpy.types.Node
    """
    node.id_data.pop(names.PROBLEM, None)
    changed, by_node = {node.name}, sources_by_node(node.id_data)
    for other in ordered_nodes(node.id_data):
        if other.name in changed or any(source.name in changed for source, _ in by_node.get(other.name, ())):
            changed.add(other.name)
            other[names.STALE] = True


def forget_changes(tree: bpy.types.NodeTree) -> None:
    """Take links as they are now: everything has been evaluated with them.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    """
    tree.pop(names.PROBLEM, None)
    by_node = sources_by_node(tree)
    for node in operation_nodes(tree):
        node[names.SOURCES] = _sources_text(node, by_node.get(node.name, []))


def let_go(tree: str, sentence: str) -> None:
    """Forget what was refused: the tree has been sound ever since, and whoever linked has had the time to read it.

    Parameters
    ----------
    tree : str
        Name of a tree, which may be gone.
    sentence : str
        What the tree says of it; another problem stays.
    """
    found = bpy.data.node_groups.get(tree)
    if found is not None and found.get(names.PROBLEM) == sentence:
        del found[names.PROBLEM]
        for window in bpy.context.window_manager.windows:
            for area in window.screen.areas:
                area.tag_redraw()


def _tell(tree: bpy.types.NodeTree, sentence: str) -> None:
    """Say what was refused for a while, as no operator runs that could report it."""
    tree[names.PROBLEM] = sentence
    bpy.app.timers.register(partial(let_go, tree.name, sentence), first_interval=READING_TIME)
    if not bpy.app.background and bpy.context.window is not None:

        def draw(self, context):
            self.layout.label(text=sentence)

        bpy.context.window_manager.popup_menu(draw, title="Not linked", icon="ERROR")


def register():
    """Look at links and settings whenever they change."""
    node_tree.on_linked.append(check_links)
    node_settings.on_edited.append(mark_edited)


def unregister():
    """No longer do so."""
    node_settings.on_edited.remove(mark_edited)
    node_tree.on_linked.remove(check_links)
