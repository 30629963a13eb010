"""How regions are matched, as properties: kept with the scene, and shown in the redo panel of the operator."""

import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty

from ...regions.options import RegionOptions

_PLAIN = RegionOptions()

#: An operator takes what the scene has, not what it was last called with.
_OF_THE_SCENE = {"SKIP_SAVE"}


class MatchingSettings:
    """Properties that become `RegionOptions`."""

    mirrored: BoolProperty(
        name="Mirrored",
        description="Whether mirror images count as well",
        default=_PLAIN.mirrored,
        options=_OF_THE_SCENE,
    )
    branches: BoolProperty(
        name="Branches",
        description="Several regions may share lines, as twigs share a trunk",
        default=_PLAIN.branches,
        options=_OF_THE_SCENE,
    )
    joint_tolerance: FloatProperty(
        name="Joints",
        description="0: shapes that bend smoothly; towards 1: limbs that turn at a joint",
        min=0.0,
        max=1.0,
        default=_PLAIN.joint_tolerance,
        options=_OF_THE_SCENE,
        subtype="FACTOR",
    )
    largest_scale: FloatProperty(
        name="Largest Scale",
        description="How many times larger, or smaller, than the query a region may be",
        min=1.0,
        max=100.0,
        default=_PLAIN.largest_scale,
        options=_OF_THE_SCENE,
    )
    query_points: IntProperty(
        name="Query Points",
        description="How densely the region is sampled: more for thin parts",
        min=8,
        max=400,
        default=_PLAIN.query_points,
        options=_OF_THE_SCENE,
    )
    reach: FloatProperty(
        name="Reach",
        description="Lines this near to a stroke belong to it, as a share of its length",
        min=0.001,
        max=1.0,
        default=_PLAIN.reach,
        options=_OF_THE_SCENE,
    )
    smoothing_radius: FloatProperty(
        name="Evidence",
        description="How far the evidence of single points reaches, as a share of the query's extent",
        min=0.01,
        max=1.0,
        default=_PLAIN.smoothing_radius,
        options=_OF_THE_SCENE,
    )
    neighbourhood: FloatProperty(
        name="Neighbourhood",
        description="How far shapes must deform alike, in distances between query points: more bridges what is hidden",
        min=0.5,
        max=10.0,
        default=_PLAIN.neighbourhood,
        options=_OF_THE_SCENE,
    )
    contrast: FloatProperty(
        name="Contrast",
        description="How far a region must stand out, as a share of how far the best does: the others are clutter",
        min=0.0,
        max=1.0,
        default=_PLAIN.contrast,
        subtype="FACTOR",
        options=_OF_THE_SCENE,
    )
    most: IntProperty(
        name="At Most",
        description="How many regions are kept",
        min=1,
        max=1000,
        default=_PLAIN.most,
        options=_OF_THE_SCENE,
    )


#: Their names, in the order in which they are shown.
SETTINGS = tuple(MatchingSettings.__annotations__)


def options_of(settings: MatchingSettings) -> RegionOptions:
    """The options as the engine takes them.

    Parameters
    ----------
    settings : MatchingSettings
        Of a scene or an operator.

    Returns
    -------
    RegionOptions
    """
    values = {name: getattr(settings, name) for name in SETTINGS}
    # A float of Blender's interface has single precision: 0.1 is meant, not 0.1000000015.
    return RegionOptions(**{k: round(v, 6) if isinstance(v, float) else v for k, v in values.items()})


class GEOANALOGY_PG_matching(MatchingSettings, bpy.types.PropertyGroup):
    """How the next query of a scene is matched."""


def register():
    """Register the settings of a scene."""
    bpy.utils.register_class(GEOANALOGY_PG_matching)


def unregister():
    """Unregister them."""
    bpy.utils.unregister_class(GEOANALOGY_PG_matching)
