"""Settings of operations: how each is read from JSON and written to it.

An operation declares its settings as dataclass fields with the metadata of `stored`; reading, writing, and the messages
for what is missing, unknown or damaged follow from that.
"""

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import Any

from ..arguments import is_flag
from ..errors import InputError


def _as_it_is(value: Any) -> Any:
    return value


def stored(read: Callable[[Any], Any], write: Callable[[Any], Any] = _as_it_is, late: bool = False) -> dict[str, Any]:
    """The metadata of a field of an operation: how it is stored.

    Parameters
    ----------
    read : callable
        From JSON's plain data to the field's value; raises InputError, TypeError, ValueError or KeyError.
    write : callable
        From the field's value to plain data.
    late : bool
        Whether the setting only sifts what has been computed, so that changing it computes nothing again.

    Returns
    -------
    dict
    """
    return {"read": read, "write": write, "late": late}


def read_settings(cls: type, plain: Any, name: str) -> dict[str, Any]:
    """The arguments of an operation from its stored settings.

    Parameters
    ----------
    cls : type
        A dataclass whose fields have the metadata of `stored`.
    plain : mapping
        What `write_settings` wrote.
    name : str
        What the operation is called in messages.

    Returns
    -------
    dict

    Raises
    ------
    InputError
        For settings that are missing, unknown or damaged.
    """
    if not isinstance(plain, Mapping):
        raise InputError(f"{name} has settings that are no object of names and values; record it again")
    fields = {f.name: f for f in dataclasses.fields(cls)}
    unknown = sorted(set(plain) - set(fields))
    if unknown:
        raise InputError(f"{name} has no setting {', '.join(map(repr, unknown))}; it may come from a newer version")
    values = {}
    for f in fields.values():
        if f.name in plain:
            try:
                values[f.name] = f.metadata["read"](plain[f.name])
            except InputError as error:
                raise InputError(f"{name}, setting {f.name!r}: {error}") from None
            except (TypeError, ValueError, KeyError, AttributeError, IndexError):
                raise InputError(f"{name} has a damaged setting {f.name!r}; record it again") from None
        elif f.default is dataclasses.MISSING and f.default_factory is dataclasses.MISSING:
            raise InputError(f"{name} lacks the setting {f.name!r}; record it again")
    return values


def write_settings(operation: Any, late: bool = True) -> dict[str, Any]:
    """The settings of an operation that are not at their defaults, as plain data.

    Parameters
    ----------
    operation : dataclass instance
    late : bool
        Whether settings that only sift what has been computed are written too.

    Returns
    -------
    dict
    """
    plain = {}
    for f in dataclasses.fields(operation):
        value = getattr(operation, f.name)
        default = f.default_factory() if f.default_factory is not dataclasses.MISSING else f.default
        if value != default and (late or not f.metadata["late"]):
            plain[f.name] = f.metadata["write"](value)
    return plain


def text(value: Any) -> str:
    """A setting that is text.

    Parameters
    ----------
    value : object

    Returns
    -------
    str
    """
    if not isinstance(value, str):
        raise InputError(f"{value!r} is no text")
    return value


def number(value: Any) -> float:
    """A setting that is a finite number.

    Parameters
    ----------
    value : object

    Returns
    -------
    float
    """
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise InputError(f"{value!r} is no finite number")
    return float(value)


def whole(value: Any) -> int:
    """A setting that is a whole number.

    Parameters
    ----------
    value : object

    Returns
    -------
    int
    """
    if number(value) != int(value):
        raise InputError(f"{value!r} is no whole number")
    return int(value)


def flag(value: Any) -> bool:
    """A setting that is true or false; Blender's custom properties keep it as 0 or 1.

    Parameters
    ----------
    value : object

    Returns
    -------
    bool
    """
    if not is_flag(value):
        raise InputError(f"{value!r} is neither true nor false")
    return bool(value)


def optional(read: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """A setting that may be null.

    Parameters
    ----------
    read : callable
        Reads it where it is not.

    Returns
    -------
    callable
    """
    return lambda value: None if value is None else read(value)


def one_of(*choices: str) -> Callable[[Any], str]:
    """A setting that is one of a few words.

    Parameters
    ----------
    *choices : str

    Returns
    -------
    callable
    """

    def read(value: Any) -> str:
        if value not in choices:
            raise InputError(f"{value!r} is not among {', '.join(choices)}")
        return str(value)

    return read


def counts(value: Any) -> dict[str, int]:
    """A setting that is a whole number per label.

    Parameters
    ----------
    value : object

    Returns
    -------
    dict
    """
    return {text(label): whole(count) for label, count in value.items()}
