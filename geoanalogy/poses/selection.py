"""Probabilistic pose selection: one of several examples, chosen anew in every scope (section 4.8)."""

import hashlib
from collections.abc import Sequence

import numpy as np

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..progress import Progress, Stepper, run, within
from .model import PoseModel
from .results import PoseResults, PropagatedPose


def place_generator(seed: int, polygon: Polygon, purpose: str) -> np.random.Generator:
    """A random generator that belongs to a polygon: it depends on where the polygon is, not on its rank in a scene.

    Parameters
    ----------
    seed : int
    polygon : Polygon
        Its label and vertices count; its id does not, since scenes number polygons in their order.
    purpose : str
        What it is for: different purposes get independent generators.

    Returns
    -------
    numpy.random.Generator
    """
    ring = polygon.points
    first = int(np.lexsort((ring[:, 1], ring[:, 0]))[0])
    content = hashlib.sha256(f"{seed}\0{purpose}\0{polygon.label}".encode())
    content.update(np.roll(ring, -first, axis=0).tobytes())
    return np.random.default_rng(list(np.frombuffer(content.digest(), dtype=np.uint32)))


def choose(scope: Polygon, weights: Sequence[float], seed: int = 0) -> int:
    """Choose one of several things for a scope.

    Parameters
    ----------
    scope : Polygon
    weights : sequence of float
        How often each is chosen in proportion to the others, not negative.
    seed : int

    Returns
    -------
    int
        Number of the one chosen. It stays when the scene is reordered, and when another thing is added at the end and
        is not itself chosen.

    Raises
    ------
    InputError
        For weights that are negative, not finite, or all zero.

    Examples
    --------
    >>> choose(Polygon([(0, 0), (1, 0), (0, 1)]), [0.0, 1.0])
    1
    """
    share = np.asarray(weights, dtype=np.float64)
    if share.ndim != 1 or not np.isfinite(share).all() or (share < 0).any() or not share.any():
        raise InputError("the weights of a choice are not positive numbers; give one per example, and not only zeros")
    # A race of exponential clocks: the first to ring is each with a probability in proportion to its weight.
    ring = place_generator(seed, scope, "choice").exponential(size=len(share))
    with np.errstate(divide="ignore"):
        return int(np.argmin(ring / share))


class PoseChoice:
    """Several examples in a scope of which every other scope gets the matches of one.

    Parameters
    ----------
    models : sequence of PoseModel
        One per example.
    scope : str, optional
        Label of the polygons in which one example is chosen: the results' parents, or what they lie in. None: that of
        the first example's parent.
    weights : sequence of float, optional
        How often each is chosen in proportion to the others. None: equally often.
    seed : int

    Raises
    ------
    InputError
        Without examples, for a wrong number of weights, or weights that choose nothing.
    """

    def __init__(
        self,
        models: Sequence[PoseModel],
        scope: str | None = None,
        weights: Sequence[float] | None = None,
        seed: int = 0,
    ) -> None:
        if not models:
            raise InputError("there is no example to choose from; give at least one")
        if weights is not None and len(weights) != len(models):
            raise InputError(f"there are {len(weights)} weights for {len(models)} examples; give one per example")
        self.models = tuple(models)
        self.scope = models[0].parent.label if scope is None else scope
        self.weights = (1.0,) * len(models) if weights is None else tuple(float(w) for w in weights)
        self.seed = seed
        choose(models[0].parent, self.weights, seed)

    def chosen_in(self, scope: Polygon) -> int:
        """Number of the example that a scope gets.

        Parameters
        ----------
        scope : Polygon

        Returns
        -------
        int
        """
        return choose(scope, self.weights, self.seed)

    def place(self, scene: Scene, progress: Progress | None = None) -> list[PoseResults]:
        """Propagate every example into the scopes that it is chosen in.

        Parameters
        ----------
        scene : Scene
        progress : callable (fraction, text) -> bool, optional
            Returning False cancels.

        Returns
        -------
        list of PoseResults
            One per example, best first. Results that lie in no scope are left out.

        Raises
        ------
        Cancelled
            When `progress` returned False.
        """
        return run(self.steps(scene), progress)

    def steps(self, scene: Scene) -> Stepper[list[PoseResults]]:
        """The stepper behind `place`.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        generator of (float, str)
            Returns a list of PoseResults.
        """
        count = len(self.models)
        chosen: dict[str, int | None] = {}
        results = []
        for i, model in enumerate(self.models):
            found = yield from within(model.steps(scene), i / count, (i + 1) / count)
            kept: list[PropagatedPose] = []
            for result in found:
                parent = str(result.parent.id)
                if parent not in chosen:
                    scope = self._scope_of(scene, parent)
                    chosen[parent] = None if scope is None else self.chosen_in(scope)
                if chosen[parent] == i:
                    kept.append(result)
            results.append(PoseResults(kept, model.footprint))
        return results

    def _scope_of(self, scene: Scene, id: str) -> Polygon | None:
        """The nearest polygon of the scope's label: the one of an id itself, or what it lies in."""
        polygon: Polygon | None = scene.polygon(id)
        while polygon is not None and polygon.label != self.scope:
            polygon = scene.parent(str(polygon.id))
        return polygon
