"""Materials by their names: what an operations tree calls them says what they look like, until somebody shades them."""

import zlib

import bpy

Colour = tuple[float, float, float]

#: Scene-linear colour and roughness by the last word of a name that is found here.
FINISHES: dict[str, tuple[Colour, float]] = {
    "wall": ((0.72, 0.63, 0.50), 0.9),
    "facade": ((0.72, 0.63, 0.50), 0.9),
    "gable": ((0.72, 0.63, 0.50), 0.9),
    "reveal": ((0.78, 0.75, 0.68), 0.9),
    "base": ((0.22, 0.20, 0.19), 0.9),
    "cornice": ((0.80, 0.76, 0.68), 0.8),
    "canopy": ((0.30, 0.31, 0.33), 0.6),
    "balcony": ((0.62, 0.60, 0.57), 0.8),
    "sill": ((0.72, 0.70, 0.66), 0.7),
    "roof": ((0.26, 0.075, 0.045), 0.8),
    "terrace": ((0.36, 0.34, 0.32), 0.9),
    "glass": ((0.06, 0.11, 0.16), 0.1),
    "window": ((0.80, 0.79, 0.76), 0.6),
    "upright": ((0.80, 0.79, 0.76), 0.6),
    "crossbar": ((0.80, 0.79, 0.76), 0.6),
    "shutter": ((0.07, 0.16, 0.12), 0.7),
    "panel": ((0.22, 0.12, 0.06), 0.7),
    "panelling": ((0.22, 0.12, 0.06), 0.7),
    "door": ((0.17, 0.07, 0.03), 0.6),
    "gate": ((0.34, 0.35, 0.37), 0.6),
    "shed": ((0.28, 0.17, 0.09), 0.9),
    "hedge": ((0.045, 0.13, 0.03), 1.0),
    "tree": ((0.045, 0.13, 0.03), 1.0),
    "parcel": ((0.16, 0.26, 0.08), 1.0),
    "garden": ((0.15, 0.25, 0.07), 1.0),
    "lawn": ((0.17, 0.29, 0.08), 1.0),
    "park": ((0.12, 0.23, 0.06), 1.0),
    "verge": ((0.14, 0.24, 0.07), 1.0),
    "street": ((0.085, 0.085, 0.09), 0.9),
    "road": ((0.085, 0.085, 0.09), 0.9),
    "marking": ((0.55, 0.55, 0.52), 0.8),
    "pavement": ((0.36, 0.35, 0.33), 0.9),
    "square": ((0.42, 0.39, 0.35), 0.9),
    "yard": ((0.34, 0.31, 0.27), 0.9),
    "water": ((0.05, 0.10, 0.13), 0.1),
    "pond": ((0.05, 0.10, 0.13), 0.1),
    "ground": ((0.20, 0.195, 0.19), 1.0),
    "path": ((0.48, 0.44, 0.39), 0.9),
    "walk": ((0.48, 0.44, 0.39), 0.9),
    "parking": ((0.16, 0.16, 0.17), 0.9),
    "drive": ((0.16, 0.16, 0.17), 0.9),
}

#: Attribute of faces, from 0 to 1, by which the buildings of a street differ: the same on all of one parcel.
VARIATION = "ga_variation"

#: Scene-linear colours among which buildings differ, by the last word of a name.
PALETTES: dict[str, tuple[Colour, ...]] = {
    "wall": (
        (0.72, 0.63, 0.50),
        (0.80, 0.77, 0.70),
        (0.62, 0.42, 0.27),
        (0.66, 0.58, 0.38),
        (0.55, 0.60, 0.62),
        (0.45, 0.17, 0.11),
        (0.78, 0.68, 0.58),
        (0.57, 0.61, 0.50),
    ),
    "roof": (
        (0.26, 0.075, 0.045),
        (0.11, 0.10, 0.105),
        (0.20, 0.065, 0.045),
        (0.17, 0.12, 0.09),
        (0.31, 0.11, 0.06),
    ),
    "hedge": ((0.045, 0.13, 0.03), (0.07, 0.15, 0.035), (0.035, 0.10, 0.03)),
}
PALETTES["gable"] = PALETTES["facade"] = PALETTES["wall"]

#: The lightness range that the names without a word of the table are spread over.
PALEST, DARKEST = 0.75, 0.45


def finish_of(name: str) -> tuple[Colour, float]:
    """The colour and roughness that a name stands for.

    Parameters
    ----------
    name : str
        Of a material.

    Returns
    -------
    (float, float, float)
        Scene-linear colour: of the last word that is known, else a pale tone of the name's own.
    float
        Roughness, 0 to 1.
    """
    for word in reversed(name.lower().split()):
        if word in FINISHES:
            return FINISHES[word]
    lots = zlib.crc32(name.encode())
    r, g, b = (DARKEST + (PALEST - DARKEST) * (lots >> shift & 0xFF) / 0xFF for shift in (0, 8, 16))
    return (r, g, b), 0.8


def material(name: str) -> bpy.types.Material:
    """The file's material of a name, made at its first use.

    Parameters
    ----------
    name : str

    Returns
    -------
    bpy.types.Material
    """
    existing = bpy.data.materials.get(name)
    if existing is not None:
        return existing
    made = bpy.data.materials.new(name)
    if made.node_tree is None:  # Blender before 5.0
        made.use_nodes = True
    colour, roughness = finish_of(name)
    made.diffuse_color = (*colour, 1.0)
    made.roughness = roughness
    shader = next(node for node in made.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    known = next((word for word in reversed(name.lower().split()) if word in FINISHES), "")
    palette = PALETTES.get(known)
    if palette is not None:
        _vary(made, shader, palette)
    return made


def _vary(shaded: bpy.types.Material, shader: bpy.types.ShaderNode, palette: tuple[Colour, ...]) -> None:
    """Choose a material's colour by the attribute of its faces."""
    nodes, links = shaded.node_tree.nodes, shaded.node_tree.links
    attribute, ramp = nodes.new("ShaderNodeAttribute"), nodes.new("ShaderNodeValToRGB")
    attribute.attribute_name = VARIATION
    elements = ramp.color_ramp.elements
    ramp.color_ramp.interpolation = "CONSTANT"
    while len(elements) < len(palette):
        elements.new(0.5)
    for k, (element, colour) in enumerate(zip(elements, palette, strict=True)):
        element.position, element.color = k / len(palette), (*colour, 1.0)
    links.new(attribute.outputs["Fac"], ramp.inputs["Fac"])
    links.new(ramp.outputs["Color"], shader.inputs["Base Color"])
    attribute.location, ramp.location = (-500.0, 200.0), (-300.0, 200.0)
