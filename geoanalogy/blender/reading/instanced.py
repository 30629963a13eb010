"""Plans inside collection instances: what stands there are no objects of the scene, and nobody can label them."""

import bpy

from .. import names


def why_nothing_is_drawn(scene: bpy.types.Scene) -> str:
    """What to tell of a scene without a plan, and the remedy.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    str
        A sentence, which names the collection instance that the plan is in, where there is one.
    """
    instance = next((item for item in scene.objects if _holds_plan(item)), None)
    if instance is None:
        return (
            "the scene has no labelled outlines; label the plan's meshes, curves or strokes in step 1, or import a plan"
        )
    return (
        f"the plan is inside the collection instance {instance.name!r}, where nothing is read; make it real by "
        "Object › Apply › Make Instances Real"
    )


def _holds_plan(item: bpy.types.Object) -> bool:
    inside = item.instance_collection if item.instance_type == "COLLECTION" else None
    return inside is not None and any(names.LABEL in other for other in inside.all_objects)
