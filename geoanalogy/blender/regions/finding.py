"""Finding the regions of a drawing: queries read as operations, and what the engine found for them in this session."""

from collections import OrderedDict
from collections.abc import Hashable
from dataclasses import replace

import bpy

from ...errors import InputError
from ...operations.region_transfer import Found, RegionTransfer
from ...progress import Stepper
from ...regions.options import RegionOptions
from .drawings import DrawnLines
from .queries import read_query

#: Matches that are kept for carrying over more with them.
MOST_KEPT = 8

#: What has been found in this session, by all that it depends on.
_found: OrderedDict[Hashable, Found] = OrderedDict()


def read_operation(drawn: DrawnLines, query: bpy.types.Object | None, options: RegionOptions) -> RegionTransfer:
    """The operation of a query.

    Parameters
    ----------
    drawn : DrawnLines
    query : bpy.types.Object or None
    options : RegionOptions

    Returns
    -------
    RegionTransfer

    Raises
    ------
    InputError
        Where the query cannot be used, or goes round no line.
    """
    read = read_query(query, drawn.plane)
    try:
        return RegionTransfer.of(drawn.lines, read.points, replace(options, query_kind=read.kind))
    except InputError as error:
        raise InputError(f"object {query.name!r}: {error}") from None


def find_steps(operation: RegionTransfer, drawn: DrawnLines) -> Stepper[Found]:
    """What the engine finds; the same drawing, query and options are computed once.

    Parameters
    ----------
    operation : RegionTransfer
    drawn : DrawnLines

    Returns
    -------
    generator of (float, str)
        Returns Found.

    Raises
    ------
    InputError
        For what the engine refuses.
    """
    name = _name_of(operation, drawn)
    if name not in _found:
        _found[name] = yield from operation.find_steps(drawn.lines, drawn.smoothing)
        if len(_found) > MOST_KEPT:
            _found.popitem(last=False)
    return _found[name]


def found_already(operation: RegionTransfer, drawn: DrawnLines) -> Found | None:
    """What the engine has found in this session.

    Parameters
    ----------
    operation : RegionTransfer
    drawn : DrawnLines

    Returns
    -------
    Found or None
        None where it would have to be computed.
    """
    return _found.get(_name_of(operation, drawn))


def forget_found() -> None:
    """Drop what has been found in this session."""
    _found.clear()


def _name_of(operation: RegionTransfer, drawn: DrawnLines) -> Hashable:
    lines = b"".join(line.tobytes() for line in drawn.lines)
    return lines, len(drawn.lines), drawn.smoothing, operation.query, operation.lines, operation.options
