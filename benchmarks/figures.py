"""Draw the studies of section 4.9 into docs/figures.

    python -m benchmarks.figures [NAME …]

Without names, all of them.
"""

import numpy as np
import shapely
from scipy.ndimage import distance_transform_edt

import geoanalogy as ga

from . import drawing as draw
from .figure_command import draw_those_named
from .studies import (
    accumulation,
    deck,
    difficulty,
    distance_importance,
    importance_terms,
    labels,
    noise,
    order,
    relation_shares,
    shape_matching,
)
from .studies.bathrooms import ROOMS as BATHROOMS
from .studies.bathrooms import SCENE as BARE_BATHROOMS
from .studies.heat import HeatMap, heat_maps


def figure_4_02():
    figure, panels = draw.canvas(1, 2, 7.5, 4.0)
    model, placed = deck.by_relations()
    shown = {"local coordinates": deck.by_local_coordinates(), "relations": placed}
    for ax, (title, answer) in zip(panels.flat, shown.items(), strict=True):
        if title == "relations":
            draw.heat(ax, heat_maps(model, deck.SCENE))
        draw.scene(
            ax, deck.SCENE, ["source", "target"], floor="none" if title == "relations" else draw.FLOOR, names=True
        )
        draw.piece(ax, deck.SOURCE, deck.BENCH, draw.EXAMPLE)
        draw.piece(ax, answer.pose, deck.BENCH, draw.RESULT)
        draw.title(ax, f"{title}: {answer.error:.2f} m from its place")
    return figure


def figure_4_13():
    figure, panels = draw.canvas(2, 2, 7.5, 4.1)
    titles = {"a": "both constant", "b": "$I_m$ constant", "c": "$I_l$ constant", "d": "$I_l$ and $I_m$"}
    rooms = [p.id for p in importance_terms.SCENE.polygons]
    for ax, (name, title) in zip(panels.flat, titles.items(), strict=True):
        case = importance_terms.run(name)
        draw.heat(ax, heat_maps(case.model, importance_terms.SCENE), 1.0)
        draw.scene(ax, importance_terms.SCENE, rooms, floor="none")
        draw.piece(ax, importance_terms.SOURCE, importance_terms.BED, draw.EXAMPLE, linewidth=1.5)
        for result, good in case.leading:
            draw.piece(ax, result.pose, importance_terms.BED, draw.RESULT if good else draw.POOR, fill=0.25)
        draw.title(ax, f"({name}) {title}: {len(case.poor)} poor places among the best {len(case.leading)}")
    return figure


def figure_4_14():
    steps = relation_shares.run()
    figure, panels = draw.canvas(len(BATHROOMS), len(steps), 7.5, 8.2, gridspec_kw={"hspace": 0.02, "wspace": 0.02})
    for row, step in zip(panels, steps, strict=True):
        found = {r.parent.id: r for r in step.results}
        for ax, room in zip(row, BATHROOMS, strict=True):
            shown = step.before.polygon(room)
            draw.scene(ax, ga.Scene([shown, *step.before.members_of(room)]), [room])
            x0, y0, _, y1 = shown.bounds
            draw.fit(ax, (x0, y0 - 0.15, x0 + 5.2, max(y1, y0 + 3.5)))
            if room == "source":
                draw.piece(ax, step.edit.pose, step.edit.footprint, draw.EXAMPLE)
                _bars(ax, relation_shares.asked(step), draw.EXAMPLE)
                draw.title(ax, step.edit.label)
            elif room in found:
                draw.piece(ax, found[room].pose, step.edit.footprint)
                _bars(ax, relation_shares.shares(found[room]), draw.RESULT)
                draw.title(ax, f"importance {found[room].importance:.2f}")
    return figure


SHORT = {
    "boundary distance": "bd",
    "segment distance": "sd",
    "segment arc length": "sl",
    "corner distance": "cd",
    "corner ratio": "cr",
    "centroid direction": "cen",
}


def _bars(ax, shares: dict[str, float], colour: str) -> None:
    """Shares of importance as bars at a room's right side."""
    bars = ax.inset_axes((0.78, 0.12, 0.22, 0.55))
    bars.barh(range(len(shares)), list(shares.values()), color=colour, height=0.7)
    bars.set_yticks(range(len(shares)), [SHORT[name] for name in shares], fontsize=5)
    bars.set_xticks([])
    bars.set_xlim(0, 0.42)
    bars.tick_params(length=0, pad=1)
    bars.invert_yaxis()
    bars.patch.set_alpha(0.85)
    for side in ("top", "right", "bottom"):
        bars.spines[side].set_visible(False)


