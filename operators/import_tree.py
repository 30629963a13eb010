"""Read an operations tree from a file."""

import bpy
from bpy.props import BoolProperty, StringProperty

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.editing import chosen_outputs
from ..geoanalogy.blender.tree.evaluating import mark_stale
from ..geoanalogy.blender.tree.files import graft_tree, import_tree
from ..geoanalogy.blender.tree.store import ordered_nodes, require_operations
from .edit import FileImport, chosen_file, needs_object_mode


class GEOANALOGY_OT_import_tree(FileImport, bpy.types.Operator):
    """Read an operations tree from a JSON file, to apply it here or to let it grow onto the tree that is there"""

    bl_idname = "geoanalogy.import_tree"
    bl_label = "Import Operations"

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    grow: BoolProperty(
        name="Grow Onto the Tree",
        description="Its first operations build on the chosen leaf; else it becomes the tree of the scene",
        options={"SKIP_SAVE"},
    )
    prefix: StringProperty(name="Prefix", description="Put before the names of its operations", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def edit(self, context):
        """Read it; nothing is evaluated."""
        path = chosen_file(self.filepath)
        if not self.grow:
            tree = import_tree(context.scene, path)
            return f"{counted(len(tree.nodes), 'operation')} read from {path.name}; press Apply"
        tree = require_operations(context.scene)
        count = graft_tree(tree, path, chosen_outputs(tree, ordered_nodes(tree)), self.prefix)
        mark_stale(tree, tree.nodes[0])
        return f"{counted(count, 'operation')} read from {path.name} and grown onto {tree.name}; press Apply"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_import_tree)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_import_tree)
