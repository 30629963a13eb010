"""The finishes of the palette as Blender materials."""

from __future__ import annotations

import bpy

from .palette import PALETTE, Finish


def linear(colour: str) -> tuple[float, float, float, float]:
    """Hexadecimal sRGB as scene-linear RGBA."""
    channels = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    r, g, b = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels)
    return (r, g, b, 1.0)


def material(name: str) -> bpy.types.Material:
    """The material of a finish, made at its first use in this file."""
    existing = bpy.data.materials.get(name)
    return existing if existing is not None else _make(name, PALETTE[name])


def _make(name: str, finish: Finish) -> bpy.types.Material:
    made = bpy.data.materials.new(name)
    if made.node_tree is None:  # Blender before 5.0
        made.use_nodes = True
    made.diffuse_color = linear(finish.colour)
    made.roughness = finish.roughness
    made.metallic = finish.metallic
    shader = next(node for node in made.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    inputs = shader.inputs
    inputs["Base Color"].default_value = linear(finish.colour)
    inputs["Roughness"].default_value = finish.roughness
    inputs["Metallic"].default_value = finish.metallic
    inputs["Transmission Weight"].default_value = finish.transmission
    inputs["Coat Weight"].default_value = finish.coat
    inputs["Sheen Weight"].default_value = finish.sheen
    inputs["Emission Color"].default_value = linear(finish.colour)
    inputs["Emission Strength"].default_value = finish.glow
    if finish.pattern:
        _PATTERNS[finish.pattern](made.node_tree, shader, finish)
    return made


def _colours(tree: bpy.types.NodeTree, shader, finish: Finish, factor) -> None:
    """Mix the two colours of a finish by a factor socket."""
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].color = linear(finish.colour)
    ramp.color_ramp.elements[1].color = linear(finish.second)
    ramp.color_ramp.elements[0].position = 0.3
    ramp.color_ramp.elements[1].position = 0.7
    tree.links.new(factor, ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], shader.inputs["Base Color"])


def _coordinates(tree: bpy.types.NodeTree, stretch: tuple[float, float, float], turn: float = 0.0):
    coordinates = tree.nodes.new("ShaderNodeTexCoord")
    mapping = tree.nodes.new("ShaderNodeMapping")
    mapping.inputs["Scale"].default_value = stretch
    mapping.inputs["Rotation"].default_value = (0.0, 0.0, turn)
    tree.links.new(coordinates.outputs["Object"], mapping.inputs["Vector"])
    return mapping.outputs["Vector"]


def _noise(tree: bpy.types.NodeTree, vector, scale: float):
    noise = tree.nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = scale
    noise.inputs["Detail"].default_value = 3.0
    tree.links.new(vector, noise.inputs["Vector"])
    return noise.outputs[0]


def _mottled(tree: bpy.types.NodeTree, shader, finish: Finish) -> None:
    _colours(tree, shader, finish, _noise(tree, _coordinates(tree, (1.0, 1.0, 1.0)), 1.0 / finish.scale))


def _grain(tree: bpy.types.NodeTree, shader, finish: Finish) -> None:
    # Wood is stretched along y, the long side of most furniture against a wall.
    _colours(tree, shader, finish, _noise(tree, _coordinates(tree, (1.0, 0.08, 1.0)), 1.0 / finish.scale))


def _lawn(tree: bpy.types.NodeTree, shader, finish: Finish) -> None:
    fine = tree.nodes.new("ShaderNodeMath")
    fine.operation = "MULTIPLY_ADD"
    fine.inputs[1].default_value = 0.5
    vector = _coordinates(tree, (1.0, 1.0, 1.0))
    tree.links.new(_noise(tree, vector, 8.0), fine.inputs[0])
    half = tree.nodes.new("ShaderNodeMath")
    half.operation = "MULTIPLY"
    half.inputs[1].default_value = 0.5
    tree.links.new(_noise(tree, vector, 1.0 / finish.scale), half.inputs[0])
    tree.links.new(half.outputs[0], fine.inputs[2])
    _colours(tree, shader, finish, fine.outputs[0])


def _foliage(tree: bpy.types.NodeTree, shader, finish: Finish) -> None:
    # Every instance has a tint of its own, and every leaf varies a little about it.
    instance = tree.nodes.new("ShaderNodeObjectInfo")
    mean = tree.nodes.new("ShaderNodeMath")
    mean.operation = "MULTIPLY_ADD"
    mean.inputs[1].default_value = 0.45
    tree.links.new(instance.outputs["Random"], mean.inputs[0])
    share = tree.nodes.new("ShaderNodeMath")
    share.operation = "MULTIPLY"
    share.inputs[1].default_value = 0.6
    tree.links.new(_noise(tree, _coordinates(tree, (1.0, 1.0, 1.0)), 6.0), share.inputs[0])
    tree.links.new(share.outputs[0], mean.inputs[2])
    _colours(tree, shader, finish, mean.outputs[0])


def _bricks(
    tree: bpy.types.NodeTree, shader, finish: Finish, length: float, height: float, offset: float, turn: float = 0.0
) -> None:
    bricks = tree.nodes.new("ShaderNodeTexBrick")
    bricks.offset = offset
    bricks.inputs["Scale"].default_value = 1.0
    bricks.inputs["Brick Width"].default_value = length
    bricks.inputs["Row Height"].default_value = height
    bricks.inputs["Mortar Size"].default_value = 0.006 if height > 0.18 else 0.003
    bricks.inputs["Mortar Smooth"].default_value = 0.3
    first, second = linear(finish.colour), linear(finish.second)
    bricks.inputs["Color1"].default_value = first
    bricks.inputs["Color2"].default_value = (
        second if offset else tuple(0.8 * a + 0.2 * b for a, b in zip(first, second, strict=True))
    )
    bricks.inputs["Mortar"].default_value = (*(0.55 * c for c in second[:3]), 1.0) if offset else second
    tree.links.new(_coordinates(tree, (1.0, 1.0, 1.0), turn), bricks.inputs["Vector"])
    tree.links.new(bricks.outputs["Color"], shader.inputs["Base Color"])


def _parquet(tree: bpy.types.NodeTree, shader, finish: Finish) -> None:
    _bricks(tree, shader, finish, 8 * finish.scale, finish.scale, 0.37)


def _tiles(tree: bpy.types.NodeTree, shader, finish: Finish) -> None:
    _bricks(tree, shader, finish, finish.scale, finish.scale, 0.0)


def _courses(tree: bpy.types.NodeTree, shader, finish: Finish) -> None:
    _bricks(tree, shader, finish, 2 * finish.scale, finish.scale, 0.5)


def _weave(tree: bpy.types.NodeTree, shader, finish: Finish) -> None:
    checks = tree.nodes.new("ShaderNodeTexChecker")
    checks.inputs["Scale"].default_value = 1.0 / finish.scale
    checks.inputs["Color1"].default_value = linear(finish.colour)
    checks.inputs["Color2"].default_value = linear(finish.second)
    tree.links.new(_coordinates(tree, (1.0, 1.0, 1.0)), checks.inputs["Vector"])
    tree.links.new(checks.outputs["Color"], shader.inputs["Base Color"])


_PATTERNS = {
    "mottled": _mottled,
    "grain": _grain,
    "lawn": _lawn,
    "foliage": _foliage,
    "parquet": _parquet,
    "tiles": _tiles,
    "courses": _courses,
    "weave": _weave,
}