def figure_4_15():
    figure, panels = draw.canvas(1, 2, 7.5, 5.0)
    runs = {name: order.run(name) for name in order.ORDERS}
    differ = order.differences(*runs.values())
    for ax, (name, steps) in zip(panels.flat, runs.items(), strict=True):
        draw.scene(ax, BARE_BATHROOMS, BATHROOMS)
        for letter, step in steps.items():
            draw.piece(ax, step.edit.pose, step.edit.footprint, draw.EXAMPLE)
            draw.note(ax, step.edit.pose.position, letter)
            for result in step.results:
                other = (letter, result.parent.id) in differ
                draw.piece(ax, result.pose, step.edit.footprint, linewidth=2.2 if other else 0.9)
                draw.note(ax, result.pose.position, letter, weight="bold" if other else "normal")
        draw.title(ax, f"in the order {', '.join(name)}")
    return figure


def figure_4_16():
    figure, panels = draw.canvas(2, 1, 7.5, 2.9)
    for ax, used in zip(panels.flat, (False, True), strict=True):
        model, results = labels.run(used)
        draw.heat(ax, heat_maps(model, labels.SCENE))
        draw.scene(ax, labels.SCENE, labels.ROOMS, floor="none", names=True)
        draw.piece(ax, labels.SOURCE, labels.NIGHT_TABLE, draw.EXAMPLE, linewidth=1.5)
        for result in results:
            draw.piece(ax, result.pose, labels.NIGHT_TABLE, linewidth=0.5 + 1.5 * result.importance)
        draw.title(ax, f"{'with' if used else 'without'} labels: {len(results)} places above {labels.THRESHOLD}")
    return figure


def figure_4_17():
    figure, panels = draw.canvas(2, 2, 7.5, 3.7, height_ratios=(3, 2))
    sequence = accumulation.sequences()
    for column, mode in zip(panels.T, accumulation.MODES, strict=True):
        step, there = accumulation.televisions(mode)
        bounds = accumulation.SCENE.polygon("far").bounds
        draw.scene(column[0], accumulation.SCENE, accumulation.ROOMS, floor="none")
        draw.heat(column[0], heat_maps(step.model, accumulation.SCENE), 0.6)
        for result, colour in zip(there, (draw.RESULT, draw.SECOND), strict=False):
            draw.piece(column[0], result.pose, accumulation.TELEVISION, colour, linewidth=1.6)
        draw.fit(column[0], bounds)
        draw.title(column[0], f"{mode}: {len(there)} answer{'s' * (len(there) > 1)} where the level sets meet")
        draw.scene(column[1], accumulation.SCENE, accumulation.ROOMS)
        for step in sequence[mode]:
            draw.piece(column[1], step.edit.pose, step.edit.footprint, draw.EXAMPLE, linewidth=0.8)
            for result in step.results:
                draw.piece(column[1], result.pose, step.edit.footprint, linewidth=0.8)
        draw.title(column[1], "all six edits")
    return figure


def figure_4_18():
    figure, panels = draw.canvas(4, 4, 7.5, 7.6)
    for row, (name, build) in zip(panels, shape_matching.ROWS.items(), strict=True):
        case = build()
        draw.scene(row[0], case.scene, ["source", "target"])
        draw.piece(row[0], case.source, case.footprint, draw.EXAMPLE)
        draw.fit(row[0], case.scene.polygon("source").bounds)
        draw.title(row[0], name)
        for ax, method in zip(row[1:], shape_matching.METHODS, strict=True):
            answer = shape_matching.run(case, method)
            room = case.scene.polygon("target")
            draw.scene(ax, case.scene, ["source", "target"], floor="none")
            if method == "SC B-spline":
                _deformed_grid(ax, case, answer.detail)
            elif method == "SC inner":
                _quality(ax, answer.detail, room.points)
            else:
                draw.heat(ax, [m for m in heat_maps(answer.detail, case.scene) if m.outline is room.points])
            draw.piece(ax, case.intended, case.footprint, draw.INK, fill=0, linewidth=0.8, linestyle=(0, (2, 1.5)))
            draw.piece(ax, answer.pose, case.footprint, draw.RESULT, linewidth=1.4)
            draw.fit(ax, room.bounds, 0.08)
            draw.title(ax, f"{method}: {answer.error:.2f} m, {np.degrees(answer.turn):.0f}°")
    return figure


