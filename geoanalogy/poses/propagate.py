"""Propagating a pose: an example is learned, and put where it stands in the same relations (chapter 4)."""

from numpy.typing import ArrayLike

from ..arguments import given
from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..progress import Progress
from ..tolerances import CONTAINED_SHARE
from .model import PoseModel
from .options import PoseOptions
from .pose import Pose, footprint_ring
from .results import PoseResults


def learn_pose(
    scene: Scene, pose: Pose, footprint: ArrayLike | None = None, options: PoseOptions | None = None
) -> PoseModel:
    """Take an example from its scene.

    Parameters
    ----------
    scene : Scene
    pose : Pose
        Where the example stands, scene coordinates.
    footprint : array_like of shape (n, 2), optional
        The example's outline in the pose's own frame; None: a point.
    options : PoseOptions, optional

    Returns
    -------
    PoseModel

    Raises
    ------
    InputError
        Where the scene is empty or no polygon holds the example.
    """
    given(scene, Scene, "the scene", "Scene([polygon, …])")
    given(pose, Pose, "the example", "Pose((x, y), angle)")
    options = PoseOptions() if options is None else given(options, PoseOptions, "options", "PoseOptions(…)")
    if not len(scene):
        raise InputError("the scene is empty; add polygons, such as rooms, before an example is propagated")
    ring = footprint_ring(footprint)
    parent = None if ring is None else scene.parent_of_shape(pose.to_scene(ring), CONTAINED_SHARE)
    parent = parent or scene.parent_of(pose.position)
    if parent is None:
        x, y = pose.position
        raise InputError(f"the example at x {x:.6g}, y {y:.6g} lies outside every polygon; put it into one")
    members = scene.members_of(str(parent.id))
    # Members keep their parent; the parent itself is the top of its own scene.
    top = Polygon(**{**parent.to_dict(), "parent": None})
    source = Scene([top, *(Polygon(**{**m.to_dict(), "parent": parent.id}) for m in members)])
    return PoseModel(source, source.polygon(str(parent.id)), pose, ring, options)


def propagate_pose(
    scene: Scene,
    pose: Pose,
    footprint: ArrayLike | None = None,
    options: PoseOptions | None = None,
    progress: Progress | None = None,
) -> PoseResults:
    """Find the poses that stand in the same relations to their surroundings as an example does (chapter 4).

    Parameters
    ----------
    scene : Scene
        Labelled polygons with their hierarchy.
    pose : Pose
        The example.
    footprint : array_like of shape (n, 2), optional
        The example's outline in its own frame (origin at its position, x along its direction); None: a point.
    options : PoseOptions, optional
    progress : callable (fraction, text) -> bool, optional
        Returning False cancels.

    Returns
    -------
    PoseResults
        Best first.

    Raises
    ------
    InputError
        Where the scene is empty, or the example is in no polygon or no sound ring.
    Cancelled
        When `progress` returned False.

    Examples
    --------
    >>> from math import pi
    >>> rooms = [Polygon([(x, 0), (x + 4, 0), (x + 4, 3), (x, 3)], label="bedroom", id=f"at {x}") for x in (0, 5)]
    >>> bed = [(-1, -0.5), (1, -0.5), (1, 0.5), (-1, 0.5)]
    >>> beds = propagate_pose(Scene(rooms), Pose((1, 0.5), 0.0), footprint=bed)
    >>> best = next(p for p in beds if p.parent.id == "at 5")
    >>> [round(float(v), 3) for v in (*best.pose.position, best.pose.angle % (2 * pi), best.importance)]
    [6.0, 0.5, 0.0, 1.0]
    """
    return learn_pose(scene, pose, footprint, options).place(scene, progress)
