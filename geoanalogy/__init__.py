"""GeoAnalogy: edit propagation by geometric analogies.

The engine. Reading order: `geometry` (polygons, features, hierarchy), `relations` (the relationship functions), then
the engines `poses` (chapter 4 of the thesis), `placements` (chapter 5) and `regions` (chapter 3), and `operations`,
the tree that replays edits.
"""

from .errors import Cancelled, InputError
from .geometry.polygon import Polygon
from .geometry.scene import Scene

__all__ = ["Cancelled", "InputError", "Polygon", "Scene"]
