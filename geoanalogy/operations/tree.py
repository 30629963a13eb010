"""The operations tree: recorded edits that are applied to any scene (section 5.6)."""

import heapq
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from ..arguments import given, is_whole, listed, shown
from ..errors import InputError
from ..geometry.mesh import Mesh
from ..geometry.scene import Scene
from ..geometry.surface import Surface
from ..progress import Progress, Stepper, run, within
from .applied import Applied
from .evaluation import Evaluations
from .layout import Layout, merge
from .node import Link, Node
from .storage import read_json, stored_nodes, with_schema, write_json


class OperationsTree:
    """Nodes and the links between them. Never changed: edits make a new tree.

    A node sees the scene and what the nodes upstream of it have placed, no more; so it does not matter in which order
    independent branches are listed or evaluated, and operations recorded one after the other are linked in a chain.

    Parameters
    ----------
    nodes : iterable of Node
        In any order.
    evaluations : Evaluations, optional
        What has been computed before, by this or another tree; handing it on is what makes an edited tree evaluate only
        what changed.

    Attributes
    ----------
    nodes : tuple of Node
        Inputs first; among nodes that could come next, the one whose id comes first.
    evaluations : Evaluations

    Raises
    ------
    InputError
        Where two nodes share an id, an input is not there, or nodes depend on each other in a circle.
    """

    def __init__(self, nodes: Iterable[Node] = (), evaluations: Evaluations | None = None) -> None:
        every = listed(nodes, "what the tree is made of", "a list of nodes")
        for node in every:
            given(node, Node, "a node of the tree", "Node(id, operation)")
        self._by_id = {node.id: node for node in every}
        if len(self._by_id) < len(every):
            twice = sorted({a.id for i, a in enumerate(every) if a.id in {b.id for b in every[:i]}})
            raise InputError(f"several nodes are called {twice[0]!r}; give each node an id of its own")
        self.nodes: tuple[Node, ...] = tuple(self._ordered())
        self.evaluations = Evaluations() if evaluations is None else evaluations

    def __repr__(self) -> str:
        return f"OperationsTree({len(self.nodes)} nodes)"

    def _ordered(self) -> list[Node]:
        users: dict[str, list[str]] = {id: [] for id in self._by_id}
        waiting = {}
        for node in self._by_id.values():
            for link in node.inputs:
                if link.node not in self._by_id:
                    raise InputError(
                        f"node {node.id!r} has the input {link.node!r}, which is not in the tree; relink it"
                    )
                if not 0 <= link.output < self._by_id[link.node].operation.outputs:
                    raise InputError(
                        f"node {node.id!r} asks for output {link.output} of node {link.node!r}, which has "
                        f"{self._by_id[link.node].operation.outputs}; relink it"
                    )
            sources = {link.node for link in node.inputs}
            waiting[node.id] = len(sources)
            for source in sources:
                users[source].append(node.id)
        ready = [id for id, count in waiting.items() if count == 0]
        heapq.heapify(ready)
        order = []
        while ready:
            id = heapq.heappop(ready)
            order.append(self._by_id[id])
            for user in users[id]:
                waiting[user] -= 1
                if waiting[user] == 0:
                    heapq.heappush(ready, user)
        if len(order) < len(self._by_id):
            stuck = min(set(waiting) - {node.id for node in order})
            raise InputError(f"the nodes form a circle through {stuck!r}; remove one of its links")
        return order

    def node(self, id: str) -> Node:
        """The node of an id.

        Parameters
        ----------
        id : str

        Returns
        -------
        Node

        Raises
        ------
        InputError
            Where the tree has none of that id.
        """
        if not isinstance(id, str) or id not in self._by_id:
            raise InputError(f"the tree has no node {shown(id)}; it has {len(self.nodes)} nodes, check the id")
        return self._by_id[id]

    def with_node(self, node: Node) -> "OperationsTree":
        """The tree with one more node, or with the node of that id replaced.

        Parameters
        ----------
        node : Node

        Returns
        -------
        OperationsTree
            It shares what has been evaluated.
        """
        return OperationsTree({**self._by_id, node.id: node}.values(), self.evaluations)

    def with_tree(self, other: "OperationsTree", after: Sequence[Link], prefix: str = "") -> "OperationsTree":
        """The tree with another one grown onto it, which was learned apart.

        Parameters
        ----------
        other : OperationsTree
            Its nodes without inputs get those given.
        after : sequence of Link
            Outputs of this tree: the chosen leaves.
        prefix : str
            Put before the ids of the other's nodes, and so in front of the names that chance and corrections go by.

        Returns
        -------
        OperationsTree
            It shares what this one has evaluated.

        Raises
        ------
        InputError
            Where a node of the other has the id of one of this.
        """
        grown = []
        for node in other.nodes:
            links = tuple(Link(prefix + link.node, link.output) for link in node.inputs) or tuple(after)
            grown.append(replace(node, id=prefix + node.id, inputs=links))
        return OperationsTree([*self.nodes, *grown], self.evaluations)

    @property
    def leaves(self) -> tuple[str, ...]:
        """Ids of the nodes that no other node takes its input from."""
        used = {link.node for node in self.nodes for link in node.inputs}
        return tuple(node.id for node in self.nodes if node.id not in used)

    def apply(
        self,
        scene: Scene,
        seed: int = 0,
        progress: Progress | None = None,
        library: Mapping[str, Mesh] | None = None,
        surfaces: Sequence[Surface] = (),
    ) -> Applied:
        """All elements that the tree places on a scene.

        Parameters
        ----------
        scene : Scene
        seed : int
            Of all chance in the tree.
        progress : callable (fraction, text) -> bool, optional
            Returning False cancels.
        library : mapping of str to Mesh, optional
            The library objects by name; None: elements keep their names.
        surfaces : sequence of Surface
            Chosen by the user, to be placed on like the ground.

        Returns
        -------
        Applied
            The list of elements, node by node in the tree's order; within a node the examples, then the results, best
            first. With the problems that single parcels made.

        Raises
        ------
        InputError
            Where a node cannot be evaluated.
        Cancelled
            When `progress` returned False.
        """
        return run(self.steps(scene, seed, library, surfaces), progress)

    def steps(
        self,
        scene: Scene,
        seed: int = 0,
        library: Mapping[str, Mesh] | None = None,
        surfaces: Sequence[Surface] = (),
    ) -> Stepper[Applied]:
        """The stepper behind `apply`.

        Parameters
        ----------
        scene : Scene
        seed : int
        library : mapping of str to Mesh, optional
        surfaces : sequence of Surface

        Returns
        -------
        generator of (float, str)
            Returns what was applied.
        """
        if library is not None:
            given(library, Mapping, "the library", "a mesh per name")
        layout = yield from self.layout_steps(scene, seed=seed, surfaces=surfaces)
        scene.memory.settle()
        return Applied(layout, self.evaluations.hit_rate, library)

    def layout(
        self,
        scene: Scene,
        node: str | Sequence[Link] | None = None,
        seed: int = 0,
        progress: Progress | None = None,
        surfaces: Sequence[Surface] = (),
    ) -> Layout:
        """What flows out of a node: the layout that the next operation after it sees.

        Parameters
        ----------
        scene : Scene
        node : str or sequence of Link, optional
            Its first output, or what several outputs give together; None: what has been placed in the end.
        seed : int
        progress : callable (fraction, text) -> bool, optional
            Returning False cancels.
        surfaces : sequence of Surface
            Chosen by the user.

        Returns
        -------
        Layout

        Raises
        ------
        InputError
            Where a node cannot be evaluated.
        Cancelled
            When `progress` returned False.
        """
        return run(self.layout_steps(scene, node, seed, surfaces), progress)

    def layout_steps(
        self,
        scene: Scene,
        node: str | Sequence[Link] | None = None,
        seed: int = 0,
        surfaces: Sequence[Surface] = (),
    ) -> Stepper[Layout]:
        """The stepper behind `layout`.

        Parameters
        ----------
        scene : Scene
        node : str or sequence of Link, optional
        seed : int
        surfaces : sequence of Surface

        Returns
        -------
        generator of (float, str)
            Returns the layout.
        """
        given(scene, Scene, "the scene", "Scene([polygon, …])")
        if not is_whole(seed):
            raise InputError(f"the seed is {shown(seed)}; give a whole number")
        seed = int(seed)
        for surface in (surfaces := listed(surfaces, "what is chosen as surfaces", "a list of surfaces")):
            given(surface, Surface, "a chosen surface", "Surface(…)")
        rank = {n.id: i for i, n in enumerate(self.nodes)}
        links = [Link(node)] if isinstance(node, str) else self._open() if node is None else list(node)
        wanted = self._upstream(self.node(link.node).id for link in links)
        needed = [n for n in self.nodes if n.id in wanted]
        outputs: dict[str, tuple[Layout, ...]] = {}
        bare = Layout(scene, chosen=surfaces)

        def joined(links: Iterable[Link]) -> Layout:
            sources = sorted(set(links), key=lambda k: (rank[k.node], k.output))
            return merge(scene, [outputs[k.node][k.output] for k in sources] or [bare], rank)

        for i, current in enumerate(needed):
            yield i / len(needed), current.id
            step = self.evaluations.steps(current, joined(current.inputs), seed)
            outputs[current.id] = yield from within(step, i / len(needed), (i + 1) / len(needed))
        return joined(links)

    def _open(self) -> list[Link]:
        """The outputs that no node takes its input from."""
        used = {link for n in self.nodes for link in n.inputs}
        return [link for n in self.nodes for k in range(n.operation.outputs) if (link := Link(n.id, k)) not in used]

    def _upstream(self, ids: Iterable[str]) -> set[str]:
        found: set[str] = set()
        stack = list(ids)
        while stack:
            id = stack.pop()
            if id not in found:
                found.add(id)
                stack += [link.node for link in self._by_id[id].inputs]
        return found

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON.

        Returns
        -------
        dict
        """
        return with_schema([node.to_dict() for node in self.nodes])

    @classmethod
    def from_dict(cls, plain: Any, name: str = "the operations tree") -> "OperationsTree":
        """The tree that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping
        name : str
            What it is called in messages: the file it comes from.

        Returns
        -------
        OperationsTree

        Raises
        ------
        InputError
            For anything but a tree of this version, naming the node.
        """
        nodes = stored_nodes(plain, name)
        try:
            return cls([Node.from_dict(node) for node in nodes])
        except InputError as error:
            raise InputError(f"{name}: {error}") from None

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "OperationsTree":
        """Read a tree from a file.

        Parameters
        ----------
        path : path

        Returns
        -------
        OperationsTree

        Raises
        ------
        InputError
            Where the file cannot be read, is cut off, or holds no tree of this version.
        """
        return cls.from_dict(*read_json(path))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the tree to a file. Where that fails, a file of that name stays as it was.

        Parameters
        ----------
        path : path

        Raises
        ------
        InputError
            Where the file cannot be written.
        """
        write_json(self.to_dict(), path)
