"""Every tolerance of the engine: its name, its unit and why it has that value."""

import math

#: Lengths below this fraction of a ring's extent are zero: coincident vertices, areas without content. float64 keeps
#: 1e-16; sums over thousands of vertices at coordinates a million times the ring's size still leave 1e-9.
ZERO_LENGTH = 1e-9

#: Largest coordinate in scene units. Beyond it float64 leaves less than a micrometre per metre in squared distances.
LARGEST_COORDINATE = 1e9

#: Cosine of the turn of a smooth vertex (the epsilon of section 4.3): 35 degrees. An octagon (45) has corners, a
#: circle drawn with twelve edges (30) has none.
SMOOTH_TURN = math.cos(math.radians(35.0))

#: Share of a polygon's area that its parent must hold (section 4.8). Drawn objects jut out: a strict test makes
#: orphans of them.
CONTAINED_SHARE = 0.95

#: Share of a polygon's area that must lie in a larger one for it to be one of its members although neither holds the
#: other (a door that straddles the wall of two rooms). Below, the two merely touch.
STRADDLING_SHARE = 0.05

#: Share of the smaller polygon's area below which two polygons touch without intersecting: furniture stands against
#: walls.
TOUCHING_SHARE = 0.02
