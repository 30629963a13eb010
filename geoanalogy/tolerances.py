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

# Regions (chapter 3)

#: Lines that a drawing may have. Every line costs a fixed amount of work, so that a drawing of stray dots would
#: take minutes.
MOST_LINES = 20_000

#: Points that the lines of a drawing are resampled to: a thousandth of a line's length is finer than any match is.
CONTOUR_POINTS = 8_000

#: Points that every single line is resampled to at least, so that a small shape in a large drawing keeps its
#: corners.
LEAST_CONTOUR_POINTS = 48

#: Smoothing of every line, as a share of its length: rounds the corners of polylines so that their turns have an
#: extent.
CONTOUR_SMOOTHING = 0.007

#: Distance from the outline of a query, in extents of the drawing, at which a line still counts as inside: a
#: region is often drawn by following the very line.
ON_OUTLINE = 1e-6

#: A query whose ends are farther apart than this many of its longest edges is an open stroke.
UNCLOSED_EDGES = 1.5

#: Share of the area that the largest part of a self-crossing outline must have: less than that is no loop at the
#: end of a lasso.
LEAST_SIMPLE_SHARE = 0.9

#: Share of a parcel's area above which another one of its label inside it is the same once more: nobody builds on both.
TWIN_SHARE = 0.5

#: Total turn, in radians, of the lines in a query below which they are straight (20 degrees).
LEAST_QUERY_TURN = math.radians(20.0)

#: Stretch of a line, as a share of its length, over which a corner turns: about three widths of the smoothing.
CORNER_WINDOW = 0.022

#: Turn, in radians, from which such a stretch counts as a corner (14 degrees); a circle turns 8 over it.
CORNER_TURN = math.radians(14.0)

# Noise of boundaries (geoanalogy.geometry.persistence). A ring is noisy where it has many turns, most of them to and
# fro, by angles of all sizes; real rooms, plots and buildings fail the third, circles the second.

#: Turns that a ring must have to be noisy: rooms and their furniture mostly have fewer, and pay nothing.
LEAST_NOISY_TURNS = 24

#: Smallest turn, in radians, that counts (2 degrees): edges that go straight on are no noise.
NOISY_TURN = math.radians(2.0)

#: Share of neighbouring turns that are of opposite sense: independent displacements make 0.70, curves none.
NOISY_ALTERNATION = 0.5

#: Range, in radians, that the sizes of the turns fill (12.5 degrees). A comb or a stair fills five, its window.
NOISY_SPREAD = math.radians(12.5)

#: Largest noise, as a share of the square root of the area: beyond it nothing can be told.
LARGEST_NOISE = 0.045

#: What a straight piece and an arc cost, in logarithms of the number of points. A piece has two numbers, or three, and
#: an end; the Bayesian information criterion would say 3 and 4. Outlines are straight more often than not.
LINE_PRICE = 4.0
ARC_PRICE = 9.0

#: Turn, in radians, from which two pieces make a corner whatever one arc through both would say (70 degrees).
SURE_TURN = math.radians(70.0)

#: By how many squared deviations one arc must be worse than two pieces for a smaller turn to be a corner.
CORNER_EVIDENCE = 5.0

#: Vertices that each piece must explain: with fewer the shape is not noisy but rich.
VERTICES_PER_PIECE = 5

# Files (geoanalogy.formats)

#: Largest turn, in radians, between two edges of a flattened curve (5.6 degrees): a circle becomes 64 edges, each
#: off the curve by 0.12 % of the radius, and far from a corner.
CURVE_TURN = math.pi / 32

#: Parts of a curve below this fraction of its path's extent stay straight whatever they turn: cusps.
SMALLEST_CURVE = 1e-4

#: Share of its length within which the ends of an open line nearly meet: it was meant to be a ring. Within the
#: square of it they do meet; hand-typed and rounded coordinates are closer than that.
NEARLY_CLOSED = 0.01

#: Distance, as a share of a layer's extent, within which the ends of lines meet: hundredths of a millimetre to a
#: few tenths in a house.
JOINED_ENDS = 1e-5

#: Distance in scene units from which a file's coordinates are moved near the origin: Blender's single precision
#: leaves a millimetre there.
FAR_FROM_ORIGIN = 10_000.0

