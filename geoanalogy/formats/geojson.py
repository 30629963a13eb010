"""Scenes as GeoJSON (RFC 7946): FeatureCollections of polygons, in scene units instead of degrees."""

import json
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from .labelling import Rule, label_by
from .outlines import Outline, Points

#: What `write` says of its files; `read` refuses a higher number.
SCHEMA = "geoanalogy.scene/1"

#: Names, or EPSG codes, of the geographic coordinate systems in common use.
_DEGREES = (
    "CRS84",
    "CRS83",
    "CRS27",
    "4326",
    "4258",
    "4269",
    "4267",
    "4283",
    "4490",
    "4612",
    "4617",
    "4674",
    "6668",
    "7844",
)
#: Radians; whoever writes more writes degrees, or nonsense.
_LARGEST_ANGLE = 100.0
_AREAS = ("Polygon", "MultiPolygon")
_OTHER = ("Point", "MultiPoint", "LineString", "MultiLineString")
_COLLECTION = "GeometryCollection"


def read(content: bytes, file: str, label: str | None = None, rules: Sequence[Rule] = ()) -> list[Outline]:
    """The areas of a GeoJSON text; points and lines in it are left out.

    Parameters
    ----------
    content : bytes
        A FeatureCollection, a Feature or a geometry, in UTF-8. Feature properties that are read: ``label``, ``id``
        (else the feature's own), ``parent``, ``orientation`` (radians) and ``segment_labels`` (one per edge of the
        outline; one list per part of a MultiPolygon). Parts of a MultiPolygon share its id; heights are dropped.
    file : str
        The file's name, for messages.
    label : str, optional
        Another property that holds the label, such as "building"; features without it keep their ``label``.
    rules : sequence of (str, str, str)
        How features without a label get one by their other properties, see `labelling.label_by`.

    Returns
    -------
    list of Outline

    Raises
    ------
    InputError
        For text that is not GeoJSON, coordinates in degrees, files of a newer version, and malformed features.
    """
    try:
        data = json.loads(content.decode("utf-8-sig"))
    except UnicodeDecodeError:
        raise InputError(f"{file} is not text in UTF-8; save it as UTF-8") from None
    except RecursionError:
        raise InputError(f"{file} is nested too deeply for GeoJSON; export it again") from None
    except ValueError as error:
        where = f"line {error.lineno}: {error.msg}" if isinstance(error, json.JSONDecodeError) else ""
        reason = where or "it has a number of thousands of digits"
        raise InputError(f"{file} is not valid JSON ({reason}); it may be cut off, export it again") from None
    if not isinstance(data, dict) or data.get("type") not in ("FeatureCollection", "Feature", *_AREAS, _COLLECTION):
        raise InputError(f"{file} is no GeoJSON of polygons; give a FeatureCollection of Polygon features")
    _check_schema(data, file)
    _check_crs(data, file)
    if data["type"] == "FeatureCollection":
        features = data.get("features")
        if not isinstance(features, list):
            raise InputError(f"{file} has no list of features; a FeatureCollection needs one")
    else:
        features = [data if data["type"] == "Feature" else {"type": "Feature", "geometry": data}]
    if label is not None and features and not any(_has(feature, label) for feature in features):
        raise InputError(f"{file} has no feature with the property {label!r} to take labels from; check its name")
    outlines: list[Outline] = []
    for number, feature in enumerate(features):
        outlines += _feature(feature, f"feature {number}", file, label, rules)
    return outlines


def _has(feature: Any, name: str) -> bool:
    """Whether a feature has a property."""
    properties = feature.get("properties") if isinstance(feature, dict) else None
    return isinstance(properties, dict) and name in properties


def _check_schema(data: dict[str, Any], file: str) -> None:
    schema = data.get("schema", SCHEMA)
    if schema == SCHEMA or not str(schema).startswith("geoanalogy."):
        return
    if str(schema).startswith(SCHEMA.partition("/")[0]):
        raise InputError(
            f"{file} has the schema {schema!r}, but this version reads {SCHEMA!r}; open it with a newer GeoAnalogy"
        )
    raise InputError(f"{file} holds {schema!r}, which is no scene; choose a file of polygons")


def _check_crs(data: dict[str, Any], file: str) -> None:
    crs = data.get("crs")
    properties = crs.get("properties") if isinstance(crs, dict) else None
    name = str(properties.get("name", properties.get("code", ""))) if isinstance(properties, dict) else ""
    if name.replace("/", ":").split(":")[-1] in _DEGREES:
        raise InputError(
            f"{file} has its coordinates in degrees ({name}); export it in a projected system in metres, such as UTM"
        )