def _deformed_grid(ax, case, registration) -> None:
    """The coordinates of the source room where the one-to-one mapping takes them: x in red, y in green."""
    x0, y0, x1, y1 = case.scene.polygon("source").bounds
    steps = np.linspace(0, 1, 90)
    for share in np.linspace(0, 1, 16):
        for line, colour in (
            (np.stack([np.full(90, x0 + share * (x1 - x0)), y0 + steps * (y1 - y0)], 1), "#c0504d"),
            (np.stack([x0 + steps * (x1 - x0), np.full(90, y0 + share * (y1 - y0))], 1), "#5a9a4b"),
        ):
            inside = shapely.intersects_xy(case.scene.polygon("source").shape, *line.T)
            mapped = np.where(inside[:, None], registration(line), np.nan)
            ax.plot(*mapped.T, color=colour, linewidth=0.6, zorder=2)


def _quality(ax, match, outline) -> None:
    """The best quality over the directions at each place."""
    spacing = float(np.diff(np.unique(match.points[:, 0].round(6))).min())
    low = match.points.min(axis=0)
    column, row = np.rint((match.points - low) / spacing).astype(int).T
    sheet = np.full((row.max() + 1, column.max() + 1), np.nan)
    sheet[row, column] = match.quality - match.quality.min()
    # Cells that the wall cuts take what is nearest.
    nearest = distance_transform_edt(np.isnan(sheet), return_distances=False, return_indices=True)
    sheet = np.pad(sheet[tuple(nearest)], 1, mode="edge")
    low = low - spacing
    high = low + spacing * np.array([sheet.shape[1] - 0.5, sheet.shape[0] - 0.5])
    low = low - spacing / 2
    draw.heat(ax, [HeatMap(outline, (low[0], high[0], low[1], high[1]), sheet)])


def figure_4_19():
    figure, panels = draw.canvas(2, 1, 7.5, 2.5)
    study = distance_importance
    for ax, weights in zip(panels.flat, ({}, {"chair": 0.0}), strict=True):
        model, best = study.run(weights)
        draw.heat(ax, heat_maps(model, study.SCENE))
        draw.scene(ax, study.SCENE, study.ROOMS, floor="none", names=True)
        draw.piece(ax, study.SOURCE, study.CHAIR, draw.EXAMPLE, linewidth=1.5)
        draw.piece(ax, best.pose, study.CHAIR, draw.RESULT, linewidth=1.5)
        draw.title(ax, "chairs are muted" if weights else "importance by distance alone")
    return figure


def figure_4_20():
    figure, panels = draw.canvas(3, 1, 7.5, 1.75, width_ratios=(1.0, 1.3, 1.3))
    for ax, (name, build) in zip(panels.flat, difficulty.SCENES.items(), strict=True):
        case, outcome = build(), difficulty.run(name)
        draw.heat(ax, heat_maps(outcome.model, case.scene, 900))
        draw.scene(ax, case.scene, ["source", "target"], floor="none")
        draw.piece(ax, case.source, case.footprint, draw.EXAMPLE)
        for result in outcome.results[:3]:
            draw.piece(ax, result.pose, case.footprint, linewidth=0.9)
        draw.piece(ax, case.intended, case.footprint, draw.INK, fill=0, linewidth=0.8, linestyle=(0, (2, 1.5)))
        for rank, result in enumerate(outcome.results[:3], 1):
            draw.note(ax, result.pose.position, str(rank), fontsize=5)
        draw.title(ax, f"{name}: rank {outcome.rank or '—'}, lead {outcome.lead:.2f}")
    return figure


def figure_4_21():
    figure, panels = draw.canvas(len(noise.LEVELS), 2, 7.5, 5.2)
    for column, level in zip(panels.T, noise.LEVELS, strict=True):
        clear = noise.run(level)
        with noise.features_by_the_letter():
            literal = noise.run(level)
        for ax, outcome in zip(column, (literal, clear), strict=True):
            draw.scene(ax, outcome.scene, ["source", "target"])
            if outcome.best is not None:
                good = outcome.error < 0.1
                draw.piece(ax, outcome.best.pose, noise.BED, draw.RESULT if good else draw.POOR)
            draw.fit(ax, (6.6, -0.3, 12.0, 6.4))
            draw.title(ax, f"{outcome.corners} corners, importance {outcome.importance:.2f}")
        column[0].annotate(
            f"noise {100 * level:g} cm", (0.5, 1.12), xycoords="axes fraction", ha="center", fontsize=8.5, weight="bold"
        )
    for ax, text in zip(panels[:, 0], ("section 4.3 by the letter", "corners that persist"), strict=True):
        ax.annotate(text, (-0.06, 0.5), xycoords="axes fraction", rotation=90, va="center", ha="right", fontsize=8.5)
    return figure


if __name__ == "__main__":
    draw_those_named(__doc__, globals())
