"""Table 3.1 from known truth: ``python -m sample_blends.drawings.truth [scene …]``.

For the first edit of every picture, or with ``--all`` for every edit: how many refined correspondences there are, how
many of them lie on a place where the edit belongs (plain and weighted by their confidence), which of these places are
found of what is shown at first, by the automatic threshold, what else is shown, and how far off the found ones are.
"""

from __future__ import annotations

import argparse
import importlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import geoanalogy as ga
from geoanalogy.operations.region_transfer import region_of
from geoanalogy.regions.view import transformation_space

from . import SCENES
from .lines import Array, Warp
from .picture import Edit, Picture

#: Head of the table.
HEAD = (
    "| result | edit | correspondences | inliers | weighted | found | false | error |",
    "| --- | --- | --- | --- | --- | --- | --- | --- |",
)

#: The thesis's unit of the transformation space (section 3.2): of the drawing's diagonal; a factor; a turn.
UNIT = (0.03, np.log(1.25), np.radians(45.0))

#: Distance from the truth, as a share of the target's diagonal, below which a place counts as found.
FOUND = 0.1


@dataclass(frozen=True)
class Row:
    """What one edit gave.

    Attributes
    ----------
    count : int
        Refined correspondences.
    inliers, weighted : float
        Shares of them, and of their confidence, that lie on a true place.
    places, found, false : int
        True places, those that were found, and shown regions that are none.
    error : float
        Median distance from the truth inside the query, as a share of the target's diagonal, over all that were found.
    """

    scene: str
    edit: str
    count: int
    inliers: float
    weighted: float
    places: int
    found: int
    false: int
    error: float


def picture_of(scene: str) -> Picture:
    """The picture of a scene."""
    made: Picture = importlib.import_module(f"{__package__}.{scene}").picture()
    return made


def options_of(edit: Edit) -> ga.RegionOptions:
    """The options that an edit is matched with."""
    return ga.RegionOptions(query_kind="region" if edit.closed else "stroke", **edit.options)


def probes(edit: Edit) -> Array:
    """Points inside the query, where mappings are compared with the truth."""
    import shapely

    if not edit.closed:
        return np.asarray(edit.query)
    region = region_of(edit.query, options_of(edit)).buffer(-1e-3)
    x0, y0, x1, y1 = region.bounds
    grid = np.stack(np.meshgrid(np.linspace(x0, x1, 30), np.linspace(y0, y1, 30)), 2).reshape(-1, 2)
    inside = grid[shapely.contains_xy(region, grid[:, 0], grid[:, 1])]
    # The margin that a lasso leaves round a shape belongs to no line: what is painted matters.
    return inside[edit.paint(inside)[:, 3] > 0.5]


def errors(mapping: Warp, truth: Warp, at: Array) -> Array:
    """Distances from the truth, as shares of the target's diagonal."""
    there = truth(at)
    return np.linalg.norm(mapping(at) - there, axis=1) / np.linalg.norm(np.ptp(there, axis=0))


def measure(picture: Picture, edit: Edit) -> Row:
    """Match an edit of a picture, and compare with what is known."""
    drawing = ga.Drawing(picture.polylines)
    matches = ga.match_regions(drawing, edit.query, options_of(edit))
    at = probes(edit)
    off = np.array([[np.median(errors(m.map, t, at)) for t in edit.truth] for m in matches]).reshape(
        len(matches), len(edit.truth)
    )
    best = off.min(axis=0, initial=np.inf)
    hits = best < FOUND
    false = int((off.min(axis=1, initial=np.inf) >= FOUND).sum())
    space = transformation_space(drawing, matches)
    lies = inliers(space, edit.truth, float(np.linalg.norm(np.ptp(np.vstack(picture.polylines), axis=0))))
    total = max(float(space.magnitude.sum()), 1e-12)
    return Row(
        picture.name,
        edit.name,
        len(lies),
        float(lies.mean()) if len(lies) else 0.0,
        float(space.magnitude[lies].sum()) / total,
        len(edit.truth),
        int(hits.sum()),
        false,
        float(np.median(best[hits])) if hits.any() else float("nan"),
    )


def inliers(space: object, truth: Sequence[Warp], diagonal: float) -> np.ndarray:
    """Which correspondences lie on a true place: within one unit of the transformation space."""
    at = space.query_point
    nearest = np.full(len(at), np.inf)
    if not len(at):
        return nearest < 1.0
    step = 1e-4 * diagonal
    for warp in truth:
        there = warp(at)
        x, y = ((warp(at + d) - there) / step for d in ((step, 0.0), (0.0, step)))
        mirrored = x[:, 0] * y[:, 1] < x[:, 1] * y[:, 0]
        flip = np.where(mirrored, -1.0, 1.0)
        a = (x[:, 0] + flip * y[:, 1] + 1j * (x[:, 1] - flip * y[:, 0])) / 2.0
        gap = np.linalg.norm(space.target - there, axis=1) / (UNIT[0] * diagonal)
        # A reflection turns the other way round before it is reflected.
        turn = np.where(mirrored, -np.angle(a), np.angle(a)) - space.rotation
        turn = np.angle(np.exp(1j * turn)) / UNIT[2]
        grow = np.log(np.abs(a) / space.scale) / UNIT[1]
        unit = np.sqrt(gap**2 + turn**2 + grow**2)
        nearest = np.where(mirrored == space.mirrored, np.minimum(nearest, unit), nearest)
    return nearest < 1.0


def written(document: Path, rows: Sequence[str]) -> str:
    """A document with the rows in place of those of its table."""
    lines = document.read_text(encoding="utf-8").splitlines()
    start = lines.index(HEAD[0])
    end = next(i for i in range(start, len(lines) + 1) if i == len(lines) or not lines[i].startswith("|"))
    return "\n".join([*lines[:start], *HEAD, *rows, *lines[end:]]) + "\n"


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=SCENES)
    parser.add_argument("--all", action="store_true", help="all edits, not the first of each picture alone")
    parser.add_argument("--document", type=Path, help="write the table into this document, in place of its own")
    arguments = parser.parse_args()
    print("\n".join(HEAD))
    rows, found, places, false = [], 0, 0, 0
    for scene in arguments.scenes:
        picture = picture_of(scene)
        for i, edit in enumerate(picture.edits if arguments.all else picture.edits[:1]):
            r = measure(picture, edit)
            found, places, false = found + r.found, places + r.places, false + r.false
            rows.append(
                f"|{'' if i else f' {picture.figure} {r.scene}'} | {r.edit} | {r.count} | {100 * r.inliers:.2f} % "
                f"| {100 * r.weighted:.2f} % | {r.found} of {r.places} | {r.false} | {100 * r.error:.2f} % |"
            )
            print(rows[-1], flush=True)
    right = found / max(found + false, 1)
    rows.append(
        f"| all | | | | | {found} of {places} ({found / max(places, 1):.0%}) | {false} ({right:.0%} are right) | |"
    )
    print(rows[-1])
    if arguments.document is not None:
        arguments.document.write_text(written(arguments.document, rows), encoding="utf-8")


if __name__ == "__main__":
    main()
