"""A whole job: the tiles of a scene, each built or found finished, by one process, by several, or on a cluster."""

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Any

from ..errors import Cancelled, InputError
from ..geometry.scene import Scene
from ..operations.tree import OperationsTree
from ..progress import Progress
from .cluster import build_there
from .computing import compute, job_text, key_of
from .detail import Detail
from .processes import Work, build_here
from .product import Product
from .store import Store
from .tiles import PARCELS_PER_TILE, Tile, divide, scene_text, units_of, wanted_labels


@dataclass(frozen=True)
class Choices:
    """How a job is done. None of it but the seed and the detail changes what comes out.

    Attributes
    ----------
    seed : int
        Of all chance in the tree.
    detail : {"mass", "facade", "full"}
    jobs : int
        Processes of this machine; 1: this one.
    scheduler : str
        Address of a Dask scheduler; "": none.
    per_tile : int
        Parcels of a tile.
    only : tuple of int
        Numbers of the tiles to build, from 1; empty: all.
    """

    seed: int = 0
    detail: Detail = "full"
    jobs: int = 1
    scheduler: str = ""
    per_tile: int = PARCELS_PER_TILE
    only: tuple[int, ...] = ()


@dataclass
class Job:
    """The tiles of a scene, and what has been built of them.

    Attributes
    ----------
    scene : Scene
    tiles : list of Tile
    keys : list of str
        Of the product of each.
    store : Store
        Where the products are.
    facts : dict of str to mapping
        By the key: what each product says of itself.
    reused : int
        How many were there already.
    failed : dict of str to str
        By the key: why a tile could not be built.
    """

    scene: Scene
    tiles: list[Tile]
    keys: list[str]
    store: Store
    facts: dict[str, Mapping[str, Any]] = field(default_factory=dict)
    reused: int = 0
    failed: dict[str, str] = field(default_factory=dict)

    @property
    def finished(self) -> bool:
        """Whether all tiles have been built."""
        return len(self.facts) == len(set(self.keys))

    def products(self) -> Iterator[tuple[Tile, Product]]:
        """The tiles that have been built, in order, each read from the disk when it is asked for.

        Yields
        ------
        Tile
        Product

        Raises
        ------
        InputError
            Where somebody has taken a finished tile away.
        """
        for tile, key in zip(self.tiles, self.keys, strict=True):
            if key in self.facts and key not in self.failed:
                product = self.store.find(key)
                if product is None:
                    raise InputError(f"{tile.name} is no longer in {self.store.folder}; run the command again")
                yield tile, product


class Stopped(Cancelled):
    """The job was stopped; its message says what is kept."""


def merged(trees: Sequence[tuple[str, OperationsTree]]) -> OperationsTree:
    """Trees that were recorded apart, as one.

    Parameters
    ----------
    trees : sequence of (str, OperationsTree)
        With their names, which come before the names of their nodes where there are several.

    Returns
    -------
    OperationsTree
    """
    if len(trees) == 1:
        return trees[0][1]
    whole = OperationsTree()
    for name, tree in trees:
        whole = whole.with_tree(tree, (), f"{name} ")
    return whole


def generate(
    tree: OperationsTree, scene: Scene, store: Path, choices: Choices, progress: Progress | None = None
) -> Job:
    """Build the tiles of a scene that are not finished yet.

    Parameters
    ----------
    tree : OperationsTree
    scene : Scene
    store : Path
        Folder of the finished tiles, made where it is not there.
    choices : Choices
    progress : callable (fraction, text) -> bool, optional
        Returning False stops; tiles that are finished stay in the folder, and are found there next time.

    Returns
    -------
    Job

    Raises
    ------
    InputError
        Where no parcel has a label that the tree does something with, for a tile that is not there, and for what is
        wrong with a cluster.
    Stopped
        When `progress` returned False.
    ModuleNotFoundError
        Where a library is missing that is built with.
    OSError
        Where the folder cannot be written.
    """
    units = units_of(scene, wanted_labels(tree))
    if not units:
        labels = ", ".join(sorted({repr(p.label) for p in scene.polygons})[:5]) or "none"
        wanted = ", ".join(sorted(map(repr, wanted_labels(tree, beginning=True) or ()))) or "none"
        raise InputError(
            f"the tree builds on no parcel of this file: their labels are {labels}, and it begins with {wanted}; "
            "name the property with the labels, or map them by a table"
        )
    tiles = divide(scene, units, choices.per_tile)
    wrong = [k for k in choices.only if not 1 <= k <= len(tiles)]
    if wrong:
        raise InputError(f"there is no tile {wrong[0]}; give numbers from 1 to {len(tiles)}")
    text = job_text(tree, choices.seed, choices.detail)
    scenes = [scene_text(scene, tile.units) for tile in tiles]
    job = Job(scene, tiles, [key_of(text, one) for one in scenes], Store(store))
    waiting = []
    for k, (key, one) in enumerate(zip(job.keys, scenes, strict=True)):
        if choices.only and k + 1 not in choices.only:
            continue
        found = job.store.find(key)
        if found is None:
            waiting.append(Work(key, one))
        else:
            job.facts[key] = found.facts
    job.reused = len(job.facts)
    _Runner(job, text, waiting, choices, progress).run()
    if job.failed and len(job.failed) == len(job.facts):
        raise InputError(f"no tile could be built: {next(iter(job.failed.values()))}")
    return job


