"""What GeoAnalogy keeps with each scene of a file."""

import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import names
from .regions.settings import GEOANALOGY_PG_matching


def _is_operations_tree(self, tree):
    return tree.bl_idname == names.TREE


class GEOANALOGY_PG_scene(bpy.types.PropertyGroup):
    """A scene's plan and its operations."""

    plan: PointerProperty(
        name="Plan",
        type=bpy.types.Collection,
        description="Everything in this collection is part of the plan; collections inside it name what they hold",
    )
    tree: PointerProperty(
        name="Operations",
        type=bpy.types.NodeTree,
        poll=_is_operations_tree,
        description="The operations tree of this scene",
    )
    element: PointerProperty(
        name="Object",
        type=bpy.types.Object,
        description="What fills the places like the examples; none: the first example itself",
    )
    drawing: PointerProperty(
        name="Drawing",
        type=bpy.types.Collection,
        description="The strokes, curves and meshes of this collection are the drawing; none: all strokes and curves",
    )
    smoothing: FloatProperty(
        name="Smooth",
        description="For noisy lines: how far along them they are smoothed before they are matched; they stay as drawn",
        min=0.0,
        soft_max=1.0,
        subtype="DISTANCE",
    )
    matching: PointerProperty(name="Matching", type=GEOANALOGY_PG_matching)
    query: PointerProperty(
        name="Query",
        type=bpy.types.Object,
        description="The line round the region, or along the thin shape, that is looked for",
    )
    image: PointerProperty(
        name="Image", type=bpy.types.Image, description="Painted for the query, with alpha; it fills the box round it"
    )
    brush: IntProperty(name="Brush", description="Radius in pixels", min=2, max=500, default=20, subtype="PIXEL")
    rectangle_label: StringProperty(
        name="Label", default="example", description="What the rectangles are that are drawn as examples"
    )
    show_unfamiliar: BoolProperty(
        name="Show", default=True, description="Outline the faces in the 3D view that are unlike the examples"
    )
    unfamiliar_index: IntProperty(name="Face", default=-1, description="Which of these faces was clicked")


def register():
    """Give every scene its properties."""
    bpy.utils.register_class(GEOANALOGY_PG_scene)
    bpy.types.Scene.geoanalogy = PointerProperty(type=GEOANALOGY_PG_scene)


def unregister():
    """Take them back."""
    del bpy.types.Scene.geoanalogy
    bpy.utils.unregister_class(GEOANALOGY_PG_scene)
