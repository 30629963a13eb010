"""What callers give: numbers, points, lists and paths, told apart from what is none, and shown in messages."""

import numbers
import os
import reprlib
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import InputError


def shown(value: object) -> str:
    """A value as messages show it: on one line, and short.

    Parameters
    ----------
    value : object

    Returns
    -------
    str

    Examples
    --------
    >>> shown(1.5), shown("half"), shown([[0.0, 1.0]] * 99)
    ('1.5', "'half'", '[[0.0, 1.0], [0.0, 1.0], [0.0, 1.0], [0.0, 1.0], [0.0, 1.0], [0.0, 1.0], ...]')
    """
    if isinstance(value, float | np.number):
        return f"{value}"
    return " ".join(reprlib.repr(value).split())


def real(value: object) -> float:
    """A real number as a float; NaN for anything else, which no range contains.

    Parameters
    ----------
    value : object
        Numbers of Python and numpy are taken, text is not.

    Returns
    -------
    float

    Examples
    --------
    >>> real(np.float32(0.5)), real(True), real("0.5"), real(None)
    (0.5, 1.0, nan, nan)
    """
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if not isinstance(value, numbers.Real | np.bool_):
        return float("nan")
    try:
        return float(value)
    except OverflowError:
        return float("inf") if value > 0 else float("-inf")  # type: ignore[operator]


def is_whole(value: object) -> bool:
    """Whether a value is a whole number, of whatever type.

    Parameters
    ----------
    value : object

    Returns
    -------
    bool
    """
    return real(value).is_integer()


def is_flag(value: object) -> bool:
    """Whether a value is true or false; 0 and 1 are, as Blender's custom properties keep them.

    Parameters
    ----------
    value : object

    Returns
    -------
    bool
    """
    return real(value) in (0.0, 1.0)


def number(value: Any, name: str, least: float, most: float | None = None) -> float:
    """A number within limits.

    Parameters
    ----------
    value : object
    name : str
        What it is called in messages.
    least : float
    most : float, optional
        None: any finite number from `least` on.

    Returns
    -------
    float

    Raises
    ------
    InputError
        For a number outside the limits, and for what is none.
    """
    if not least <= real(value) <= (sys.float_info.max if most is None else most):
        wanted = f"a finite number from {least:g} on" if most is None else f"a number from {least:g} to {most:g}"
        raise InputError(f"{name} is {shown(value)}; give {wanted}")
    return real(value)


def positive(value: Any, name: str, most: float | None = None) -> float:
    """A number above zero.

    Parameters
    ----------
    value : object
    name : str
        What it is called in messages.
    most : float, optional
        None: any finite number; infinity: any.

    Returns
    -------
    float

    Raises
    ------
    InputError
        For a number outside the limits, and for what is none.
    """
    if not 0 < real(value) <= (sys.float_info.max if most is None else most):
        wanted = "a finite positive number" if most is None else "a positive number"
        limit = f" up to {most:g}" if most is not None and most < float("inf") else ""
        raise InputError(f"{name} is {shown(value)}; give {wanted}{limit}")
    return real(value)


def count(value: Any, name: str, least: int = 0, most: int | None = None) -> int:
    """A whole number within limits.

    Parameters
    ----------
    value : object
    name : str
        What it is called in messages.
    least : int
    most : int, optional
        None: any from `least` on.

    Returns
    -------
    int

    Raises
    ------
    InputError
        For a number outside the limits or between two whole ones, and for what is none.
    """
    if not is_whole(value) or not least <= value or (most is not None and value > most):
        limit = "on" if most is None else f"to {most}"
        raise InputError(f"{name} is {shown(value)}; give a whole number from {least} {limit}")
    return int(value)


def flag(value: Any, name: str) -> bool:
    """True or false.

    Parameters
    ----------
    value : object
    name : str
        What it is called in messages.

    Returns
    -------
    bool

    Raises
    ------
    InputError
        For what is neither.
    """
    if not is_flag(value):
        raise InputError(f"{name} is {shown(value)}; give True or False")
    return bool(value)


def word(value: Any, name: str, *allowed: str) -> str:
    """One of a few words.

    Parameters
    ----------
    value : object
    name : str
        What it is called in messages.
    *allowed : str

    Returns
    -------
    str

    Raises
    ------
    InputError
        For anything else.
    """
    if not isinstance(value, str) or value not in allowed:
        raise InputError(f"{name} is {shown(value)}; choose from {', '.join(allowed)}")
    return str(value)


def points_of(value: Any, name: str) -> NDArray[np.float64]:
    """Points as an array; a single one may be given as a pair.

    Parameters
    ----------
    value : array_like of shape (n, 2) or (2,)
    name : str
        What they are called in messages.

    Returns
    -------
    ndarray of shape (n, 2) or (2,)

    Raises
    ------
    InputError
        For anything but pairs of finite numbers.
    """
    try:
        points = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} are {shown(value)}; give pairs of numbers") from None
    if points.size == 0 and points.ndim < 3:
        return np.zeros((0, 2))
    if points.ndim not in (1, 2) or points.shape[-1] != 2:
        raise InputError(f"{name} are an array of shape {points.shape}; give them as an array of shape (n, 2)")
    if not np.isfinite(points).all():
        raise InputError(f"{name} have a coordinate that is not finite (NaN or infinity); leave that point out")
    return points


def given(value: Any, kind: type, name: str, remedy: str) -> Any:
    """A value of the type that is wanted.

    Parameters
    ----------
    value : object
    kind : type
    name : str
        What it is called in messages.
    remedy : str
        What to give instead.

    Returns
    -------
    object

    Raises
    ------
    InputError
        For a value of another type.
    """
    if not isinstance(value, kind):
        raise InputError(f"{name} is {shown(value)}, which is no {kind.__name__}; give {remedy}")
    return value


def listed(value: Any, name: str, remedy: str) -> tuple[Any, ...]:
    """The members of a list, of an array or of any other iterable, but not the letters of a text.

    Parameters
    ----------
    value : iterable
    name : str
        What it is called in messages.
    remedy : str
        What to give instead.

    Returns
    -------
    tuple

    Raises
    ------
    InputError
        For what is no iterable, and for text.
    """
    single = isinstance(value, str | bytes) or (isinstance(value, np.ndarray) and value.ndim == 0)
    if single or not isinstance(value, Iterable):
        raise InputError(f"{name} is {shown(value)}; give {remedy}")
    return tuple(value)


def path_of(value: Any) -> Path:
    """A path.

    Parameters
    ----------
    value : str or path-like

    Returns
    -------
    Path

    Raises
    ------
    InputError
        For anything that names no file.
    """
    try:
        path = Path(os.fspath(value))
    except TypeError:
        raise InputError(f"{shown(value)} is no path; give the name of a file") from None
    if "\0" in str(path):
        raise InputError(f"the path {shown(str(path))} holds a null character; give the name of a file")
    return path
