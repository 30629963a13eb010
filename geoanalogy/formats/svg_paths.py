"""The path data of SVG: the text of the ``d`` attribute to runs of cubics."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .curves import Run, elliptic_arc, quadratic, straight
from .svg_units import number

_LETTER = re.compile(r"[\s,]*(\S)")
_NUMBER = re.compile(r"[\s,]*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)")
_FLAG = re.compile(r"[\s,]*([01])")
_COUNT = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}


@dataclass(frozen=True)
class SubPath:
    """One stroke of a path.

    Attributes
    ----------
    run : ndarray of shape (k, 4, 2), k >= 1
    closed : bool
        Whether it was closed by ``z``; the run then ends where it starts.
    """

    run: Run
    closed: bool


def parse_path(text: str) -> list[SubPath]:
    """The strokes of a path.

    Parameters
    ----------
    text : str
        Path data as in SVG 1.1, section 8.3.

    Returns
    -------
    list of SubPath
        Strokes without length are left out.

    Raises
    ------
    ValueError
        Where the text is no path data, saying where.
    """
    strokes: list[SubPath] = []
    pieces: list[Run] = []
    start = here = np.zeros(2)
    control = here  # the last control point, which smooth curves reflect
    previous = ""

    def finish(closed: bool) -> None:
        if closed and (here != start).any():
            pieces.append(straight([here, start]))
        if pieces:
            run = np.concatenate(pieces)
            if np.ptp(run.reshape(-1, 2), axis=0).any():
                strokes.append(SubPath(run, closed))
        pieces.clear()

    for command, values in _commands(text):
        kind = command.upper()
        if not previous and kind != "M":
            raise ValueError(f"it starts with {command!r} instead of a move")
        base = here if command.islower() else np.zeros(2)
        if kind == "M":
            finish(False)
            start = here = base + values
        elif kind == "Z":
            finish(True)
            here = start
        elif kind in "LHV":
            axes = {"L": [0, 1], "H": [0], "V": [1]}[kind]
            end = here.copy()
            end[axes] = base[axes] + values
            pieces.append(straight([here, end]))
            here = end
        elif kind == "A":
            end = base + values[5:]
            pieces.append(_arc(here, end, values))
            here = end
        else:
            points = base + values.reshape(-1, 2)
            if kind in "ST":
                reflected = 2 * here - control if previous in ("CS" if kind == "S" else "QT") else here
                points = np.vstack([reflected, points])
            cubic = np.vstack([here, points])[None] if kind in "CS" else quadratic(here, *points)
            pieces.append(cubic)
            control, here = points[-2], points[-1]
        previous = kind
    finish(False)
    return strokes


def _commands(text: str) -> Iterator[tuple[str, np.ndarray]]:
    """Commands with one group of numbers each: the letter stands for repeated groups, a move's for lines."""
    at = 0
    text = text.rstrip().rstrip(",")
    while at < len(text):
        match = _LETTER.match(text, at)
        start = match.start(1) if match else at
        if not match or match[1].upper() not in _COUNT:
            raise ValueError(f"{text[start : start + 12]!r} at character {start} is no path command")
        command, at = match[1], match.end()
        count = _COUNT[command.upper()]
        if not count:
            yield command, np.zeros(0)
            continue
        while True:
            values = []
            for k in range(count):
                # The two flags of an arc may be written without anything between them and the next number.
                found = (_FLAG if command in "Aa" and k in (3, 4) else _NUMBER).match(text, at)
                if not found:
                    raise ValueError(f"path command {command!r} at character {start} has too few numbers")
                values.append(number(found[1]))
                at = found.end()
            yield command, np.array(values)
            command = {"M": "L", "m": "l"}.get(command, command)
            if at >= len(text) or not _NUMBER.match(text, at):
                break


def _arc(start: np.ndarray, end: np.ndarray, values: np.ndarray) -> Run:
    """An arc from its ends, radii, turn and flags, by SVG 1.1, appendix F.6."""
    radii, turn = np.abs(values[:2]), np.radians(values[2])
    if not radii.min() > 0 or (start == end).all():
        return straight([start, end])
    c, s = np.cos(turn), np.sin(turn)
    axes = np.array([[c, s], [-s, c]])
    half = axes @ (start - end) / 2 / radii  # half the chord, where the ellipse is the unit circle
    reach = float(half @ half)
    if not np.isfinite(reach):
        return straight([start, end])
    if reach > 1:  # radii too small for the ends grow until they fit
        radii, half, reach = radii * np.sqrt(reach), half / np.sqrt(reach), 1.0
    side = 1.0 if (values[3] != 0) != (values[4] != 0) else -1.0
    centre = side * np.sqrt(max(0.0, 1 / reach - 1)) * np.array([half[1], -half[0]])
    first, last = half - centre, -half - centre
    begin = float(np.arctan2(first[1], first[0]))
    sweep = float(np.arctan2(last[1], last[0])) - begin
    sweep = sweep % (2 * np.pi) if values[4] else -(-sweep % (2 * np.pi))
    run = elliptic_arc(
        (start + end) / 2 + (centre * radii) @ axes, axes[0] * radii[0], axes[1] * radii[1], begin, begin + sweep
    )
    run[0, 0], run[-1, 3] = start, end
    return run
