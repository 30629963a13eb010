"""Draw figures 5.4 and 5.10 to 5.13, and windows drawn by eye, into docs/figures.

    python -m benchmarks.placements_figures [NAME …]

Without names, all of them.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import geoanalogy as ga
from geoanalogy.placements.signature import BOX, PARENT_BOX

from . import drawing as draw
from .figure_command import draw_those_named
from .peers.sample_models import SampleModels
from .studies import arrangements
from .studies.arrangements import Arrangement

#: Step of the heat maps, scene units.
STEP = 0.1


def shown_in(ax: Axes, case: Arrangement, floor: str = draw.FLOOR, examples: int | None = None) -> None:
    """The scene, and its first few examples or all."""
    draw.scene(ax, case.scene, [str(p.id) for p in case.scene.polygons if p.label == case.label], floor, names=False)
    for r in case.shown[:examples]:
        draw.ring(ax, r.ring, edgecolor=draw.EXAMPLE, facecolor=draw.EXAMPLE, alpha=0.75, zorder=6)


def placed(ax: Axes, found: list[ga.Placement], by_score: bool = False) -> None:
    """Results; the surer the darker where that is asked for."""
    for p in found[::-1]:
        colour = draw.HEAT(0.15 + 0.7 * p.score) if by_score else draw.RESULT
        draw.ring(ax, p.rectangle.ring, facecolor=colour, alpha=0.45, edgecolor="none", zorder=5)
        draw.ring(ax, p.rectangle.ring, edgecolor=colour, linewidth=1.0, zorder=6)


def heat(ax: Axes, case: Arrangement, sample: int, tau: float = 1.0) -> None:
    """Target values of one sample model in all parents (section 5.5)."""
    models = SampleModels(case.scene, case.label, case.shown, tau)
    for parent in (p for p in case.scene.polygons if p.label == case.label):
        low, high = parent.points.min(axis=0), parent.points.max(axis=0)
        x, y = (np.arange(low[a] + STEP / 2, high[a], STEP) for a in (0, 1))
        at = np.stack(np.meshgrid(x, y), axis=-1)
        values = models.predicted(sample, parent, at.reshape(-1, 2)).reshape(at.shape[:2])
        extent = (low[0], high[0], low[1], high[1])
        ax.imshow(values, extent=extent, origin="lower", cmap=draw.HEAT, vmin=0, vmax=1, zorder=2)


def figure_5_04() -> Figure:
    """Balconies: the heat map of a sample, all candidates by score, and what passes the threshold."""
    case = arrangements.balconies()
    model = case.learned()
    figure, panels = draw.canvas(3, 1, 9.5, 2.2)
    shown_in(panels[0, 0], case, "none")
    heat(panels[0, 0], case, 0)
    draw.title(panels[0, 0], "target of the lower left sample")
    for ax, threshold, text in zip(
        panels[0, 1:], (0.05, None), ("candidates by score", "default threshold"), strict=True
    ):
        shown_in(ax, case)
        placed(ax, model.place(case.scene, threshold), by_score=True)
        draw.title(ax, text)
    return figure


def _compared(cases: list[tuple[str, Arrangement, int | None]], width: float, height: float) -> Figure:
    figure, panels = draw.canvas(len(cases), 1, width, height)
    for ax, (text, case, count) in zip(panels.flat, cases, strict=True):
        shown_in(ax, case, examples=count)
        placed(ax, case.learned(count).place(case.scene))
        draw.title(ax, text)
    return figure


def figure_5_10_a() -> Figure:
    """A balcony adapts its width to the facade."""
    case = arrangements.wide_balconies()
    return _compared([("one example", case, 1), ("two examples", case, None)], 7.5, 1.8)


def figure_5_10_b() -> Figure:
    """A second example tells that the window matters and not the door."""
    case = arrangements.flower_boxes()
    return _compared([("one example: below a window, above a door", case, 1), ("two examples", case, None)], 7.5, 1.9)


def figure_5_10_c() -> Figure:
    """A second example tells whether doors keep their size."""
    keeping, adapting = arrangements.doors(False), arrangements.doors(True)
    return _compared(
        [("one example", keeping, 1), ("doors of one size", keeping, None), ("doors that adapt", adapting, None)],
        9.5,
        1.7,
    )


def figure_5_11() -> Figure:
    """What is learned of a mirror between basin and lamp, in words and weights."""
    case = arrangements.mirrors()
    model = case.learned()
    figure, panels = draw.canvas(1, 2, 7.5, 3.6)
    shown_in(panels[0, 0], case)
    placed(panels[0, 0], model.place(case.scene))
    names = {"lamp": "lamp", "basin": "basin", "": "wall"}
    edges = ("left edge", "centre", "right edge")
    ways = ("from its left edge", "from its right edge", "from its centre", "as a share of its width")
    ax = panels[1, 0]
    ax.axis("on")
    ax.set_aspect("auto")
    for row, (label, name) in enumerate(names.items()):
        key = BOX + label if label else PARENT_BOX
        weight = model.lesson.agreement(key, len(case.shown))[:, 0].mean(axis=0)[0]
        for column, way in enumerate(ways):
            for i, edge in enumerate(edges):
                x, y = column + (i - 1) * 0.3, -row
                ax.add_patch(
                    draw.plt.Rectangle(
                        (x - 0.13, y - 0.3), 0.26, 0.5, facecolor=draw.HEAT(weight[i, column]), ec=draw.INK, lw=0.4
                    )
                )
                ax.text(
                    x,
                    y - 0.05,
                    f"{weight[i, column]:.2f}",
                    ha="center",
                    va="center",
                    fontsize=5.5,
                    color="white" if weight[i, column] > 0.6 else draw.INK,
                )
                if not row:
                    ax.text(x, 0.3, edge, ha="center", fontsize=5)
            if not row:
                ax.text(column, 0.55, way, ha="center", fontsize=6.5)
        ax.text(-0.6, -row - 0.05, name, ha="right", va="center", fontsize=7)
    ax.set_xlim(-1, len(ways) - 0.4)
    ax.set_ylim(-len(names) + 0.4, 0.8)
    ax.axis("off")
    draw.title(ax, "agreement of the examples in each horizontal relation of the mirror")
    return figure


def figure_5_12() -> Figure:
    """The kernel size: what a small one tells apart is the same to a large one."""
    case = arrangements.entrances()
    figure, panels = draw.canvas(1, 3, 7.5, 5.2)
    for ax, tau in zip(panels.flat, (0.3, 1.0, 3.0), strict=True):
        shown_in(ax, case, "none")
        heat(ax, case, 0, tau)
        model = case.learned(tau=tau)
        found = model.place(case.scene, 0.01)
        for parent in ("c", "d"):
            p = min((p for p in found if p.parent.id == parent), key=lambda p: p.novelty)
            draw.ring(ax, p.rectangle.ring, edgecolor=draw.RESULT, linewidth=1.2, zorder=7)
            draw.note(ax, (p.rectangle.x + 2, p.rectangle.y), f"similarity\n{1 - p.novelty:.2f}")
        draw.title(ax, f"τ = {tau:g}")
    return figure


def figure_5_13() -> Figure:
    """A house of two floors is new to what was taught on one."""
    case = arrangements.floors()
    figure, panels = draw.canvas(1, 1, 9.5, 2.3)
    ax = panels[0, 0]
    shown_in(ax, case)
    found = case.learned().place(case.scene)
    placed(ax, found)
    for p in found:
        text = f"score {p.score:.2f}\nnovelty {p.novelty:.2f}"
        draw.note(ax, (p.rectangle.x + 3.2, p.rectangle.y), text, fontsize=5)
    return figure


def figure_windows_by_eye() -> Figure:
    """Windows drawn by eye on a plain facade: a row, one with a gap, and two rows."""
    cases = [
        ("a row", ((0, 1), (1, 1), (2, 1))),
        ("one is left out", ((0, 1), (1, 1), (3, 1))),
        ("two rows", ((0, 1), (1, 1), (1, 0), (2, 0))),
    ]
    return _compared([(text, arrangements.windows_by_eye(places), None) for text, places in cases], 9.5, 1.7)


if __name__ == "__main__":
    draw_those_named(__doc__, globals())
