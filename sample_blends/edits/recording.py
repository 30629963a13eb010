"""Record edits as an operations tree, without Blender: the tree then places everything, here or on another plan."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

import geoanalogy as ga
from geoanalogy.operations.array_placement import ArrayPlacement
from geoanalogy.operations.group_placement import GroupPlacement
from geoanalogy.operations.node import Link, Node
from geoanalogy.operations.operation import Operation
from geoanalogy.operations.pose_placement import PosePlacement
from geoanalogy.operations.rectangle_placement import RectanglePlacement
from geoanalogy.operations.scatter_placement import ScatterPlacement
from geoanalogy.poses.arrays import ArrayOptions, learn_array
from geoanalogy.poses.group_transfer import GroupObject, GroupTransfer
from geoanalogy.poses.local_mapping import TransferOptions
from geoanalogy.poses.scatter import ScatterModel, ScatterOptions

from ..library import ASSETS
from ..library.facades import PARTS
from ..plans.outlines import PlanPolygon
from .edit import AnyEdit, ArrayEdit, Edit, GroupEdit, Place, PlacementEdit, ScatterEdit


def scene_of(polygons: Sequence[PlanPolygon]) -> ga.Scene:
    """The plan as the engine's scene; parents are found by containment, as they are in a .blend."""
    return ga.Scene([ga.Polygon(p.ring, label=p.label, id=p.id) for p in polygons])


def record(scene: ga.Scene, edits: Sequence[AnyEdit]) -> ga.OperationsTree:
    """The tree of the edits, a chain of one node each: an example is learned among what those before it placed."""
    tree = ga.OperationsTree()
    for number, edit in enumerate(edits, start=1):
        last = tree.nodes[-1].id if tree.nodes else None
        seen = scene if last is None else tree.layout(scene, last).scene
        name = f"{number:02d} {getattr(edit, 'asset', getattr(edit, 'part', 'group'))}"
        links = () if last is None else (Link(last),)
        tree = tree.with_node(Node(name, _OPERATION[type(edit)](seen, edit), links))
    return tree


def _pose(place: Place) -> ga.Pose:
    return ga.Pose(place[:2], float(np.radians(place[2])))


def _learned(scene: ga.Scene, edit: Edit | ScatterEdit) -> ga.PoseModel:
    return ga.learn_pose(scene, _pose(edit.place), ASSETS[edit.asset].footprint, ga.PoseOptions(**edit.options))


def _single(scene: ga.Scene, edit: Edit) -> Operation:
    model = _learned(scene, edit)
    most = {} if edit.most is None else {model.parent.label: edit.most}
    label = ASSETS[edit.asset].label
    return PosePlacement(mesh=edit.asset, label=label, model=model, threshold=edit.threshold, max_per=most)


def _scatter(scene: ga.Scene, edit: ScatterEdit) -> Operation:
    model = ScatterModel(_learned(scene, edit), ScatterOptions(**edit.scatter))
    return ScatterPlacement(mesh=edit.asset, label=ASSETS[edit.asset].label, model=model, seed=edit.seed)


def _array(scene: ga.Scene, edit: ArrayEdit) -> Operation:
    asset = ASSETS[edit.asset]
    end = None if edit.end is None else _pose(edit.end)
    options = ga.PoseOptions(**edit.options)
    row = ArrayOptions(**edit.array)
    model = learn_array(scene, _pose(edit.place), end, edit.spacing, asset.footprint, options, row)
    return ArrayPlacement(mesh=edit.asset, label=asset.label, model=model, threshold=edit.threshold)


def _group(scene: ga.Scene, edit: GroupEdit) -> Operation:
    source = scene.parent_of(edit.items[0][1][:2])
    if source is None:
        raise ga.InputError(f"the group at {edit.items[0][1][:2]} lies in no polygon")
    names = tuple(asset for asset, _ in edit.items)
    objects = [GroupObject(_pose(place), ASSETS[asset].footprint) for asset, place in edit.items]
    group = GroupTransfer(source, objects, TransferOptions(**edit.transfer))
    return GroupPlacement(meshes=names, labels=tuple(ASSETS[name].label for name in names), group=group)


def _placement(scene: ga.Scene, edit: PlacementEdit) -> Operation:
    part = PARTS[edit.part]
    examples = []
    for facade, x0, y0, x1, y1 in edit.wanted:
        left, foot = scene.polygon(facade).bounds[:2]
        drawn = ga.Rectangle(left + (x0 + x1) / 2, foot + (y0 + y1) / 2, x1 - x0, y1 - y0)
        examples.append(ga.Example(scene, drawn))
    operation = RectanglePlacement.learned(
        examples,
        ga.PlacementOptions(**edit.options),
        fill=["repeat" in edit.fit] * len(examples),
        mesh=edit.part,
        label=part.label,
        size=part.size,
        fit=edit.fit,
        gap=edit.gap,
        threshold=edit.threshold,
    )
    return replace(operation, max_per={} if edit.most is None else {operation.model.label: edit.most})


_OPERATION = {
    Edit: _single,
    ArrayEdit: _array,
    ScatterEdit: _scatter,
    GroupEdit: _group,
    PlacementEdit: _placement,
}
