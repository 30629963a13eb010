"""Draw figures 3.8 to 3.12 into docs/figures, from the same runs as `regions_comparison`.

    python -m benchmarks.regions_figures [NAME …]

Without names, all of them. A texture of the query is carried to every target, so that errors of the mapping show; where
a mapping has a confidence, the texture fades with it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import geoanalogy as ga
from geoanalogy.regions.view import transformation_space

from . import drawing as draw
from .figure_command import draw_those_named
from .regions_comparison import FOUND, LINKED, UNITS, correspondences, linked, methods, run
from .regions_scenes import SCENES, Array, Scene
from .studies import affine_strokes, limitations

#: Cells of a texture along the longer side of the query, and pairs of its squares.
CELLS, SQUARES = 90, 9

#: Colours of the query, of targets, and of the texture's squares.
QUERY, TARGET = "#1d8a3a", "#c8102e"
TEXTURE = np.array([(0.96, 0.78, 0.25), (0.13, 0.45, 0.66)])


def lines(ax: Axes, case: Scene) -> None:
    """The lines of a drawing."""
    ax.add_collection(LineCollection(case.lines, colors=draw.INK, linewidths=0.7, zorder=4))
    every = np.vstack(case.lines)
    draw.fit(ax, (*every.min(0), *every.max(0)))


def region(ax: Axes, ring: Array, colour: str) -> None:
    """A region as a pale fill, under what is painted on it."""
    draw.ring(ax, ring, facecolor=colour, alpha=0.2, edgecolor="none", zorder=2)
    draw.ring(ax, ring, edgecolor=colour, linewidth=0.9, zorder=3)


def texture(
    ax: Axes, shape: shapely.Geometry, mapping: Callable[[Array], Array], trust: Callable[[Array], Array] | None = None
) -> None:
    """A chequered texture on a shape of the query, where a mapping takes it."""
    x0, y0, x1, y1 = shape.bounds
    step = max(x1 - x0, y1 - y0) / CELLS
    x, y = np.arange(x0, x1, step), np.arange(y0, y1, step)
    low = np.stack(np.meshgrid(x, y), 2).reshape(-1, 2)
    low = low[shapely.contains_xy(shape, *(low + step / 2).T)]
    corners = low[:, None] + step * np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    square = np.floor((low - (x0, y0)) / (step * CELLS) * 2 * SQUARES).astype(int).sum(1) % 2
    colour = TEXTURE[square] * (0.75 + 0.25 * ((low[:, :1] - x0) / (x1 - x0)))
    if trust is not None:
        # Paler, not clearer: cells of a folded mapping lie over each other.
        colour = 1.0 + (colour - 1.0) * np.clip(trust(low + step / 2), 0.08, 1.0)[:, None]
    cells = mapping(corners.reshape(-1, 2)).reshape(-1, 4, 2)
    ax.add_collection(PolyCollection(cells, facecolors=colour, edgecolors=colour, linewidths=0.2, zorder=2.5))


def shape_of(case: Scene) -> shapely.Geometry:
    """What is painted in a query."""
    return shapely.make_valid(shapely.Polygon(case.outline))


def identity(points: Array) -> Array:
    """Where the query itself lies."""
    return points


def figure_3_08() -> Figure:
    """The transformation space of three fish among waves, and B.1 to B.4: what belongs to a match is in its colour."""
    case = SCENES["shoal"]()
    drawing = ga.Drawing(case.lines)
    matches = ga.match_regions(drawing, case.query)
    space = transformation_space(drawing, matches)
    figure = draw.plt.figure(figsize=(10.0, 3.6), layout="constrained")
    grid = figure.add_gridspec(2, 4, width_ratios=(1.3, 1.0, 1.0, 1.6))
    ax = figure.add_subplot(grid[:, 0])
    ax.set_aspect("equal")
    ax.axis("off")
    lines(ax, case)
    region(ax, case.query, QUERY)
    colours = [draw.plt.get_cmap("tab10")(k) for k in (3, 0, 1, 4, 5, 6)]
    for k, match in enumerate(matches):
        draw.ring(ax, match.map(case.outline), edgecolor=colours[k % len(colours)], linewidth=1.6, zorder=5)
    draw.title(ax, f"{len(space.match)} correspondences, {space.inliers:.1%} of a match")
    order = np.argsort(space.magnitude)
    order = np.concatenate([order[space.match[order] < 0], order[space.match[order] >= 0]])
    shade = np.array([(1.0 - 0.85 * m,) * 3 for m in space.magnitude])
    for k in range(len(matches)):
        shade[space.match == k] = colours[k % len(colours)][:3]
    right, up = space.translation.T
    turn, grown = np.degrees(space.rotation), np.log2(space.scale)
    parameters = {"translation x": right, "translation y": up, "scale (log2)": grown, "rotation (°)": turn}
    for place, (name, values) in zip(((0, 1), (1, 1), (0, 2), (1, 2)), parameters.items(), strict=True):
        ax = figure.add_subplot(grid[place])
        ax.scatter(space.query_point[order, 0], values[order], c=shade[order], s=2.0, linewidths=0)
        ax.set_xticks([])
        ax.tick_params(labelsize=6)
        draw.title(ax, f"{name} over the query's x")
    ax = figure.add_subplot(grid[:, 3], projection="3d")
    ax.scatter(right[order], up[order], turn[order], c=shade[order], s=2.5, linewidths=0, depthshade=False)
    for axis, text in zip("xyz", ("translation x", "translation y", "rotation (°)"), strict=True):
        getattr(ax, f"set_{axis}label")(text, fontsize=7, labelpad=-6)
    ax.tick_params(labelsize=5, pad=-3)
    return figure


def figure_3_09() -> Figure:
    """Regions beside other methods, the input at the left and the truth at the right."""
    shown = [m for m in ("L2E", "ACC", "CPD", "ours") if m in methods()]
    figure, panels = draw.canvas(len(shown) + 2, len(SCENES), 10.5, 1.75 * len(SCENES))
    for row, (name, build) in zip(panels, SCENES.items(), strict=True):
        case = build()
        shape = shape_of(case)
        lines(row[0], case)
        region(row[0], case.query, QUERY)
        texture(row[0], shape, identity)
        draw.title(row[0], f"{name}: query")
        for ax, method in zip(row[1:], shown, strict=False):
            outcome = run(method, case)
            lines(ax, case)
            for mapping in dict.fromkeys(m for m in outcome.best if m is not None):
                texture(ax, shape, mapping)
                draw.ring(ax, mapping(case.outline), edgecolor=TARGET, linewidth=0.8, zorder=5)
            draw.title(ax, f"{method}: {outcome.found} of {len(case.targets)} within {FOUND:g} %")
        lines(row[-1], case)
        for target in case.targets:
            texture(row[-1], shape, target)
        draw.title(row[-1], "truth")
    return figure


def figure_3_10() -> Figure:
    """The projection error in place of the TPS: sets of correspondences as linkage leaves them."""
    ways: list[float | None] = [*UNITS, None]
    figure, panels = draw.canvas(len(ways), len(LINKED), 9.0, 1.9 * len(LINKED))
    for row, build in zip(panels, LINKED.values(), strict=True):
        case = build()
        drawing, _, nodes, refined = correspondences(case)
        source = drawing.out_of_frame(nodes.at[refined.node])
        image = drawing.out_of_frame(np.where(refined.mirrored, np.conj(refined.image), refined.image))
        for ax, unit in zip(row, ways, strict=True):
            lines(ax, case)
            region(ax, case.query, QUERY)
            found = linked(case, unit)
            off = [[case.error(one.map(case.points), t) for one in found] for t in case.targets]
            for k, errors in enumerate(off):
                best = found[int(np.argmin(errors))]
                colour = (TARGET, draw.RESULT)[k % 2]
                at = np.stack([source[best.members], image[best.members]], 1)
                ax.add_collection(LineCollection(at, colors=colour, linewidths=0.5, alpha=0.7, zorder=6))
                ax.plot(*image[best.members].T, ".", color=colour, markersize=2.5, zorder=7)
            text = "TPS" if unit is None else f"projection error, unit {100 * unit:g} %"
            draw.title(ax, f"{text}: {', '.join(f'{min(e):.1f} %' for e in off)}")
    return figure


def figure_3_11() -> Figure:
    """Pairs of correspondences whose projection error is zero though their transformations differ."""
    figure = draw.plt.figure(figsize=(8.0, 3.2), layout="constrained")
    left, right = figure.add_subplot(1, 2, 1, projection="3d"), figure.add_subplot(1, 2, 2)
    bar, fish = affine_strokes.bar(), affine_strokes.fish()
    for faces, colour in zip(bar.shapes, (QUERY, TARGET), strict=True):
        left.add_collection3d(Poly3DCollection(faces, facecolor=colour, alpha=0.25, edgecolor=draw.INK, linewidth=0.4))
    for a, b in bar.pairs:
        left.plot(*np.stack([a, b]).T, ":", color=draw.RESULT, linewidth=1.6)
    every = np.concatenate([np.concatenate(list(faces)) for faces in bar.shapes])
    for axis, low, high in zip("xyz", every.min(0), every.max(0), strict=True):
        getattr(left, f"set_{axis}lim")(low, high)
    left.set_box_aspect(np.ptp(every, axis=0))
    left.set_axis_off()
    left.view_init(24, -62)
    right.set_aspect("equal")
    right.axis("off")
    for shape, colour in zip(fish.shapes, (QUERY, TARGET), strict=True):
        for line in shape:
            right.plot(*line.T, color=draw.INK, linewidth=0.8)
        draw.ring(right, shape[0], facecolor=colour, alpha=0.18, edgecolor="none")
    for a, b in fish.pairs:
        right.plot(*np.stack([a, b]).T, ":", color=draw.RESULT, linewidth=1.6)
    for ax, study, what in ((left, bar, "rotation about the axis"), (right, fish, "vertical scale")):
        error, gap = study.projection_error, study.difference
        draw.title(ax, f"projection error {error:.2f}; {what}: {gap:.1f} units apart")
    return figure


def figure_3_12() -> Figure:
    """Limitations; the texture fades where the mapping has little confidence."""
    figure, panels = draw.canvas(2, 4, 6.4, 7.2)
    shown = [("horses", {}), ("flowers", {}), ("joint", {}), ("joint", {"joint_tolerance": 1.0})]
    for row, letter, (name, options) in zip(panels, "abcc", shown, strict=True):
        limitation = limitations.CASES[name]()
        case, outcome = limitation.case, limitations.run(limitation, **options)
        shape = limitations.painted(name)
        own = len(case.lines) // 2
        for ax, part in zip(row, (case.lines[:own], case.lines[own:]), strict=True):
            ax.add_collection(LineCollection(part, colors=draw.INK, linewidths=0.8, zorder=4))
            every = np.vstack(part)
            draw.fit(ax, (*every.min(0), *every.max(0)), 0.08)
        texture(row[0], shape, identity)
        region(row[0], case.query, QUERY)
        texture(row[1], shape, outcome.map, outcome.confidence)
        tolerance = f", joint tolerance {options['joint_tolerance']:g}" if options else ""
        draw.title(row[0], f"({letter}) {name}{tolerance}: similarity {outcome.similarity:.2f}")
        draw.title(row[1], "; ".join(f"{k} {e:.1f} %" for k, e in outcome.errors.items()))
    return figure


if __name__ == "__main__":
    draw_those_named(__doc__, globals())
