"""Collections that hold what GeoAnalogy makes: each is found again, or made at its first use."""

import re

import bpy


def ensure_holder(outer: bpy.types.Collection, name: str) -> bpy.types.Collection:
    """The collection of a name inside another one.

    Parameters
    ----------
    outer : bpy.types.Collection
    name : str
        Blender puts a number behind it where another scene has a collection of that name.

    Returns
    -------
    bpy.types.Collection
    """
    numbered = re.compile(re.escape(name) + r"(\.\d{3,})?")
    existing = next((c for c in outer.children if numbered.fullmatch(c.name)), None)
    return _made(outer, name) if existing is None else existing


def holder_with(outer: bpy.types.Collection, key: str, value: str) -> bpy.types.Collection | None:
    """The collection inside another one that a custom property tells, whatever it is called.

    Parameters
    ----------
    outer : bpy.types.Collection
    key, value : str
        The property.

    Returns
    -------
    bpy.types.Collection or None
        None where there is none yet.
    """
    return next((c for c in outer.children if c.get(key) == value), None)


def ensure_holder_with(
    outer: bpy.types.Collection, key: str, value: str, name: str | None = None
) -> bpy.types.Collection:
    """The same, made where there is none.

    Parameters
    ----------
    outer : bpy.types.Collection
    key, value : str
        The property.
    name : str, optional
        What it is called at first; None: the property's value.

    Returns
    -------
    bpy.types.Collection
    """
    existing = holder_with(outer, key, value)
    if existing is None:
        existing = _made(outer, value if name is None else name)
        existing[key] = value
    return existing


def _made(outer: bpy.types.Collection, name: str) -> bpy.types.Collection:
    made = bpy.data.collections.new(name)
    outer.children.link(made)
    return made
