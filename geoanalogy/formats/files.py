"""Reading and writing scenes and drawings, by the suffix of their files."""

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..arguments import given, path_of, real, shown
from ..errors import InputError
from ..geometry.scene import Scene
from . import dxf, geojson, svg
from .labelling import TABLE, Rule, read_table
from .outlines import Outline, Points, make_scene
from .repair import check_unit, mended, sound_parcels

_GEOJSON = (".geojson", ".json")
_DRAWINGS = {".svg": svg.read, ".dxf": dxf.read}


def read_scene(path: str | os.PathLike[str], *, label: str | None = None, scale: float = 1.0) -> Scene:
    """A scene from a GeoJSON, SVG or DXF file.

    Parameters
    ----------
    path : str or path-like
        The suffix says the format: .geojson, .json, .svg, .dxf.
    label : str, optional
        Where the file keeps the labels: a property of GeoJSON features ("building"), an attribute of SVG shapes
        ("class"; "layer" is the name of the group), "layer" or "block" of DXF. By default what the format's reader
        says: `geojson.read`, `svg.read`, `dxf.read`.
    scale : float
        Scene units per unit of the file; 50 for a plan drawn at 1:50.

    Returns
    -------
    Scene
        Far from the origin its coordinates are moved near it; `Scene.offset` keeps by how much.

    Raises
    ------
    InputError
        Names the file, the feature and the reason.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from geoanalogy.geometry.polygon import Polygon
    >>> with TemporaryDirectory() as folder:
    ...     write_scene(Scene([Polygon([(0, 0), (4, 0), (4, 3)], label="attic")]), f"{folder}/plan.geojson")
    ...     read_scene(f"{folder}/plan.geojson").polygons[0].label
    'attic'
    """
    path = path_of(path)
    if not 0 < real(scale) < np.inf:
        raise InputError(
            f"the scale {shown(scale)} is no scale; give how many scene units a unit of the file is, such as 50"
        )
    if label is not None:
        given(label, str, "label", "the name of the property that holds the labels")
    outlines = _outlines(path, label)
    if scale != 1.0:
        outlines = [Outline(o.where, [r * scale for r in o.rings], o.properties) for o in outlines]
    return make_scene(path.name, outlines)


def read_parcels(
    path: str | os.PathLike[str], *, label: str | None = None, table: str | os.PathLike[str] | None = None
) -> tuple[Scene, list[str]]:
    """The sound parcels of a file, and what is wrong with the others.

    Parameters
    ----------
    path : str or path-like
        As for `read_scene`.
    label : str, optional
        As for `read_scene`.
    table : str or path-like, optional
        How parcels of GeoJSON without a label get one by their tags, see `labelling.read_table`; None: the table that
        is part of the package.

    Returns
    -------
    scene : Scene
    problems : list of str
        A sentence for every parcel that is mended, and for those that are left out: no simple ring, hardly any area,
        far too many vertices, no label.

    Raises
    ------
    InputError
        Where the file or the table itself cannot be read, or the coordinates are degrees.
    """
    path = path_of(path)
    rules = read_table(TABLE if table is None else table)
    outlines = _outlines(path, label, rules)
    check_unit(path.name, outlines)
    problems: list[str] = []
    scene = make_scene(path.name, mended(path.name, outlines, problems), problems)
    return sound_parcels(path.name, scene, problems), problems


def read_drawing(path: str | os.PathLike[str]) -> list[Points]:
    """The strokes of an SVG drawing.

    Parameters
    ----------
    path : str or path-like
        An .svg file.

    Returns
    -------
    list of ndarray of shape (n, 2)
        A closed line repeats its first point; y points upwards.

    Raises
    ------
    InputError
        Names the file, the shape and the reason.
    """
    path = path_of(path)
    if path.suffix.lower() != ".svg":
        raise InputError(f"{path.name} is no drawing that is read; give an .svg file")
    strokes = svg.read_strokes(_content(path), path.name)
    if not strokes:
        raise InputError(f"{path.name} holds no lines; draw at least one path")
    return strokes


def write_scene(scene: Scene, path: str | os.PathLike[str]) -> None:
    """Write a scene as GeoJSON; `read_scene` gives the same scene back.

    Parameters
    ----------
    scene : Scene
    path : str or path-like
        A .geojson or .json file; an existing one is replaced once the new one is complete.

    Raises
    ------
    InputError
        For another suffix, and where the file cannot be written.
    """
    given(scene, Scene, "the scene", "Scene([polygon, …])")
    path = path_of(path)
    if path.suffix.lower() not in (".geojson", ".json"):
        raise InputError(f"{path.name} is in no format that is written; give a .geojson file")
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(geojson.write(scene), encoding="utf-8")
        part.replace(path)
    except OSError as error:
        raise InputError(f"{path} cannot be written ({error.strerror}); choose another place") from None


def _outlines(path: Path, label: str | None, rules: Sequence[Rule] = ()) -> list[Outline]:
    """The areas of a file of any format."""
    suffix = path.suffix.lower()
    if suffix in _GEOJSON:
        return geojson.read(_content(path), path.name, label, rules)
    if suffix not in _DRAWINGS:
        raise InputError(f"{path.name} is in no format that is read; give a .geojson, .json, .svg or .dxf file")
    return _DRAWINGS[suffix](_content(path), path.name, label)


def _content(path: Path) -> bytes:
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path} cannot be read ({error.strerror}); check the name and the folder") from None
    if not content.strip():
        raise InputError(f"{path.name} is empty; export it again")
    return content
