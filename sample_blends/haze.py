"""Distance in pictures of cities: a sky that is bright at the horizon, and haze of its colour; needs Blender."""

from __future__ import annotations

import bpy

#: Sky from the horizon up, scene-linear, and its strength; sine of the angle above the horizon where it is bluest.
HORIZON, ZENITH, STRENGTH, BLUEST = (0.60, 0.79, 1.0), (0.16, 0.38, 0.85), 0.75, 0.25

#: Strength of the sun, W/m².
SUN = 3.6


def light(scene: bpy.types.Scene) -> None:
    """A sky that is bright at the horizon, and a strong sun."""
    tree = scene.world.node_tree
    background = next(node for node in tree.nodes if node.type == "BACKGROUND")
    background.inputs["Strength"].default_value = STRENGTH
    coordinates, split = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeSeparateXYZ")
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    for element, colour, position in zip(ramp.color_ramp.elements, (HORIZON, ZENITH), (0.0, BLUEST), strict=True):
        element.color, element.position = (*colour, 1.0), position
    tree.links.new(coordinates.outputs["Generated"], split.inputs["Vector"])
    tree.links.new(split.outputs["Z"], ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], background.inputs["Color"])
    for lamp in (o.data for o in scene.objects if o.type == "LIGHT"):
        lamp.energy = SUN


class Haze:
    """Lets all materials of the open file fade into the colour of the horizon with the square of the distance."""

    def __init__(self) -> None:
        nodes = (_veil(material) for material in bpy.data.materials)
        self._nodes = [node for node in nodes if node is not None]

    def reach(self, visibility: float) -> None:
        """Set the distance at which the haze takes 63 % of what is seen, metres."""
        for node in self._nodes:
            node.inputs[1].default_value = visibility


def _veil(material: bpy.types.Material) -> bpy.types.Node | None:
    """The node that divides distances by the visibility; None for a material without a surface."""
    tree = material.node_tree
    output = next((node for node in tree.nodes if node.type == "OUTPUT_MATERIAL"), None) if tree else None
    if output is None or not output.inputs["Surface"].is_linked:
        return None
    surface = output.inputs["Surface"].links[0].from_socket
    value, nodes = tree.nodes.new("ShaderNodeCameraData").outputs["View Distance"], []
    for operation, amount in (("DIVIDE", 1.0), ("POWER", 2.0), ("MULTIPLY", -1.0), ("EXPONENT", None)):
        node = tree.nodes.new("ShaderNodeMath")
        node.operation = operation
        tree.links.new(value, node.inputs[0])
        if amount is not None:
            node.inputs[1].default_value = amount
        value = node.outputs[0]
        nodes.append(node)
    haze, mix = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeMixShader")
    haze.inputs["Color"].default_value, haze.inputs["Strength"].default_value = (*HORIZON, 1.0), STRENGTH
    tree.links.new(value, mix.inputs[0])
    tree.links.new(haze.outputs[0], mix.inputs[1])
    tree.links.new(surface, mix.inputs[2])
    tree.links.new(mix.outputs[0], output.inputs["Surface"])
    return nodes[0]
