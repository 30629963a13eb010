"""Build the four maps: ``python -m sample_blends.city.maps``. Writes bubenec, curves, closes and grid .geojson."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import shapely
import shapely.ops
from shapely.geometry.base import BaseGeometry

from .convert import ATTRIBUTION, SOURCE
from .ground import CARRIAGEWAY, NARROW, PAVEMENT, Paved, cells, paved, reaches, strips, without_slivers
from .lots import Lot, front_of, lot_in, lots_along

HERE = Path(__file__).resolve().parent
MAPS = ("bubenec", "curves", "closes", "grid")

#: Distance between street trees, of these from the middle of the street, and how far trees stay from junctions and
#: from where walks and drives meet the street, metres.
TREES_APART, TREES_ASIDE, CLEAR_OF_JUNCTIONS, CLEAR_OF_WAYS = 11.0, 4.6, 13.0, 1.0

#: Plots of the real quarter larger than this are parks; those larger than half of it are divided.
PARK = 5200.0

#: Lots that one plot is divided into at the most.
MOST_LOTS = 6

#: How far from the streets the real quarter ends, metres.
NEAR = 62.0

#: Distance within which a plot that looks at a street is on it, metres.
ON_STREET = 13.0


@dataclass
class Map:
    """A map to be written.

    Attributes
    ----------
    features : list of dict
    attribution : str
    """

    attribution: str = ""
    features: list[dict[str, object]] = field(default_factory=list)

    def add(self, shape: BaseGeometry, **properties: object) -> None:
        """Add the polygons of a shape."""
        for part in shapely.get_parts(shapely.set_precision(shape, 0.001)):
            if part.geom_type == "Polygon" and part.area > 1.0:
                geometry = json.loads(shapely.to_geojson(part))
                self.features.append({"type": "Feature", "properties": properties, "geometry": geometry})

    def add_lots(self, lots: Sequence[Lot]) -> None:
        """Add lots, named in order."""
        for k, lot in enumerate(lots):
            ring = [*lot.ring.tolist(), lot.ring[0].tolist()]
            geometry = {"type": "Polygon", "coordinates": [[[round(v, 6) for v in p] for p in ring]]}
            self.features.append(
                {"type": "Feature", "properties": lot.properties(f"lot {k + 1:03d}"), "geometry": geometry}
            )

    def add_trees(self, places: np.ndarray, label: str, radius: float, rng: np.random.Generator) -> None:
        """Add trees as squares, turned and sized by chance."""
        for x, y in places:
            r, turn = radius * rng.uniform(0.8, 1.2), rng.uniform(0, np.pi / 2)
            turns = turn + np.arange(4) * np.pi / 2
            self.add(shapely.Polygon(np.column_stack([x + r * np.cos(turns), y + r * np.sin(turns)])), label=label)

    def write(self, path: Path) -> None:
        """Write it as GeoJSON, a feature a line."""
        head = {"type": "FeatureCollection", **({"attribution": self.attribution} if self.attribution else {})}
        lines = ",\n".join(json.dumps(feature) for feature in self.features)
        path.write_text(f'{json.dumps(head)[:-1]}, "features": [\n{lines}\n]}}\n', encoding="utf-8")


def add_ground(drawn: Map, ground: Paved, grown: Sequence[tuple[str, BaseGeometry]]) -> None:
    """Add what is paved, and what grows beside it."""
    drawn.add(ground.street, label="street")
    # Names of their own: walks and drives on lots are made by operations.
    drawn.add(ground.walks, label="front walk")
    drawn.add(ground.drives, label="front drive")
    for label, part in without_slivers([("pavement", ground.pavement), *grown]):
        drawn.add(part, label=label)


def add_street_trees(
    drawn: Map, lines: Sequence[shapely.LineString], ground: Paved, lots: Sequence[Lot], rng: np.random.Generator
) -> None:
    """Add trees along the kerbs, clear of junctions and of where walks and drives meet the street."""
    ends = shapely.MultiPoint([p for line in lines for p in (line.coords[0], line.coords[-1])])
    crossings = [a.intersection(b) for i, a in enumerate(lines) for b in lines[:i]]
    ways = shapely.union_all([strip for lot in lots for _, strip in strips(lot)]).buffer(CLEAR_OF_WAYS)
    clear = shapely.union_all([ends, *crossings]).buffer(CLEAR_OF_JUNCTIONS).union(ways)
    shapely.prepare(clear)
    spots = []
    for line in lines:
        for offset in (TREES_ASIDE, -TREES_ASIDE):
            row = line.parallel_offset(offset)
            for s in np.arange(TREES_APART / 2, row.length, TREES_APART):
                # Beside its place where that is before a door.
                tried = [row.interpolate(s + rng.uniform(-0.6, 0.6) + aside) for aside in (0.0, 2.0, -2.0, 4.0, -4.0)]
                spot = next((p for p in tried if ground.pavement.contains(p) and not clear.intersects(p)), None)
                if spot is not None and rng.random() < 0.85:
                    spots.append(spot.coords[0])
    drawn.add_trees(np.array(spots).reshape(-1, 2), "broad-leaved tree", 2.0, rng)


def scattered(where: BaseGeometry, apart: float, rng: np.random.Generator) -> np.ndarray:
    """Places in an area, no two nearer than a distance."""
    if where.is_empty:
        return np.zeros((0, 2))
    x0, y0, x1, y1 = where.bounds
    tried = rng.uniform((x0, y0), (x1, y1), (int(4 * (x1 - x0) * (y1 - y0) / apart**2) + 1, 2))
    kept: list[np.ndarray] = []
    for p in tried[shapely.contains_xy(where, *tried.T)]:
        if all(np.hypot(*(p - q)) >= apart for q in kept):
            kept.append(p)
    return np.array(kept).reshape(-1, 2)


def real(seed: int = 1) -> Map:
    """The plots and streets of Prague-Bubenec: small plots joined, large ones divided, a lot in each that has room."""
    rng = np.random.default_rng(seed)
    plain = json.loads(SOURCE.read_text(encoding="utf-8"))["features"]
    shapes = [(f["properties"]["label"], shapely.from_geojson(json.dumps(f["geometry"]))) for f in plain]
    lines = [shape for label, shape in shapes if label == "street"]
    streets = shapely.union_all(lines)
    plots = joined([shape for label, shape in shapes if label == "plot" and shape.area > 5.0], streets)
    plots = [part for plot in plots for part in divided(plot)]
    beyond = streets.buffer(CARRIAGEWAY + NARROW, quad_segs=4)  # where the middle of a street touches plots
    near = streets.buffer(NEAR, quad_segs=3)
    drawn = Map(ATTRIBUTION)
    carriageway, every = streets.buffer(CARRIAGEWAY, quad_segs=4), shapely.union_all(plots)
    ground: list[shapely.Polygon] = []
    lots: list[Lot] = []
    for k, plot in enumerate(plots):
        plot = max(shapely.get_parts(plot.intersection(near)), key=lambda part: part.area)
        if plot.area < 40.0:
            continue
        ground.append(plot)
        if plot.area < PARK:
            # Some plots of the source lie on each other.
            taken = shapely.union_all([lot.shape for lot in lots])
            others = every.difference(plot.buffer(0.3)).union(taken)
            for lot in lots_of(plot.difference(taken.buffer(0.05)).difference(beyond), streets, str(k)):
                if reaches(lot, carriageway, others):
                    lots.append(lot)
    hard = paved(lines, lots, every)
    add_street_trees(drawn, lines, hard, lots, rng)
    grown: list[tuple[str, BaseGeometry]] = []
    taken = shapely.union_all([hard.whole, *(lot.shape for lot in lots)])
    clear = shapely.union_all([lot.shape for lot in lots]).buffer(2.5).union(hard.whole.buffer(2.5))
    for plot in ground:
        park = plot.area >= PARK
        grown.append(("park" if park else "garden", plot.difference(taken)))
        kind, radius, apart = ("broad-leaved tree", 2.9, 11.0) if park else ("small tree", 1.9, 7.5)
        drawn.add_trees(scattered(plot.buffer(-2.5).difference(clear), apart, rng), kind, radius, rng)
        taken, clear = taken.union(plot), clear.union(plot)
    grown += [("verge", cell) for cell in cells(near.difference(taken))]
    add_ground(drawn, hard, grown)
    drawn.add_lots(lots)
    return drawn


def lots_of(plot: BaseGeometry, streets: BaseGeometry, name: str) -> Iterator[Lot]:
    """The lots that a plot has room for: the best one, then the best in what is left, and so on."""
    left = plot
    for k in range(MOST_LOTS):
        found: list[tuple[float, Lot]] = []
        for part in shapely.get_parts(left):
            angle = front_of(part, streets, ON_STREET) if part.geom_type == "Polygon" else None
            lot = None if angle is None else lot_in(part, angle, f"{name} {k}")
            if lot is not None:
                found.append((lot.width * lot.depth, lot))
        if not found:
            return
        _, lot = max(found, key=lambda pair: pair[0])
        yield lot
        left = left.difference(lot.shape.buffer(0.05, join_style="mitre"))


def joined(plots: list[shapely.Polygon], streets: BaseGeometry) -> list[shapely.Polygon]:
    """Plots of which those too small for a lot, or away from the street, have been joined to their neighbours."""
    plots = [part for plot in plots for part in shapely.get_parts(plot.buffer(0)) if part.geom_type == "Polygon"]

    def has_room(plot: shapely.Polygon) -> bool:
        angle = front_of(plot, streets, ON_STREET)
        return angle is not None and lot_in(plot, angle, "") is not None

    waiting = sorted((p for p in plots if p.area < PARK / 2), key=lambda p: p.area)
    done = [p for p in plots if p.area >= PARK / 2]
    kept = []
    while waiting:
        plot = waiting.pop(0)
        if has_room(plot):
            kept.append(plot)
            continue
        others = [p for p in [*waiting, *kept] if p.distance(plot) < 0.3 and p.area + plot.area < PARK / 2.5]
        shared = [p.buffer(0.4).intersection(plot.exterior).length for p in others]
        if not others or max(shared) < 2.0:
            kept.append(plot)
            continue
        other = others[int(np.argmax(shared))]
        (waiting if other in waiting else kept).remove(other)
        whole = max(shapely.get_parts(plot.buffer(0.2).union(other.buffer(0.2)).buffer(-0.2)), key=lambda p: p.area)
        waiting.append(shapely.Polygon(whole.exterior).simplify(0.1))
        waiting.sort(key=lambda p: p.area)
    return [*kept, *done]


def divided(plot: shapely.Polygon) -> list[shapely.Polygon]:
    """A large plot in halves across its longer side, until they have the size of lots."""
    if plot.area < PARK / 3.2 or plot.area > PARK:
        return [plot]
    corners = np.array(plot.minimum_rotated_rectangle.exterior.coords)[:4]
    sides = np.roll(corners, -1, axis=0) - corners
    longer = sides[int(np.hypot(*sides.T).argmax())]
    longer /= np.hypot(*longer)
    middle, across = np.array(plot.minimum_rotated_rectangle.centroid.coords[0]), np.array([-longer[1], longer[0]])
    far = 1000.0
    cut = shapely.LineString([middle - far * across, middle + far * across])
    parts = [p for p in shapely.ops.split(plot, cut).geoms if p.area > 1.0] if plot.intersects(cut) else [plot]
    return [plot] if len(parts) < 2 else [half for part in parts for half in divided(part)]


def generated(lines: Sequence[shapely.LineString], weights: Sequence[float], seed: int) -> Map:
    """Lots along streets, with trees in what is left between."""
    rng = np.random.default_rng(seed)
    drawn = Map()
    middle = shapely.union_all(lines)
    lots = lots_along(lines, middle.buffer(PAVEMENT - 0.3), PAVEMENT, weights, seed)
    built = shapely.union_all([lot.shape for lot in lots])
    hard = paved(lines, lots, built)
    add_street_trees(drawn, lines, hard, lots, rng)
    quarter = shapely.union_all([lot.shape.buffer(14.0) for lot in lots]).buffer(-4.0)
    green = quarter.difference(built).difference(hard.whole)
    add_ground(drawn, hard, [("verge", cell) for cell in cells(green)])
    drawn.add_lots(lots)
    free = quarter.difference(built.buffer(2.2)).difference(middle.buffer(PAVEMENT + 1.5))
    drawn.add_trees(scattered(free, 8.0, rng), "broad-leaved tree", 2.4, rng)
    return drawn


def curves() -> list[shapely.LineString]:
    """Six streets that wind, and three that join them."""
    x = np.linspace(-300.0, 300.0, 150)
    rows = [
        np.column_stack([x, y + 26.0 * np.sin(x / 75.0 + y / 160.0)])
        for y in (-200.0, -118.0, -36.0, 46.0, 128.0, 210.0)
    ]
    found = [shapely.LineString(row) for row in rows]
    for start, bend in ((-270.0, 14.0), (0.0, -14.0), (270.0, 14.0)):
        y = np.linspace(rows[0][np.abs(x - start).argmin(), 1], rows[-1][np.abs(x - start).argmin(), 1], 60)
        away = (y - y[0]) / (y[-1] - y[0])
        found.append(shapely.LineString(np.column_stack([start + bend * np.sin(2 * np.pi * away), y])))
    return found


def closes() -> list[shapely.LineString]:
    """A main street from which closes branch off, each round a turning place."""
    x = np.linspace(-385.0, 385.0, 110)
    main = np.column_stack([x, 18.0 * np.sin(x / 110.0)])
    found = [shapely.LineString(main)]
    for k, start in enumerate(np.linspace(-340.0, 340.0, 9)):
        for side in (1.0, -1.0):
            begin = main[np.abs(x - start - 14.0 * side).argmin()]
            length = 150.0 + 22.0 * ((k + int(side > 0)) % 3)
            y = np.linspace(0.0, length, 30)
            bend = 10.0 * np.sin(np.pi * y / length) * (-1) ** k
            stem = np.column_stack([begin[0] + bend, begin[1] + side * y])
            found.append(shapely.LineString(stem))
            turns = np.linspace(0, 2 * np.pi, 25) - np.pi / 2
            bulb = stem[-1] + 8.5 * np.column_stack([np.cos(turns), side * (np.sin(turns) + 1.0)])
            found.append(shapely.LineString(bulb))
    return found


def grid() -> list[shapely.LineString]:
    """Streets at right angles."""
    across = [shapely.LineString([(-275.0, y), (415.0, y)]) for y in (-190.0, -112.0, -34.0, 44.0, 122.0, 200.0)]
    along = [shapely.LineString([(x, -215.0), (x, 225.0)]) for x in (-250.0, -90.0, 75.0, 245.0, 390.0)]
    return [*across, *along]


def build(name: str) -> Map:
    """One of the maps."""
    if name == "bubenec":
        return real()
    lines, weights = {
        "curves": (curves(), (0.08, 0.5, 0.42)),
        "closes": (closes(), (0.05, 0.4, 0.55)),
        "grid": (grid(), (0.35, 0.4, 0.25)),
    }[name]
    return generated(lines, weights, MAPS.index(name))


def counted(drawn: Map) -> Iterator[str]:
    """How much of what there is on a map."""
    labels = [str(f["properties"]["label"]) for f in drawn.features]  # type: ignore[index]
    for label in sorted(set(labels)):
        yield f"{labels.count(label)} × {label}"


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("maps", nargs="*", default=MAPS, help="which ones (default: all)")
    parser.add_argument("--output", type=Path, default=HERE, help="folder")
    arguments = parser.parse_args()
    for name in arguments.maps:
        drawn = build(name)
        drawn.write(arguments.output / f"{name}.geojson")
        print(f"{name}: {', '.join(counted(drawn))}")


if __name__ == "__main__":
    main()