# Placements (chapter 5)

#: Share of its bounding box that a polygon fills where it is a rectangle of that frame: drawn rectangles are off
#: by a pixel or a millimetre.
PARALLEL_SHARE = 0.98

#: Angle in radians within which directions are parallel: rectangles drawn by hand along a wall.
PARALLEL_ANGLE = math.radians(5.0)

#: Share of its longer side within which two rectangles are the same.
SAME_RECTANGLE = 1e-6

#: Distance, in square roots of the parent's area, within which an example outside still belongs to it: what is
#: seen beyond the edge of a photograph.
NEAR_PARENT = 0.5

# The operations tree (section 5.6)

#: Largest difference of vertices, in sizes of a polygon, of a polygon and itself: Blender keeps single precision, which
#: leaves 1e-5 of a room a hundred metres from the origin.
SAME_POLYGON = 1e-4

#: Distance, in sizes of the parent, within which a result is taken for the one that a decision by hand was made
#: about: a replay after a wall was moved shifts results a little; of several, the nearest is meant.
SAME_RESULT = 0.05

#: Mean width, in scene units, of the thinnest parcel that anything is built on: thinner is what borders leave between
#: them.
THINNEST_PARCEL = 0.5

#: Width, in units of its file, that the largest polygon of a map has at least, unless the unit is the degree: a
#: hundredth of a degree is a kilometre.
SMALLEST_MAP = 0.05

#: Vertices that a parcel that is built on may have: cadastral ones have tens, and relations between all edges cost
#: their square. An outline that crosses itself is mended up to as many: its crossings may cost the square as well.
MOST_VERTICES = 500

#: Vertices that any outline of a map may have: the streets of a district have thousands, and what is left of a survey
#: by satellite or a broken export has millions.
MOST_DRAWN = 20_000

#: Distance, in extents of a parcel, that its outline may move where it has too many vertices: 3 cm on a house's plot.
SIMPLIFIED = 1e-3

#: Distance, in sizes of a polygon, within which an edge lies on one of its former edges after it has been cut back.
ON_SAME_EDGE = 1e-6

#: Area, in squared scene units, of the smallest parcel that anything is built on; less is left where borders were drawn
#: twice.
SMALLEST_PARCEL = 1.0

#: Largest distance between neighbouring samples of a line, in extents of the drawing (appendix A: about one percent).
SAMPLE_SPACING = 0.01

#: Largest turn between neighbouring samples, in radians (20 degrees): a quarter circle gets five.
SAMPLE_TURN = math.radians(20.0)

#: Samples of a drawing at about which their spacing grows: twice as many take four times as long to compare.
MOST_SAMPLES = 2_500

#: Share of its area that the parent must hold of a single one of several examples, and of all on average: a building
#: that juts out over the edge of its plot is on that plot all the same.
JUTTING_SHARE, JUTTING_MEAN = 0.7, 0.9

#: Directions in which the outermost points stand for all in the smallest circle round a drawing: half a degree
#: apart, which is wrong by 1 - cos(0.25 degrees) = 1e-5 of it.
HULL_DIRECTIONS = 720

# Solids (section 5.6)

#: Distance, in extents of an outline, within which two vertices of a moving front are the same: what is left of
#: 1e-16 after tens of events at sharp corners.
SAME_VERTEX = 1e-8

#: Grid, in scene units, that the vertices of solids are rounded to when they are combined: a micrometre per metre, far
#: above what turning to another plane and back leaves, and a power of two, so that rounding is exact.
COORDINATE_GRID = 2.0**-20

#: Difference of the components of unit vectors below which the axes of two frames are parallel.
PARALLEL_AXES = 1e-9

#: Decimals of a unit normal and of the distance from the origin, in scene units, in which faces in one plane agree.
COPLANAR = 5

#: Turn, in radians, below which an outline runs straight on, so that its edges extrude to one planar face.
STRAIGHT_RUN = 1e-4

#: Area, in squared scene units, of the smallest part of a face that is a surface; less is left of coplanar cuts.
SMALLEST_FACE = 1e-6

#: Distance, in scene units, between the coordinates that the outlines of surfaces are rounded to: equal surfaces have
#: identical outlines.
SURFACE_GRID = 1e-6