def _feature(feature: Any, where: str, file: str, label: str | None, rules: Sequence[Rule]) -> Iterator[Outline]:
    if not isinstance(feature, dict) or feature.get("type") != "Feature":
        raise InputError(f"{file}, {where}: it is no Feature; a FeatureCollection holds Feature objects")
    given = feature.get("properties")
    properties = given if isinstance(given, dict) else {}
    # Databases write null for what a feature lacks: the next place counts then.
    id = _first_given(properties.get("id"), feature.get("id"))
    if id is not None:
        where = f"{where} (id {_short(id)})"
    if given is not None and not isinstance(given, dict):
        raise InputError(f"{file}, {where}: its properties are {_short(given)}; give an object or null")
    text = {
        "id": id,
        "label": _first_given(properties.get(label or "label"), properties.get("label")),
        "parent": properties.get("parent"),
    }
    for name, value in text.items():
        if value is not None and not (isinstance(value, str) or _is_number(value)):
            raise InputError(f"{file}, {where}: its {name} is {_short(value)}; give a text")
    shared = {name: value if value is None else str(value) for name, value in text.items()}
    shared["label"] = shared["label"] or label_by(rules, properties)
    orientation = properties.get("orientation")
    if orientation is not None and not (_is_number(orientation) and abs(orientation) <= _LARGEST_ANGLE):
        raise InputError(f"{file}, {where}: its orientation is {_short(orientation)}; give an angle in radians")
    geometry = feature.get("geometry")
    parts = list(_parts(geometry, where, file))
    labels = properties.get("segment_labels")
    if labels is not None and not (isinstance(geometry, dict) and geometry["type"] == "MultiPolygon"):
        labels = [labels]
    if labels is not None and (
        not isinstance(labels, list) or len(labels) != len(parts) or not all(_is_labels(part) for part in labels)
    ):
        raise InputError(
            f"{file}, {where}: its segment_labels are no list of texts; give one text per edge of the outline"
        )
    for k, rings in enumerate(parts):
        yield Outline(
            where, rings, {**shared, "orientation": orientation, "segment_labels": labels[k] if labels else None}
        )


def _first_given(first: Any, other: Any) -> Any:
    return other if first is None else first


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _is_labels(value: Any) -> bool:
    return isinstance(value, list) and all(v is None or isinstance(v, str) for v in value)


def _parts(geometry: Any, where: str, file: str) -> Iterator[list[Points]]:
    """The polygons of a geometry, each a list of rings."""
    waiting = [geometry]
    while waiting:
        geometry = waiting.pop()
        if geometry is None:
            continue
        kind = geometry.get("type") if isinstance(geometry, dict) else None
        if kind == _COLLECTION:
            members = geometry.get("geometries")
            if not isinstance(members, list):
                raise InputError(f"{file}, {where}: its GeometryCollection has no list of geometries")
            waiting += members[::-1]
        elif kind in _AREAS:
            parts = geometry.get("coordinates")
            if parts == []:
                continue  # the format's own way to say that there is nothing
            for rings in [parts] if kind == "Polygon" else parts if isinstance(parts, list) else [parts]:
                if not isinstance(rings, list) or not rings:
                    raise InputError(f"{file}, {where}: its {kind} has no rings; give an outline of x, y pairs")
                yield [_ring(ring, f"ring {i}", where, file) for i, ring in enumerate(rings)]
        elif kind not in _OTHER:
            raise InputError(f"{file}, {where}: its geometry is {_short(kind)}; give a Polygon or MultiPolygon")


def _ring(ring: Any, name: str, where: str, file: str) -> Points:
    if not isinstance(ring, list) or not all(
        isinstance(place, list) and len(place) >= 2 and all(_is_number(v) for v in place[:2]) for place in ring
    ):
        raise InputError(f"{file}, {where}: {name} is no list of x, y pairs of numbers; correct its coordinates")
    try:
        points = np.array([place[:2] for place in ring], dtype=np.float64).reshape(-1, 2)
    except OverflowError:
        raise InputError(f"{file}, {where}: {name} has a number beyond all coordinates; correct it") from None
    if np.isfinite(points).all() and (points[:1] != points[-1:]).any():
        raise InputError(f"{file}, {where}: {name} is open; repeat its first position at the end")
    return points


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."


def write(scene: Scene) -> str:
    """A scene as GeoJSON text, one feature per line, coordinates as in the file it came from.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    str
    """
    features = ",\n".join(json.dumps(_as_feature(p, np.array(scene.offset))) for p in scene.polygons)
    return f'{{"type": "FeatureCollection", "schema": "{SCHEMA}", "features": [\n{features}\n]}}\n'


def _as_feature(polygon: Polygon, offset: Points) -> dict[str, Any]:
    properties = polygon.to_dict()
    del properties["points"]
    properties.pop("holes", None)
    rings = [(np.vstack([ring, ring[:1]]) + offset).tolist() for ring in polygon.rings]
    return {"type": "Feature", "properties": properties, "geometry": {"type": "Polygon", "coordinates": rings}}
