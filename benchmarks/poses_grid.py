"""How far the results of pose propagation move when the grid is shifted or refined."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .measuring import Table
from .studies import grid

#: A result has moved where it is further off than this share of its room's size.
MOVED = 1e-3


def tables(full: bool = False) -> Iterator[Table]:
    """The table of this benchmark."""
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