class _Runner:
    """Builds what waits, and says how far it is."""

    def __init__(
        self, job: Job, text: str, waiting: Sequence[Work], choices: Choices, progress: Progress | None
    ) -> None:
        self.job, self.text, self.waiting, self.choices, self.progress = job, text, waiting, choices, progress
        self.tiles = dict(zip(job.keys, job.tiles, strict=True))
        self.parcels = sum(len(self.tiles[work.key].parcels) for work in waiting)
        self.begin = time.monotonic()
        self.done = 0

    def run(self) -> None:
        try:
            self._build()
        except Cancelled:
            raise self._stopped() from None

    def _build(self) -> None:
        self._report()
        if not self.waiting:
            return
        if self.choices.scheduler:
            with closing(build_there(self.text, self.waiting, self.choices.scheduler)) as found:
                for there in found:
                    if there is not None:
                        self._take(*there)
                    self._report()
            return
        import_module("manifold3d")  # before the long work, in case it is missing
        if self.choices.jobs > 1:
            with closing(build_here(self.text, self.waiting, self.job.store, self.choices.jobs)) as answers:
                for answer in answers:
                    if answer is not None:
                        self._take(*answer)
                    self._report()
        else:
            for work in self.waiting:
                built = compute(self.text, work.scene, lambda *_: self._goes_on())
                self._take(work.key, "", built.to_bytes())
                self._report()

    def _take(self, key: str, reason: str, product: bytes | None = None) -> None:
        """A tile is done."""
        tile = self.tiles[key]
        self.done += len(tile.parcels)
        if not reason and product is not None:
            self.job.store.keep(key, product)
        found = None if reason else self.job.store.find(key)
        if found is None:
            ids = ", ".join(map(repr, tile.parcels))
            self.job.failed[key] = reason or "it could not be kept"
            sentence = f"{tile.name} stays empty: {self.job.failed[key]} (parcels {ids})"
            nothing = {"parcels": list(tile.parcels), "elements": 0, "known": 0, "surfaces": 0, "seconds": {}}
            self.job.facts[key] = {**nothing, "problems": [sentence]}
        else:
            self.job.facts[key] = found.facts

    def _goes_on(self) -> bool:
        return self.progress is None or self.progress(*self._state()) is not False

    def _report(self) -> None:
        if not self._goes_on():
            raise Cancelled

    def _state(self) -> tuple[float, str]:
        share = self.done / self.parcels if self.parcels else 1.0
        text = f"{self.done} of {self.parcels} parcels built"
        if self.job.reused:
            text += f", {self.job.reused} tiles were finished before"
        if 0.0 < share < 1.0:
            text += f", {remaining((time.monotonic() - self.begin) * (1 - share) / share)} left"
        return share, text

    def _stopped(self) -> Stopped:
        # Other processes may have finished more than they have said.
        finished = sum(self.job.store.path(key).is_file() for key in set(self.job.keys) - set(self.job.failed))
        return Stopped(
            f"stopped; {finished} of {len(self.job.tiles)} tiles are finished and kept in {self.job.store.folder}, the "
            "same command goes on from there"
        )


def remaining(seconds: float) -> str:
    """A time, as one says it.

    Parameters
    ----------
    seconds : float

    Returns
    -------
    str
        "40 s", "3 min", "2 h 5 min".
    """
    if seconds < 60:
        return f"{max(10 * round(seconds / 10), 10)} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"
