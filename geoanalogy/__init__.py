"""GeoAnalogy: edit propagation by geometric analogies.

The engine. Reading order: `geometry` (polygons, features, hierarchy), `relations` (the relationship functions), then
the engines `poses` (chapter 4 of the thesis), `placements` (chapter 5) and `regions` (chapter 3), and `operations`,
the tree that replays edits.
"""

from .errors import Cancelled, InputError
from .formats.files import read_drawing, read_scene, write_scene
from .geometry.drawing import Drawing
from .geometry.mesh import Mesh
from .geometry.polygon import Polygon
from .geometry.rectangle import Rectangle
from .geometry.scene import Scene
from .geometry.surface import Surface
from .operations.applied import Applied
from .operations.element import Element
from .operations.tree import OperationsTree
from .placements.examples import Example
from .placements.model import Placement, PlacementModel, learn_placement
from .placements.options import PlacementOptions
from .poses.model import PoseModel
from .poses.options import PoseOptions
from .poses.pose import Pose
from .poses.propagate import learn_pose, propagate_pose
from .poses.results import PoseResults, PropagatedPose
from .regions.matching import Matches, RegionMatch, match_regions
from .regions.options import RegionOptions

__all__ = [
    "Applied",
    "Cancelled",
    "Drawing",
    "Element",
    "Example",
    "InputError",
    "Matches",
    "Mesh",
    "OperationsTree",
    "Placement",
    "PlacementModel",
    "PlacementOptions",
    "Polygon",
    "Pose",
    "PoseModel",
    "PoseOptions",
    "PoseResults",
    "PropagatedPose",
    "Rectangle",
    "RegionMatch",
    "RegionOptions",
    "Scene",
    "Surface",
    "learn_placement",
    "learn_pose",
    "match_regions",
    "propagate_pose",
    "read_drawing",
    "read_scene",
    "write_scene",
]
