"""How far results of pose propagation move when the grid is shifted or refined, and what is lost when a plan turns."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sample_blends.edits import apartment as apartment_edits
from sample_blends.edits.recording import record, scene_of
from sample_blends.plans import apartment

from .measuring import Table
from .poses_speed import stages
from .studies import directions, grid

#: A result has moved where it is further off than this share of its room's size.
MOVED = 1e-3

#: A result that is worth less by more than this than in another direction of the plan has been lost there.
LOST = 0.005


def turned_table() -> Table:
    """The apartment's edits, however the plan lies."""
    plan = scene_of(apartment.plan())
    found = directions.best_results(stages(record(plan, apartment_edits.EDITS), plan))
    gaps = np.array([np.max(f.importance) - np.array(f.importance) for f in found])
    rows = [
        (f"{degrees:g}°", len(found), int((gaps[:, k] <= LOST).sum()), f"{gaps[:, k].mean():.4f}")
        for k, (degrees, _) in enumerate(directions.TURNS)
    ]
    kept = int((gaps <= LOST).sum())
    return Table(
        "The apartment, turned",
        ("turned by", "best results", f"within {LOST} of the best", "worth less on average"),
        rows,
        "The best result of all 26 edits in every room, all other objects in place, beside the best that is found in"
        f" any of these directions. {kept} of {gaps.size} are as good as in any.",
    )


def tables(full: bool = False) -> Iterator[Table]:
    """The tables of this benchmark."""
    rows = []
    still = total = 0
    for name, (scene, edit) in grid.cases().items():
        found = grid.movements(scene, edit)
        kept = sum(m.distance < MOVED for m in found)
        still, total = still + kept, total + len(found)
        furthest = max(m.distance for m in found)
        shown = f"{furthest:.4%}" if np.isfinite(furthest) else "another place"
        rows.append((name, len(found), kept, shown, f"{min(m.importance for m in found):.2f}"))
    yield Table(
        "The same edits on other grids",
        ("edit", "results", f"within {MOVED:.1%}", "furthest, by the room's size", "least importance"),
        rows,
        f"The best result in every room but the example's, on {len(grid.VARIANTS)} other grids: a quarter and four"
        " times as many cells, shifts by fractions of a cell, moves of the whole scene."
        f" {still} of {total} stay within {MOVED:.1%} of their room's size.",
    )
    yield turned_table()
