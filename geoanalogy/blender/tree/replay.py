"""Replaying the operations of a scene, or of a file."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import bpy

from ...errors import InputError
from ...progress import Stepper, run, within
from .. import names, register
from ..counting import counted
from ..regions.recording import replayed_steps, write_replayed
from ..writing.picture import draw_picture
from ..writing.saving import save_copy
from .evaluating import read_surroundings
from .lessons import relearned_steps
from .store import drawing_nodes, operation_nodes, ordered_nodes, require_operations, tree_of
from .whole import told, whole_steps, write_whole
from .writing_nodes import write_operation


@dataclass(frozen=True)
class Report:
    """What a replay has done.

    Attributes
    ----------
    operations : int
        How many were replayed; muted ones do not count.
    objects : int
        How many results stand there.
    masses : int
        How many solids and outlines.
    problems : tuple of str
        What could not be done, a sentence each.
    """

    operations: int
    objects: int
    masses: int = 0
    problems: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """What to tell the user."""
        solids = f", {self.masses} solids and outlines" if self.masses else ""
        return told(
            f"{counted(self.operations, 'operation')}, {counted(self.objects, 'result')}{solids}", self.problems
        )


def replay_steps(
    context: bpy.types.Context, *, seed: int | None = None, threshold: float | None = None
) -> Stepper[Report]:
    """Replay the operations of a scene on what stands there and is drawn now.

    Nothing is written before the last step.

    Parameters
    ----------
    context : bpy.types.Context
    seed : int, optional
        Of the operations that draw lots; None: the tree's own.
    threshold : float, optional
        Least importance, or similarity, of a result; None: each operation's own.

    Returns
    -------
    generator of (float, str)
        Returns the Report.

    Raises
    ------
    InputError
        Where the scene has no operations, or one of them cannot be replayed.
    """
    tree = tree_of(context.scene)
    drawn = drawing_nodes(tree)
    if not drawn:
        return (yield from _on_polygons_steps(context, seed=seed, threshold=threshold))
    share = 0.5 if operation_nodes(tree) else 1.0
    transfers = yield from within(replayed_steps(context, drawn, threshold), 0.0, share)
    report = Report(0, 0)
    if operation_nodes(tree):
        report = yield from within(_on_polygons_steps(context, seed=seed, threshold=threshold), share, 1.0)
    shown = write_replayed(context.scene, transfers)
    context.view_layer.update()
    muted = sum(node.mute for node in drawn)
    return replace(report, operations=report.operations + len(drawn) - muted, objects=report.objects + shown)


def _on_polygons_steps(
    context: bpy.types.Context, *, seed: int | None = None, threshold: float | None = None
) -> Stepper[Report]:
    """Replay the operations that work on polygons, on what stands there now.

    Operations whose examples have been moved are learned again. Nothing is written before the last step.

    Parameters
    ----------
    context : bpy.types.Context
    seed : int, optional
        Of the operations that draw lots; None: the tree's own.
    threshold : float, optional
        Least importance of a result; None: each operation's own.

    Returns
    -------
    generator of (float, str)
        Returns the Report.

    Raises
    ------
    InputError
        Where the scene has no operations, or one of them cannot be replayed.
    """
    tree = require_operations(context.scene)
    every = read_surroundings(context)
    if seed is None:
        seed = tree.seed
    nodes = ordered_nodes(tree)
    before = {node.id: node.operation for node in every[0].engine.nodes}
    for i, node in enumerate(nodes):
        own = [around for around in every if node in around.nodes]
        operation = yield from within(relearned_steps(own, node), 0.5 * i / len(nodes), 0.5 * (i + 1) / len(nodes))
        if threshold is not None and hasattr(operation, "threshold"):
            operation = replace(operation, threshold=threshold)
        for around in own:
            around.engine = around.engine.with_node(replace(around.engine.node(node.name), operation=operation))
    layouts = yield from within(whole_steps(every, seed=seed), 0.5, 1.0)
    yield 1.0, "placing objects"
    if tree.seed != seed:
        tree.seed = seed
    for node in nodes:
        node.pop(names.UNFAMILIAR, None)  # faces may have gone or come
        around = next(around for around in every if node in around.nodes)
        after = around.engine.node(node.name)
        if after.operation is not before[node.name]:
            write_operation(node, after)
    shown = write_whole(context.scene, tree, every, layouts)
    context.view_layer.update()
    return Report(sum(not node.mute for node in operation_nodes(tree)), shown.objects, shown.masses, shown.problems)


def replay_file(
    source: Path | None,
    *,
    output: Path | None,
    render: Path | None,
    seed: int | None,
    threshold: float | None,
    progress: Callable[[float, str], bool],
) -> Report:
    """Replay the operations of a file, and write the scene, a picture of it, or both.

    Parameters
    ----------
    source : Path or None
        A .blend; None: the file that is open.
    output, render : Path or None
        The .blend and the .png to write.
    seed : int or None
        Of the operations that draw lots; None: the scenes' own.
    threshold : float or None
        Least importance of a result; None: each operation's own.
    progress : callable (fraction, text) -> bool
        Returning False cancels.

    Returns
    -------
    Report
        Of the scene that the file opens with.

    Raises
    ------
    InputError
        Where the file is missing, cannot be read, or has no operations, and where one cannot be replayed.
    Cancelled
        When `progress` returned False, which it is not asked any more once writing has begun.
    OSError
        When a file cannot be written.
    """
    if not hasattr(bpy.types.Scene, "geoanalogy"):
        register()
    if source is not None:
        open_file(source)
    scene = bpy.context.scene
    report = run(replay_steps(bpy.context, seed=seed, threshold=threshold), progress)
    if render is not None:
        draw_picture(scene, render)
    if output is not None:
        save_copy(output)
    return report


def open_file(source: Path) -> None:
    """Open a .blend.

    Parameters
    ----------
    source : Path

    Raises
    ------
    InputError
        Where it is missing, empty or no .blend, or this Blender cannot read it.
    """
    if not source.is_file():
        raise InputError(f"{source} is not there; check the path")
    if not source.stat().st_size:
        raise InputError(f"{source} is empty; save it again")
    try:
        bpy.ops.wm.open_mainfile(filepath=str(source), load_ui=False)
    except RuntimeError as error:
        raise InputError(f"{source} cannot be opened ({_first_line(error)}); save it again") from None


def _first_line(error: Exception) -> str:
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    return lines[0].removeprefix("Error: ").rstrip(".") if lines else type(error).__name__
