"""Step 4: sifting the results."""

import bpy

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.explanation import explanation_of
from ..geoanalogy.blender.tree.learned import novelty_of, placed_on, rule_of, unfamiliar_of
from ..geoanalogy.blender.tree.store import drawing_nodes, is_building, operation_nodes, tree_of
from .base import SidebarPanel, hint, share, sifting

#: Relations and faces that are listed.
MOST_LISTED = 4


class GEOANALOGY_PT_results(SidebarPanel, bpy.types.Panel):
    """Move the threshold, accept and reject results."""

    bl_idname = "GEOANALOGY_PT_results"
    bl_label = "4  Results"
    bl_order = 4

    def draw(self, context):
        layout = self.layout
        tree = tree_of(context.scene)
        node = tree.nodes.active if tree is not None else None
        if node is not None and node in drawing_nodes(tree):
            hint(layout, f"{node.name} was found in a drawing; its results are under Drawings")
            return
        if node is None or node not in operation_nodes(tree):
            hint(layout, "Nothing propagated yet")
            return
        sifting(layout, node, "changed" if is_building(node) else "placed")
        self._draw_learned(context, layout, node)
        self._draw_reasons(context, layout)

    def _draw_learned(self, context, layout, node):
        if names.RULE not in node:
            return
        rule = rule_of(node)
        box = layout.box()
        box.label(text="Learned", icon="INFO")
        for relation in rule[:MOST_LISTED]:
            share(box, relation.text, relation.share)
        if not rule:
            hint(box, "The examples differ in all that can be told; add one like another", "NONE")
        layout.operator("geoanalogy.select_examples", icon="RESTRICT_SELECT_OFF")
        self._draw_unfamiliar(context.scene.geoanalogy, layout.box(), node)
        novelty = novelty_of(context.active_object, node)
        if novelty is not None:
            hint(layout, f"Novelty of {context.active_object.name}: {novelty:.2f}")

    def _draw_unfamiliar(self, settings, box, node):
        faces = unfamiliar_of(node)
        head = box.row()
        if not faces:
            head.operator("geoanalogy.list_unfamiliar")
            if names.UNFAMILIAR in node:
                hint(box, "No face is unlike the examples", "CHECKMARK")
            return
        head.label(text="Unlike the examples", icon="QUESTION")
        head.prop(settings, "show_unfamiliar", text="", icon="OVERLAY")
        counts = placed_on(node)
        # The one that was clicked stays in the middle of those that are listed.
        first = max(0, min(settings.unfamiliar_index - MOST_LISTED // 2, len(faces) - MOST_LISTED))
        for i, face in list(enumerate(faces))[first : first + MOST_LISTED]:
            row = box.row(align=True)
            clicked = i == settings.unfamiliar_index
            row.operator("geoanalogy.show_face", text="", icon="VIEWZOOM", depress=clicked).index = i
            row.progress(factor=face.novelty, type="BAR", text=f"{face.name}: {counts.get(face.name, 'none')} placed")
        if len(faces) > MOST_LISTED:
            row = box.row(align=True)
            row.label(text=f"{len(faces)} in all")
            at = settings.unfamiliar_index
            row.operator("geoanalogy.show_face", text="", icon="TRIA_LEFT").index = (max(at, 0) - 1) % len(faces)
            row.operator("geoanalogy.show_face", text="", icon="TRIA_RIGHT").index = (at + 1) % len(faces)
        hint(box, "One more example there teaches most", "NONE")

    def _draw_reasons(self, context, layout):
        item = context.active_object
        if item is None or names.KEY not in item:
            return
        box = layout.box()
        box.operator("geoanalogy.explain", icon="QUESTION")
        for reason in explanation_of(context.scene, item) or ():
            share(box, reason.text, reason.share)


def register():
    """Register the panel."""
    bpy.utils.register_class(GEOANALOGY_PT_results)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_PT_results)
