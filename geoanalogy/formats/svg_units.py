"""Lengths, transforms and viewports of SVG."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]

#: A bound for numbers in a file, before transforms; their squares are finite.
_LARGEST = 1e15

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_LENGTH = re.compile(rf"\s*({_NUMBER})\s*([a-zA-Z%]*)\s*")
_TRANSFORM = re.compile(r"[\s,]*([a-zA-Z]+)\s*\(([^()]*)\)[\s,]*")
_ALIGNMENT = re.compile(r"x(Min|Mid|Max)Y(Min|Mid|Max)")
_SHARES = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}
_ARGUMENTS = {"matrix": (6,), "translate": (1, 2), "scale": (1, 2), "rotate": (1, 3), "skewX": (1,), "skewY": (1,)}

_INCH = 0.0254
#: Metres per unit: lengths on paper.
_METRES = {"mm": 1e-3, "cm": 1e-2, "in": _INCH, "pt": _INCH / 72, "pc": _INCH / 6, "Q": 2.5e-4}
#: CSS pixels per unit.
_PIXELS = {"": 1.0, "px": 1.0, "em": 16.0, "ex": 8.0, "rem": 16.0, **{u: m / _INCH * 96 for u, m in _METRES.items()}}


@dataclass(frozen=True)
class Viewport:
    """The size, in user units, that percentages refer to."""

    width: float
    height: float

    @property
    def diagonal(self) -> float:
        """What percentages of radii refer to."""
        return float(np.hypot(self.width, self.height) / np.sqrt(2))


def numbers(text: str) -> NDArray[np.float64]:
    """The numbers of a list that spaces or commas separate.

    Parameters
    ----------
    text : str

    Returns
    -------
    ndarray of shape (n,)

    Raises
    ------
    ValueError
        Where something else stands among them.
    """
    if re.sub(_NUMBER, "", text).strip(" \t\r\n\f,"):
        raise ValueError(f"{text.strip()[:30]!r} is no list of numbers")
    return np.array([number(n) for n in re.findall(_NUMBER, text)])


def number(text: str) -> float:
    """A number that can be a coordinate.

    Parameters
    ----------
    text : str

    Returns
    -------
    float

    Raises
    ------
    ValueError
        For one beyond all coordinates.
    """
    value = float(text)
    if abs(value) > _LARGEST:
        raise ValueError(f"the number {text[:30]} is beyond all coordinates")
    return value


def length(text: str | None, reference: float, default: float = 0.0) -> float:
    """A length in user units.

    Parameters
    ----------
    text : str or None
        A number with or without a unit, as CSS has them; None: the default.
    reference : float
        What 100 % is.
    default : float

    Returns
    -------
    float

    Raises
    ------
    ValueError
        For anything else.
    """
    if text is None or text.strip() == "auto":
        return default
    match = _LENGTH.fullmatch(text)
    if match and match[2] == "%":
        return number(match[1]) / 100 * reference
    if not match or _unit(match[2]) not in _PIXELS:
        raise ValueError(f"{text.strip()[:30]!r} is no length")
    return number(match[1]) * _PIXELS[_unit(match[2])]


def _unit(text: str) -> str:
    """A unit as the tables have it: CSS writes it in letters of either case."""
    return "Q" if text in "qQ" and text else text.lower()


def matrix(text: str | None) -> Matrix:
    """The affine map of a ``transform`` attribute, shape (3, 3).

    Parameters
    ----------
    text : str or None

    Returns
    -------
    ndarray of shape (3, 3)

    Raises
    ------
    ValueError
        For functions that are unknown or have the wrong number of arguments.
    """
    result = np.eye(3)
    at = 0
    while text and text.strip() != "none" and at < len(text.rstrip()):
        match = _TRANSFORM.match(text, at)
        if not match:
            raise ValueError(f"{text[at : at + 30].strip()!r} is no transform")
        name, v = match[1], numbers(match[2])
        if name not in _ARGUMENTS or len(v) not in _ARGUMENTS[name]:
            raise ValueError(f"{match[0].strip()!r} is no transform")
        result = result @ _one_transform(name, v)
        at = match.end()
    return result


def _one_transform(name: str, v: NDArray[np.float64]) -> Matrix:
    result = np.eye(3)
    if name == "matrix":
        result[:2] = v.reshape(3, 2).T
    elif name == "translate":
        result[: len(v), 2] = v
    elif name == "scale":
        result[0, 0], result[1, 1] = v[0], v[-1]
    elif name == "rotate":
        c, s = np.cos(np.radians(v[0])), np.sin(np.radians(v[0]))
        result[:2, :2] = [[c, -s], [s, c]]
        if len(v) == 3:
            result[:2, 2] = v[1:] - result[:2, :2] @ v[1:]
    else:
        result[(0, 1) if name == "skewX" else (1, 0)] = np.tan(np.radians(v[0]))
    return result


def view_box(attributes: Mapping[str, str]) -> NDArray[np.float64] | None:
    """The x, y, width and height of a ``viewBox``, None without one.

    Parameters
    ----------
    attributes : mapping
        Of an svg or symbol element.

    Returns
    -------
    ndarray of shape (4,) or None

    Raises
    ------
    ValueError
        For one without an area.
    """
    if "viewBox" not in attributes:
        return None
    box = numbers(attributes["viewBox"])
    if len(box) != 4 or box[2] <= 0 or box[3] <= 0:
        raise ValueError(f"the viewBox {attributes['viewBox'][:40]!r} has no area")
    return box


def page(attributes: Mapping[str, str]) -> tuple[Matrix, Viewport]:
    """The map from the outermost user units to the scene, y upwards from the page's lower edge, and the viewport.

    Where the page's width (or height) is given in millimetres, inches and the like, the scene is in metres; otherwise
    its unit is the pixel, or the unit of the viewBox where the page has no size.

    Parameters
    ----------
    attributes : mapping
        Of the outermost svg element.

    Returns
    -------
    matrix : ndarray of shape (3, 3)
    viewport : Viewport

    Raises
    ------
    ValueError
        For sizes that are none.
    """
    sizes = []
    metres = 1.0
    for name in ("width", "height"):
        text = attributes.get(name, "auto")
        unit = _unit(match[2]) if (match := _LENGTH.fullmatch(text)) else ""
        size = 0.0 if unit == "%" else length(text, 0.0)
        if size < 0:
            raise ValueError(f"the {name} {text!r} of the page is negative")
        sizes.append(size)
        if unit in _METRES:
            metres = _INCH / 96
    box = view_box(attributes)
    if box is None:
        scales = [1.0]
        box = np.array([0.0, 0.0, *sizes])
    else:
        scales = [s / b for s, b in zip(sizes, box[2:], strict=True) if s] or [1.0]
    scale = _aspect(attributes, np.resize(scales, 2))[0] * metres
    x, y, _, height = box
    result = np.array([[scale[0], 0.0, -scale[0] * x], [0.0, -scale[1], scale[1] * (y + height)], [0.0, 0.0, 1.0]])
    return result, Viewport(float(box[2]), float(box[3]))


def fit(attributes: Mapping[str, str], viewport: Viewport) -> tuple[Matrix, Viewport]:
    """The map from the user units within a nested svg or symbol to those around it, and its viewport.

    Parameters
    ----------
    attributes : mapping
        Of the nested element.
    viewport : Viewport
        Around it.

    Returns
    -------
    matrix : ndarray of shape (3, 3)
    viewport : Viewport

    Raises
    ------
    ValueError
        For sizes that are none.
    """
    place = [
        length(attributes.get("x"), viewport.width),
        length(attributes.get("y"), viewport.height),
        length(attributes.get("width"), viewport.width, viewport.width),
        length(attributes.get("height"), viewport.height, viewport.height),
    ]
    result = np.eye(3)
    box = view_box(attributes)
    if box is None:
        result[:2, 2] = place[:2]
        return result, Viewport(place[2], place[3])
    scale, share = _aspect(attributes, np.array(place[2:]) / box[2:])
    result[[0, 1], [0, 1]] = scale
    result[:2, 2] = place[:2] + share * (place[2:] - scale * box[2:]) - scale * box[:2]
    return result, Viewport(float(box[2]), float(box[3]))


def _aspect(attributes: Mapping[str, str], scale: NDArray[np.float64]) -> tuple[NDArray[np.float64], Matrix]:
    """The scale of a view box along x and y, and the shares of the room left over that lie before it."""
    words = attributes.get("preserveAspectRatio", "").split()
    if "none" in words:
        return scale, np.zeros(2)
    aligned = [match for word in words if (match := _ALIGNMENT.fullmatch(word))]
    uniform = scale.max() if "slice" in words else scale.min()
    return np.full(2, uniform), np.array([_SHARES[share] for share in aligned[0].groups()] if aligned else [0.5, 0.5])
