"""How an operations tree is stored: JSON files, their schema, and its older versions (section 5.6)."""

import json
import os
from collections.abc import Callable, Mapping
from typing import Any

from ..arguments import path_of
from ..errors import InputError

SCHEMA = "geoanalogy.operations"

#: How a stored tree of each version becomes one of the next: the first from version 1 to 2, and so on.
MIGRATIONS: tuple[Callable[[Mapping[str, Any]], Mapping[str, Any]], ...] = ()

#: The version that is written.
VERSION = 1 + len(MIGRATIONS)


def with_schema(nodes: list[Any]) -> dict[str, Any]:
    """Stored nodes with what says that they are a tree, and of which version.

    Parameters
    ----------
    nodes : list
        As plain data.

    Returns
    -------
    dict
    """
    return {"schema": f"{SCHEMA}/{VERSION}", "nodes": nodes}


def stored_nodes(plain: Any, name: str) -> list[Any]:
    """The nodes of a stored tree, as they are stored in this version.

    Parameters
    ----------
    plain : mapping
        What `with_schema` gave, in this version or an older one.
    name : str
        What the tree is called in messages.

    Returns
    -------
    list

    Raises
    ------
    InputError
        For anything but a tree of this version or an older one.
    """
    stated = plain.get("schema") if isinstance(plain, Mapping) else None
    schema = stated if isinstance(stated, str) else ""
    kind, _, version = schema.partition("/")
    if kind != SCHEMA or not version.isdecimal():
        raise InputError(f"{name} is no operations tree; choose a file that GeoAnalogy has saved")
    if len(version) > 9 or int(version) > VERSION:
        raise InputError(f"{name} was saved by a newer version of GeoAnalogy ({schema[:40]}); update the add-on")
    for step in MIGRATIONS[max(int(version), 1) - 1 :]:
        plain = step(plain)
    if int(version) < 1 or not isinstance(plain.get("nodes"), list):
        raise InputError(f"{name} is damaged: it has no list of nodes; save it again")
    nodes: list[Any] = plain["nodes"]
    return nodes


def read_json(path: str | os.PathLike[str]) -> tuple[Any, str]:
    """The plain data of a file.

    Parameters
    ----------
    path : path

    Returns
    -------
    plain : object
    name : str
        The file's name, for messages.

    Raises
    ------
    InputError
        Where the file cannot be read or is no JSON.
    """
    path = path_of(path)
    name = path.name
    try:
        return json.loads(path.read_text(encoding="utf-8")), name
    except OSError as error:
        raise InputError(f"{name} cannot be read: {error.strerror or error}; check the path") from None
    except json.JSONDecodeError as error:
        raise InputError(f"{name} is damaged or cut off at line {error.lineno} ({error.msg}); save it again") from None
    except (ValueError, RecursionError):  # no UTF-8, a number of thousands of digits, brackets within brackets
        raise InputError(f"{name} is no JSON text; choose a file that GeoAnalogy has saved") from None


def write_json(plain: Any, path: str | os.PathLike[str]) -> None:
    """Write plain data to a file. Where that fails, a file of that name stays as it was.

    Parameters
    ----------
    plain : object
    path : path

    Raises
    ------
    InputError
        Where the file cannot be written.
    """
    path = path_of(path)
    if not path.name:
        raise InputError("the path of the operations tree is empty; give the name of a file")
    written = json.dumps(plain, indent=1, ensure_ascii=False, allow_nan=False)
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(written + "\n", encoding="utf-8")
        os.replace(part, path)
    except OSError as error:
        raise InputError(f"{path.name} cannot be written: {error.strerror or error}; choose another place") from None
