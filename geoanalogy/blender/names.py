"""The names under which GeoAnalogy keeps things in a .blend: custom properties, collections, identifiers of types.

Whoever makes scenes by a script sets the custom properties of objects by these names.
"""

#: On objects, collections and materials: what kind of thing it is. An empty label of a collection means its name. Faces
#: of a solid whose material has a label are surfaces of their own.
LABEL = "ga_label"

#: On objects of the plan: the id that operations know it by, written by the first of them; it stays when the object is
#: renamed.
ID = "ga_id"

#: On objects: name of the object that is the parent (none: found by containment).
PARENT = "ga_parent"

#: On objects: direction of the polygon's x axis, radians from the object's own x axis (none: derived).
ORIENTATION = "ga_orientation"

#: On objects: a label per edge, separated by commas, in the order of the outline's vertices.
SEGMENT_LABELS = "ga_segment_labels"

#: On objects: the outline on the ground as numbers x, y, x, y, … in the object's own coordinates.
FOOTPRINT = "ga_footprint"

#: On mesh objects: "joined" (faces that share edges are one polygon) or "each" (every face is one).
FACES = "ga_faces"

#: On drawn objects: name of the object whose outline stands for it when results are validated: a door with its swing.
VALIDATION = "ga_validation"

#: On examples of a placement: how much they are wanted, from 1 to 0 (none: 1).
TARGET = "ga_target"

#: On rectangles that were drawn as examples: objects are to fill them.
DRAWN = "ga_drawn"

#: On results: the node that made them, and their key among its results.
NODE, KEY = "ga_node", "ga_key"

#: On collections inside that of all results: the label of the solids and outlines that they hold.
MASS = "ga_mass"

#: On meshes of solids: which surface each face belongs to (an attribute), and the ids of these surfaces.
SURFACE, SURFACES = "ga_surface", "ga_surfaces"

#: The collection that holds all results, with a collection per operation.
COLLECTION = "GeoAnalogy"

#: Longest name of a node in bytes: Blender would cut the rest off.
LONGEST_NODE_NAME = 63

#: Identifiers of the node tree, its nodes and its sockets.
TREE, OPERATION_NODE, LAYOUT_SOCKET = "GeoAnalogyTree", "GeoAnalogyOperation", "GeoAnalogyLayout"

#: On nodes: the operation as nested properties, and what it has proposed.
OPERATION, RESULTS, EXAMPLES, FRAME = "operation", "results", "examples", "frame"

#: On nodes of placements: the learned rule in words, the rejected results that it was learned from, and the faces that
#: were unlike the examples when it was learned.
RULE, REJECTED, UNFAMILIAR = "rule", "rejected", "unfamiliar"

#: On trees: the outputs that the next operation builds on, and the ids of the objects that the tree is applied to
#: (none: all).
BUILD_ON, APPLIED_TO = "build_on", "applied_to"

#: On nodes: their name when that was last looked at; their results carry it.
CALLED = "called"

#: On nodes: where their input came from when that was last looked at.
SOURCES = "sources"

#: On nodes: how many results stand there, how long it took, whether something upstream has changed since, and what is
#: wrong with it.
COUNT, SECONDS, STALE, PROBLEM = "count", "seconds", "stale", "problem"

#: On queries: "region" or "stroke". On what is carried over to similar regions: True, as it is no line of the drawing.
QUERY, CONTENT = "ga_query", "ga_content"

#: On results of a region transfer: how similar the region is, which share of the query's lines has a counterpart, and
#: how well the mapping is supported on average; the latter also as an attribute of the points of meshes and strokes.
SIMILARITY, COVERAGE, CONFIDENCE = "ga_similarity", "ga_coverage", "ga_confidence"

#: On nodes of region transfers: the object that the query was drawn as, what is carried over, and all that was found.
QUERY_OBJECT, CONTENTS, MATCHES = "query_object", "contents", "matches"

#: On collections that show transformation spaces: which operation's, and the shares of correspondences, and of their
#: confidence, that are of a match.
SPACE, INLIERS = "ga_space", "inliers"

#: On nodes of region transfers: the names of those results, with commas between them, that little supports.
UNCERTAIN = "uncertain"

#: Name of what has no label, among collections and objects.
UNLABELLED = "unlabelled"

#: On scenes: what is added to the coordinates to have those of the file of parcels, and the name of the manifest.
OFFSET, MANIFEST = "ga_offset", "ga_manifest"
