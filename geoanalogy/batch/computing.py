"""Building one tile: a function of texts, so that it does not matter which process or machine does it."""

import hashlib
import json
import time
from collections.abc import Sequence
from functools import lru_cache

from ..errors import Cancelled, InputError
from ..geometry.scene import Scene
from ..operations.evaluation import Evaluations
from ..operations.layout import Layout
from ..operations.node import Node
from ..operations.placing import Placing
from ..operations.tree import OperationsTree
from ..progress import Progress, Stepper, run
from .detail import Detail, simplified
from .placed import outlines_of
from .product import Product, product_of, together
from .release import digest
from .tiles import Unit, read_scene_text


class TimedEvaluations(Evaluations):
    """Evaluations that know how long each kind of operation took.

    Attributes
    ----------
    seconds : dict of str to float
        Processor time by the type of the operation; all that place are "placement".
    """

    def __init__(self) -> None:
        super().__init__()
        self.seconds: dict[str, float] = {}

    def steps(self, node: Node, layout: Layout, seed: int) -> Stepper[tuple[Layout, ...]]:
        """As the base class does, and note the time."""
        begin = time.process_time()
        result = yield from super().steps(node, layout, seed)
        kind = "placement" if isinstance(node.operation, Placing) else node.operation.type
        self.seconds[kind] = self.seconds.get(kind, 0.0) + time.process_time() - begin
        return result


def job_text(tree: OperationsTree, seed: int, detail: Detail) -> str:
    """What all tiles of a job have in common, as JSON.

    Parameters
    ----------
    tree : OperationsTree
    seed : int
    detail : {"mass", "facade", "full"}

    Returns
    -------
    str
    """
    return json.dumps({"tree": tree.to_dict(), "seed": seed, "detail": detail}, sort_keys=True)


def key_of(job: str, scene: str) -> str:
    """The name of what comes of a tile: it depends on all that the content depends on.

    Parameters
    ----------
    job, scene : str
        As `job_text` and `tiles.scene_text` wrote them.

    Returns
    -------
    str
        32 hexadecimal digits.
    """
    return hashlib.sha256("\0".join((digest(), job, scene)).encode()).hexdigest()[:32]


def compute(job: str, scene: str, progress: Progress | None = None) -> Product:
    """Build a tile.

    A parcel that fails is named in the product's problems, and the others are built.

    Parameters
    ----------
    job, scene : str
        As `job_text` and `tiles.scene_text` wrote them.
    progress : callable (fraction, text) -> bool, optional
        Returning False cancels.

    Returns
    -------
    Product

    Raises
    ------
    InputError
        Where the job is damaged.
    Cancelled
        When `progress` returned False.
    ModuleNotFoundError
        Where a library is missing: no parcel could be built.
    """
    worker = _worker(job)
    ground, units = read_scene_text(scene)
    try:
        return worker.build(ground, units, progress)
    except (Cancelled, ModuleNotFoundError):
        raise
    except Exception as error:
        if len(units) == 1:
            return worker.failed(units[0], error)
    products = []
    for unit in units:
        try:
            products.append(worker.build(ground, [unit], progress))
        except (Cancelled, ModuleNotFoundError):
            raise
        except Exception as error:
            products.append(worker.failed(unit, error))
    return together(products)


class _Worker:
    """A tree, and what has been evaluated for it on surfaces.

    Of all else nothing is kept from one tile to the next, so that the thousandth costs what the first did, in time and
    in memory: no other tile has the same ground, and solids made of named parts.
    """

    def __init__(self, job: str) -> None:
        plain = json.loads(job)
        self.seed: int = plain["seed"]
        tree = OperationsTree(OperationsTree.from_dict(plain["tree"]).nodes, TimedEvaluations())
        self.tree = simplified(tree, plain["detail"])
        self.outlines = outlines_of(self.tree)

    def build(self, ground: Scene, units: Sequence[Unit], progress: Progress | None) -> Product:
        """Build some units, together."""
        done = self.tree.evaluations
        assert isinstance(done, TimedEvaluations)
        done.seconds = {}
        known, evaluated = done.surfaces_reused, done.surfaces_evaluated
        scene = Scene(ground.subset(id for unit in units for id in unit.members), ground.offset)
        begin = time.process_time()
        try:
            applied = run(self.tree.steps(scene, self.seed), progress)
        finally:
            done.leave_ground()
        parcel_of = {id: unit.parcel for unit in units for id in unit.members[::-1]}
        facts = {
            "parcels": [unit.parcel for unit in units],
            "elements": len(applied),
            "problems": list(applied.problems),
            "known": done.surfaces_reused - known,
            "surfaces": done.surfaces_reused - known + done.surfaces_evaluated - evaluated,
        }
        product = product_of(applied, parcel_of, facts, self.outlines)
        return Product(
            product.masses, product.placed, {**facts, "seconds": {**done.seconds, "all": time.process_time() - begin}}
        )

    @staticmethod
    def failed(unit: Unit, error: Exception) -> Product:
        """What there is of a parcel that could not be built: a sentence."""
        reason = str(error) if isinstance(error, InputError) else f"internal error ({type(error).__name__}: {error})"
        facts = {"parcels": [unit.parcel], "elements": 0, "known": 0, "surfaces": 0, "seconds": {}}
        nothing = together([])
        return Product(
            nothing.masses, nothing.placed, {**facts, "problems": [f"parcel {unit.parcel!r} stays empty: {reason}"]}
        )


@lru_cache(maxsize=1)
def _worker(job: str) -> _Worker:
    return _Worker(job)
