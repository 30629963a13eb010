"""Settings of operations without examples, as properties of their nodes: edited in the node editor and the sidebar."""

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from ...errors import InputError
from ...geometry.extrusion import FaceLabels
from ...geometry.roof import Roof
from ...operations.boolean import Boolean
from ...operations.extrusion import Extrusion
from ...operations.selection import Selection
from .. import names
from .plain import from_property
from .store import engine_node
from .writing_nodes import write_operation

#: The kinds of operations whose settings are edited here.
EDITED = {Extrusion.type, Boolean.type, Selection.type}

#: Called with the node after a setting has been edited; `links` puts itself here.
on_edited = []

#: What an extrusion has where nothing else is stored.
PLAIN = {**asdict(FaceLabels()), **asdict(Roof())}

#: Choices of settings: name in the tree, name in menus, explanation.
ROOFS = [
    ("flat", "Flat", "A flat cap"),
    ("hip", "Hip Roof", "A roof that slopes to all sides"),
    ("gable", "Gable Roof", "A roof with gables over the short sides"),
    ("mansard", "Mansard Roof", "A roof whose lower faces are steeper"),
]
#: Faces of an extruded solid, as the engine names them, and what they are.
FACES = {
    "side": "Label of the sides",
    "top": "Label of the flat cap",
    "bottom": "Label of what lies on the surface that is extruded from",
    "roof": "Label of the faces of the roof",
    "gable": "Label of the walls under the roof",
}

#: What measures of an extrusion are.
HEIGHT = "From the surface to the flat cap, or to the eaves of a roof"
PITCH = "How steep the roof is"
OVERHANG = "How far the roof reaches beyond the walls"

KINDS = [("merge", "Merge", "They become one solid"), ("subtract", "Subtract", "They are cut out")]
TARGETS = [
    ("surface", "Own Surface", "The solid that they stand on"),
    ("siblings", "Siblings", "The solids on the same surface that they intersect"),
]
WITHIN = [
    ("each", "Each by Itself", "Each draws its own set"),
    ("parent", "Within the Parent", "Those of one parent are divided so that the shares hold there"),
]


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


def edit_setting(node: bpy.types.Node, name: str, value: Any, part: str = "") -> None:
    """Change a setting of a node's operation. What it cannot be is told at the node, and changes nothing.

    Parameters
    ----------
    node : bpy.types.Node
    name : str
        Of the setting.
    value : object
        As the engine has it.
    part : str
        Which part of the setting is meant, where it has parts; "" for all of it.
    """
    try:
        before = engine_node(node)
        if part:
            value = replace(getattr(before.operation, name), **{part: value})
        if name == "height" and not value > 0.0:
            raise InputError(f"the height is {value:g}; give a positive one")
        write_operation(node, replace(before, operation=replace(before.operation, **{name: value})))
    except InputError as error:
        node[names.PROBLEM] = str(error)
        return
    node.pop(names.PROBLEM, None)
    for look in on_edited:
        look(node)


def weights_of(text: str) -> tuple[float, ...]:
    """The weights of a selection as they are typed.

    Parameters
    ----------
    text : str
        Numbers with commas between them.

    Returns
    -------
    tuple of float

    Raises
    ------
    InputError
        For anything else.
    """
    try:
        return tuple(float(part) for part in text.split(",") if part.strip())
    except ValueError:
        raise InputError(f"the weights {text!r} are no numbers; give one per set, with commas between them") from None


def _get(name: str, default: Any, group: str = "") -> Any:
    def get(self: bpy.types.Node) -> Any:
        settings = stored_settings(self)
        if group:
            settings = settings.get(group) if hasattr(settings.get(group), "items") else {}
        value = settings.get(name)
        return default if value is None else from_property(value)

    return get


def _set(name: str, group: str = "") -> Any:
    def change(self: bpy.types.Node, value: Any) -> None:
        if isinstance(value, float):
            value = round(value, 6)  # the interface has single precision
        if group:
            edit_setting(self, group, value, part=name)
        else:
            edit_setting(self, name, value)

    return change


def _enum(name: str, items: list[tuple[str, str, str]], group: str = "") -> Any:
    ids = [item[0] for item in items]
    read, write = _get(name, ids[0], group), _set(name, group)
    return {
        "items": items,
        "get": lambda self: ids.index(read(self)) if read(self) in ids else 0,
        "set": lambda self, value: write(self, ids[value]),
    }


