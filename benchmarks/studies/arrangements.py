"""The scenes of figures 5.4 and 5.10 to 5.13, and windows drawn by eye: what is shown, and where more is wanted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import geoanalogy as ga


@dataclass(frozen=True)
class Arrangement:
    """A scene, the rectangles that are shown in it, and the label of the polygons that hold them.

    Attributes
    ----------
    scene : Scene
    shown : tuple of Rectangle
    label : str
    """

    scene: ga.Scene
    shown: tuple[ga.Rectangle, ...]
    label: str

    def learned(self, count: int | None = None, **options: float) -> ga.PlacementModel:
        """The model of the first few of the rectangles, or of all.

        Parameters
        ----------
        count : int, optional
        **options
            Of `PlacementOptions`.

        Returns
        -------
        PlacementModel
        """
        examples = [ga.Example(self.scene, r) for r in self.shown[:count]]
        return ga.learn_placement(examples, ga.PlacementOptions(**options))  # type: ignore[arg-type]


def polygon(x: float, y: float, width: float, height: float, label: str, id: str | None = None) -> ga.Polygon:
    """An upright rectangle from its least corner."""
    return ga.Polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], label, id)


def facade(x: float, columns: int, rows: int, name: str) -> list[ga.Polygon]:
    """A facade with its left edge at x: windows in rows and columns, a door in the middle."""
    width = columns * 3.0 + 1.0
    found = [polygon(x, 0, width, rows * 3.0 + 3.0, "facade", name)]
    for i in range(columns):
        found += [polygon(x + 1.4 + 3 * i, 3.5 + 3 * j, 1.2, 1.5, "window", f"{name} {i} {j}") for j in range(rows)]
    return [*found, polygon(x + width / 2 - 0.6, 0, 1.2, 2.2, "door", f"{name} door")]


def in_front(scene: ga.Scene, id: str) -> ga.Rectangle:
    """A balcony in front of the lower part of a window."""
    x0, y0, x1, _ = scene.polygon(id).bounds
    return ga.Rectangle((x0 + x1) / 2, y0 + 0.3, x1 - x0 + 0.8, 1.0)


def balconies() -> Arrangement:
    """Figure 5.4: two facades, three balconies."""
    scene = ga.Scene(facade(0, 4, 3, "f") + facade(15, 3, 2, "g"))
    return Arrangement(scene, tuple(in_front(scene, i) for i in ("f 0 1", "f 2 2", "f 3 0")), "facade")


def _walls() -> ga.Scene:
    return ga.Scene(
        [polygon(0, 0, 8, 9, "wall", "a"), polygon(10, 0, 5, 9, "wall", "b"), polygon(17, 0, 11, 9, "wall", "c")]
    )


def wide_balconies() -> Arrangement:
    """Figure 5.10 a: a balcony that leaves the same distance on both sides of its facade."""
    return Arrangement(_walls(), (ga.Rectangle(4, 4, 6, 1), ga.Rectangle(12.5, 4, 3, 1)), "wall")


def doors(adapting: bool) -> Arrangement:
    """Figure 5.10 c: doors that keep their size, or that adapt to the facade."""
    return Arrangement(_walls(), (ga.Rectangle(4, 1, 2, 2), ga.Rectangle(12.5, 1, 1.25 if adapting else 2, 2)), "wall")


def flower_box(scene: ga.Scene, id: str) -> ga.Rectangle:
    """Figure 5.10 b: a box below a window."""
    x0, y0, x1, _ = scene.polygon(id).bounds
    return ga.Rectangle((x0 + x1) / 2, y0 - 0.3, x1 - x0, 0.4)


def flower_boxes() -> Arrangement:
    """Figure 5.10 b: the first box is below a window and above a door, the second one only below a window."""

    def house(x: float, name: str, door: int) -> list[ga.Polygon]:
        windows = [polygon(x + 1.2 + 3 * i, 4, 1.6, 2, "window", f"{name}{i}") for i in range(3)]
        return [polygon(x, 0, 10, 8, "facade", name), *windows, polygon(x + 1.2 + 3 * door, 0, 1.6, 2.5, "door")]

    scene = ga.Scene(house(0, "p", 1) + house(12, "q", 0))
    return Arrangement(scene, (flower_box(scene, "p1"), flower_box(scene, "p0")), "facade")


def mirrors() -> Arrangement:
    """Figure 5.11: a mirror as wide as the basin, below lamps of any width."""

    def bath(x: float, name: str, lamp: float) -> list[ga.Polygon]:
        return [
            polygon(x, 0, 4, 3, "bathroom wall", name),
            polygon(x + 1.5, 0.6, 1, 0.4, "basin"),
            polygon(x + 2 - lamp / 2, 2.4, lamp, 0.2, "lamp"),
        ]

    scene = ga.Scene(bath(0, "a", 0.6) + bath(5, "b", 1.4) + bath(10, "c", 2.0) + bath(15, "d", 1.0))
    return Arrangement(scene, (ga.Rectangle(2, 1.6, 1, 1), ga.Rectangle(7, 1.6, 1, 1)), "bathroom wall")


def entrances() -> Arrangement:
    """Figure 5.12: a roof between a door and a window, which stands off in the last two."""

    def front(x: float, name: str, shift: float) -> list[ga.Polygon]:
        door, window = polygon(x + 2, 0, 1.2, 2.2, "door"), polygon(x + 2 + shift, 3.4, 1.2, 1.4, "window")
        return [polygon(x, 0, 6, 6, "front", name), door, window]

    scene = ga.Scene(front(0, "a", 0) + front(7, "b", 0) + front(14, "c", 0.1) + front(21, "d", 0.8))
    return Arrangement(scene, (ga.Rectangle(2.6, 2.6, 1.6, 0.3), ga.Rectangle(9.6, 2.6, 1.6, 0.3)), "front")


def floors() -> Arrangement:
    """Figure 5.13: roofs above the doors of houses of one floor; the last house has two."""
    scene = ga.Scene(facade(0, 3, 1, "o") + facade(12, 4, 1, "p") + facade(27, 3, 1, "s") + facade(39, 3, 2, "t"))
    return Arrangement(scene, (ga.Rectangle(5, 2.7, 2, 0.4), ga.Rectangle(18.5, 2.7, 2, 0.4)), "facade")


def windows_by_eye(places: tuple[tuple[int, int], ...], seed: int = 0) -> Arrangement:
    """A plain facade with a door, and windows of some columns and rows, 3 % off in size and place as one draws them."""
    rng = np.random.default_rng(seed)
    scene = ga.Scene([polygon(0, 0, 20, 9, "facade", "f"), polygon(9.3, 0, 1.4, 2.4, "door", "d")])
    shown = []
    for column, row in places:
        width, height = np.array([1.2, 1.6]) * (1 + rng.uniform(-0.03, 0.03, 2))
        x, y = np.array([2 + 2.6 * column, 3.6 + 3.4 * row]) + rng.uniform(-0.03, 0.03, 2) * (width, height)
        shown.append(ga.Rectangle(float(x), float(y), float(width), float(height)))
    return Arrangement(scene, tuple(shown), "facade")
