"""The operations tree as a node tree of Blender: saved, undone, copied, appended and shown without code of ours.

The nodes carry their operation as nested custom properties (see `tree_store`), which survive in a Blender without this
add-on; what is registered here only shows them.
"""

from collections.abc import Mapping

import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty

from . import names
from .plain import to_property

#: Called after a setting that only sifts results has been changed; `refresh` puts itself here.
on_sifted = []


class GEOANALOGY_NT_tree(bpy.types.NodeTree):
    """Operations, and from which to which results flow."""

    bl_idname = names.TREE
    bl_label = "Operations Tree"
    bl_description = "Edits made by analogy, in the order in which they build on each other"
    bl_icon = "OUTLINER"

    seed: IntProperty(name="Seed", description="Seed of the operations that draw lots", default=0, min=0)
    merged: BoolProperty(
        name="Merge Masses",
        description="One mesh per label instead of one object per solid: for many, which are not corrected one by one",
    )

    def _active(self):
        active = self.nodes.active
        return -1 if active is None else self.nodes.find(active.name)

    def _activate(self, index):
        if 0 <= index < len(self.nodes):
            self.nodes.active = self.nodes[index]

    active_index: IntProperty(name="Active Operation", get=_active, set=_activate, options={"SKIP_SAVE"})


class GEOANALOGY_NS_layout(bpy.types.NodeSocket):
    """What an operation gets and what it leaves behind."""

    bl_idname = names.LAYOUT_SOCKET
    bl_label = "Layout"

    def draw(self, context, layout, node, text):
        layout.label(text=text)

    @classmethod
    def draw_color_simple(cls):
        return (0.36, 0.69, 0.54, 1.0)


def stored_settings(node: bpy.types.Node) -> Mapping[str, object]:
    """The settings of a node's operation as they are stored.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    mapping
        Empty where the node carries no operation.
    """
    operation = node.get(names.OPERATION)
    settings = operation.get("settings") if hasattr(operation, "items") else None
    return settings if hasattr(settings, "items") else {}


def change_setting(node: bpy.types.Node, name: str, value: object) -> None:
    """Change one setting of a node's operation that only sifts its results, and show what passes.

    Parameters
    ----------
    node : bpy.types.Node
    name : str
    value : object
        Plain data.
    """
    settings = stored_settings(node)
    if name in settings:
        settings[name] = to_property(value)
        for show in on_sifted:
            show(node)


class GEOANALOGY_ND_operation(bpy.types.Node):
    """An operation."""

    bl_idname = names.OPERATION_NODE
    bl_label = "Operation"
    bl_width_default = 220.0

    def _threshold(self):
        return float(stored_settings(self).get("threshold", 0.0))

    def _change_threshold(self, value):
        if value != self.threshold:
            # A float of Blender's interface has single precision: 0.4 is meant, not 0.4000000059.
            change_setting(self, "threshold", round(value, 6))

    threshold: FloatProperty(
        name="Threshold",
        description="Results of less importance are not placed; nothing is computed again",
        min=0.0,
        max=1.0,
        subtype="FACTOR",
        get=_threshold,
        set=_change_threshold,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, tree):
        return tree.bl_idname == names.TREE

    def init(self, context):
        self.inputs.new(names.LAYOUT_SOCKET, "Layout", use_multi_input=True)
        self.outputs.new(names.LAYOUT_SOCKET, "Layout")

    def draw_label(self):
        return self.label or self.name

    def draw_buttons(self, context, layout):
        operation = self.get(names.OPERATION)
        if not hasattr(operation, "items"):
            layout.label(text="No operation", icon="ERROR")
            return
        settings = stored_settings(self)
        layout.label(text=str(operation.get("type", "")).capitalize(), icon="NODE")
        label, mesh = settings.get("label"), settings.get("mesh")
        if mesh:
            layout.label(text=f"{mesh} as {label}" if label else str(mesh), icon="OBJECT_DATA")
        row = layout.row()
        row.label(text=f"{int(self.get(names.COUNT, 0))} placed")
        row.label(text=f"{float(self.get(names.SECONDS, 0.0)):.2f} s")
        if "threshold" in settings:
            layout.prop(self, "threshold", slider=True)


CLASSES = (GEOANALOGY_NT_tree, GEOANALOGY_NS_layout, GEOANALOGY_ND_operation)


def register():
    """Register the types; nodes of files that are open already find their type again."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    """Unregister the types; their nodes keep all they carry."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
