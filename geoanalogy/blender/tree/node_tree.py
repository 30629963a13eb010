"""The operations tree as a node tree of Blender: saved, undone, copied, appended and shown without code of ours.

The nodes carry their operation as nested custom properties (see `store`), which survive in a Blender without this
add-on; what is registered here only shows them.
"""

import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty

from .. import names
from ..jobs import stop_jobs
from .node_settings import EDITED, BuildingSettings, stored_settings
from .plain import to_property

#: What the kinds of operations are drawn with.
ICONS = {
    "pose placement": "OUTLINER_OB_GROUP_INSTANCE",
    "array": "MOD_ARRAY",
    "local coordinates": "MOD_LATTICE",
    "scatter": "STICKY_UVS_DISABLE",
    "choice": "RNDCURVE",
    "placement": "SELECT_SET",
    "extrusion": "MOD_SOLIDIFY",
    "boolean": "MOD_BOOLEAN",
    "selection": "UV_SYNC_SELECT",
    "region transfer": "BRUSH_DATA",
}

#: Called after a setting that only sifts results has been changed; `showing` puts itself here.
on_sifted = []

#: Called with the tree when its masses are to be shown in another way; `showing` puts itself here.
on_merged = []

#: Called after links of a tree have been changed; `links` puts itself here.
on_linked = []


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
        update=lambda self, context: [show(self) for show in on_merged],
    )

    def _active(self):
        active = self.nodes.active
        return -1 if active is None else self.nodes.find(active.name)

    def _activate(self, index):
        if 0 <= index < len(self.nodes):
            self.nodes.active = self.nodes[index]

    active_index: IntProperty(
        name="Active Operation",
        description="What the panels show, and what the next operation builds on",
        get=_active,
        set=_activate,
        options={"SKIP_SAVE"},
    )

    def update(self):
        for look in on_linked:
            look(self)


class GEOANALOGY_NS_layout(bpy.types.NodeSocket):
    """What an operation gets and what it leaves behind."""

    bl_idname = names.LAYOUT_SOCKET
    bl_label = "Layout"

    def draw(self, context, layout, node, text):
        layout.label(text=text)

    @classmethod
    def draw_color_simple(cls):
        return (0.36, 0.69, 0.54, 1.0)


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


class GEOANALOGY_ND_operation(BuildingSettings, bpy.types.Node):
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

    def free(self):
        stop_jobs("an operation was removed while the tree was being worked on; nothing else has changed, start again")

    def draw_label(self):
        return self.label or self.name

    def draw_buttons(self, context, layout):
        operation = self.get(names.OPERATION)
        if not hasattr(operation, "items"):
            layout.label(text="No operation", icon="ERROR")
            return
        settings = stored_settings(self)
        kind = str(operation.get("type", ""))
        row = layout.row()
        row.label(text=kind.capitalize(), icon=ICONS.get(kind, "NODE"))
        if self.get(names.STALE):
            row.label(text="", icon="FILE_REFRESH")
        label, mesh = settings.get("label"), settings.get("mesh")
        if mesh:
            layout.label(text=f"{mesh} as {label}" if label else str(mesh), icon="OBJECT_DATA")
        self.draw_settings(layout, kind)
        if "threshold" in settings:
            layout.prop(self, "threshold", slider=True)
        row = layout.row()
        row.active = False
        row.label(text=f"{int(self.get(names.COUNT, 0))} {'changed' if kind in EDITED else 'placed'}")
        row.label(text=f"{1000 * float(self.get(names.SECONDS, 0.0)):.1f} ms", icon="TIME")
        problem = self.get(names.PROBLEM)
        if problem:
            layout.label(text=str(problem), icon="ERROR")

    def draw_buttons_ext(self, context, layout):
        layout.use_property_split = True
        self.draw_buttons(context, layout)
        self.draw_faces(layout, str(self[names.OPERATION].get("type", "")) if names.OPERATION in self else "")


CLASSES = (GEOANALOGY_NT_tree, GEOANALOGY_NS_layout, GEOANALOGY_ND_operation)


def register():
    """Register the types; nodes of files that are open already find their type again."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    """Unregister the types; their nodes keep all they carry."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