def _weights(self: bpy.types.Node) -> str:
    return ", ".join(f"{weight:g}" for weight in _get("weights", [1.0])(self))


def _set_weights(self: bpy.types.Node, text: str) -> None:
    try:
        edit_setting(self, "weights", weights_of(text))
    except InputError as error:
        self[names.PROBLEM] = str(error)


def _set_factor(self: bpy.types.Node, value: tuple[float, float]) -> None:
    edit_setting(self, "factor", tuple(round(float(v), 6) for v in value))


class BuildingSettings:
    """The properties of nodes that extrude, combine or divide."""

    works_on: StringProperty(name="Label", description="Of what it works on", get=_get("label", ""), set=_set("label"))
    height: FloatProperty(
        name="Height", description=HEIGHT, subtype="DISTANCE", get=_get("height", 0.0), set=_set("height")
    )
    factor: FloatVectorProperty(
        name="Random Factor",
        description="Least and greatest multiplier of the height",
        size=2,
        get=_get("factor", [1.0, 1.0]),
        set=_set_factor,
    )
    inwards: BoolProperty(
        name="Inwards", description="Below the surface", get=_get("inwards", False), set=_set("inwards")
    )
    walls: FloatProperty(
        name="Walls",
        description="Thickness of a room's walls",
        subtype="DISTANCE",
        get=_get("walls", 0.0),
        set=_set("walls"),
    )
    roof: EnumProperty(name="Roof", **_enum("kind", ROOFS, "roof"))
    pitch: FloatProperty(
        name="Pitch",
        description=PITCH,
        subtype="ANGLE",
        get=_get("pitch", PLAIN["pitch"], "roof"),
        set=_set("pitch", "roof"),
    )
    overhang: FloatProperty(
        name="Overhang",
        description=OVERHANG,
        subtype="DISTANCE",
        get=_get("overhang", 0.0, "roof"),
        set=_set("overhang", "roof"),
    )
    side: StringProperty(
        name="Sides", description=FACES["side"], get=_get("side", PLAIN["side"], "faces"), set=_set("side", "faces")
    )
    top: StringProperty(
        name="Top", description=FACES["top"], get=_get("top", PLAIN["top"], "faces"), set=_set("top", "faces")
    )
    bottom: StringProperty(
        name="Bottom",
        description=FACES["bottom"],
        get=_get("bottom", PLAIN["bottom"], "faces"),
        set=_set("bottom", "faces"),
    )
    roof_label: StringProperty(
        name="Roof Faces",
        description=FACES["roof"],
        get=_get("roof", PLAIN["roof"], "faces"),
        set=_set("roof", "faces"),
    )
    gable: StringProperty(
        name="Gables",
        description=FACES["gable"],
        get=_get("gable", PLAIN["gable"], "faces"),
        set=_set("gable", "faces"),
    )
    combination: EnumProperty(name="Kind", **_enum("kind", KINDS))
    target: EnumProperty(name="With", **_enum("target", TARGETS))
    weights: StringProperty(
        name="Weights", description="One number per set, with commas between them", get=_weights, set=_set_weights
    )
    within: EnumProperty(name="Divide", **_enum("within", WITHIN))
    division: IntProperty(name="Seed", description="For another division", get=_get("seed", 0), set=_set("seed"))

    def draw_settings(self, layout: bpy.types.UILayout, kind: str) -> None:
        """Draw the main settings of an operation of a kind."""
        shown = {
            Extrusion.type: ("works_on", "height", "factor", "inwards", "roof"),
            Boolean.type: ("works_on", "combination", "target"),
            Selection.type: ("works_on", "weights", "within"),
        }.get(kind, ())
        column = layout.column(align=True)
        for name in shown:
            column.prop(self, name)
        if kind == Extrusion.type and self.roof != "flat":
            column.prop(self, "pitch")

    def draw_faces(self, layout: bpy.types.UILayout, kind: str) -> None:
        """Draw the settings that are seldom changed."""
        shown = {
            Extrusion.type: ("walls", "overhang", "side", "top", "bottom", "roof_label", "gable"),
            Selection.type: ("division",),
        }.get(kind, ())
        column = layout.column(align=True)
        for name in shown:
            column.prop(self, name)
