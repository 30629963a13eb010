"""Scenes, poses and heat maps drawn with matplotlib, in one style."""

from collections.abc import Iterable, Sequence

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import ArrayLike

import geoanalogy as ga

from .studies.heat import HeatMap

INK = "#20242b"
WALL = "#3c434d"
FLOOR = "#f5f4f0"
FURNITURE = "#d9d5ca"
EXAMPLE = "#c8102e"
RESULT = "#1f6fb4"
SECOND = "#2e8b57"
POOR = "#8a8f98"
HEAT = LinearSegmentedColormap.from_list("heat", ["#fbfaf7", "#fde3b5", "#f9a54b", "#d9431e", "#7a0c14"])

plt.rcParams.update(
    {
        "font.size": 8,
        "font.family": "DejaVu Sans",
        "axes.titlesize": 8.5,
        "axes.edgecolor": WALL,
        "axes.linewidth": 0.7,
        "text.color": INK,
        "axes.labelcolor": INK,
        "xtick.color": INK,
        "ytick.color": INK,
        "figure.dpi": 150,
        "savefig.dpi": 150,
    }
)


def canvas(columns: int, rows: int = 1, width: float = 7.5, height: float = 3.0, **options):
    """A figure of plain panels of equal scale.

    Parameters
    ----------
    columns, rows : int
    width, height : float
        Inches.
    **options
        Of `matplotlib.pyplot.subplots`.

    Returns
    -------
    figure : Figure
    panels : ndarray of Axes, shape (rows, columns)
    """
    figure, panels = plt.subplots(
        rows, columns, figsize=(width, height), squeeze=False, layout="constrained", **options
    )
    for ax in panels.flat:
        ax.set_aspect("equal")
        ax.axis("off")
    return figure, panels


def ring(ax: Axes, points: ArrayLike, **style) -> None:
    """A closed outline; `style` as of a matplotlib patch."""
    p = np.asarray(points, dtype=np.float64)
    style = {"facecolor": "none", "edgecolor": INK, "linewidth": 0.8, "joinstyle": "miter"} | style
    ax.add_patch(PathPatch(Path(np.vstack([p, p[:1]]), closed=True), **style))


def scene(ax: Axes, shown: ga.Scene, rooms: Iterable[str], floor: str = FLOOR, names: bool = False) -> None:
    """Rooms as floors with walls, what stands in them as furniture."""
    places = set(rooms)
    for polygon in shown.polygons:
        if polygon.id in places:
            ring(ax, polygon.points, facecolor=floor, edgecolor="none", zorder=1)
            ring(ax, polygon.points, edgecolor=WALL, linewidth=1.6, zorder=4)
    for polygon in shown.polygons:
        if polygon.id not in places:
            ring(ax, polygon.points, facecolor=FURNITURE, edgecolor=INK, linewidth=0.6, zorder=3)
            if names:
                wide, high = polygon.bounds[2:] - polygon.bounds[:2]
                style = {"ha": "center", "va": "center", "fontsize": 5, "rotation": 90 if high > 1.3 * wide else 0}
                ax.text(*polygon.centroid, polygon.label, zorder=6, **style)
    fit(ax, shown.bounds)


def fit(ax: Axes, bounds: Sequence[float], margin: float = 0.03) -> None:
    """Show a box (x0, y0, x1, y1) and a little around it."""
    x0, y0, x1, y1 = bounds
    m = margin * max(x1 - x0, y1 - y0)
    ax.set_xlim(x0 - m, x1 + m)
    ax.set_ylim(y0 - m, y1 + m)


def heat(ax: Axes, maps: Iterable[HeatMap], top: float | None = None) -> None:
    """Accumulated level sets behind a scene, darkest at `top` (None: the greatest value)."""
    maps = list(maps)
    top = top or max(float(np.nanmax(m.values)) for m in maps)
    for m in maps:
        picture = ax.imshow(
            m.values, extent=m.extent, origin="lower", cmap=HEAT, vmin=0, vmax=top, zorder=2, interpolation="bilinear"
        )
        picture.set_clip_path(Path(np.vstack([m.outline, m.outline[:1]]), closed=True), ax.transData)


def piece(ax: Axes, pose: ga.Pose, footprint: ArrayLike, colour: str = RESULT, scale: float = 1.0, **style) -> None:
    """An object at a pose: its outline, and a wedge that shows where it faces."""
    outline = np.asarray(footprint) * scale
    width = style.pop("linewidth", 1.1)
    filling = style.pop("fill", 0.18)
    order = style.pop("zorder", 5)
    ring(ax, pose.to_scene(outline), facecolor=colour, alpha=filling, edgecolor="none", zorder=order)
    ring(ax, pose.to_scene(outline), edgecolor=colour, linewidth=width, zorder=order, **style)
    front, half = outline[:, 0].max(), 0.22 * min(np.ptp(outline, axis=0))
    wedge = [(front, 0), (front - 1.4 * half, half), (front - 1.4 * half, -half)]
    ring(ax, pose.to_scene(wedge), facecolor=colour, edgecolor="none", zorder=order)


def note(ax: Axes, at: Sequence[float], text: str, **style) -> None:
    """A word on a light ground."""
    style = {"ha": "center", "va": "center", "fontsize": 6, "zorder": 9} | style
    ax.text(*at, text, bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.75}, **style)


def title(ax: Axes, text: str) -> None:
    """A caption above a panel."""
    ax.set_title(text, loc="left", fontsize=7.5, pad=3)
