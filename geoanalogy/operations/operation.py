"""The interface of all operations of the tree (section 5.6)."""

import json
from abc import ABC, abstractmethod
from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Self

from ..geometry.polygon import Polygon
from ..progress import Stepper
from .layout import Layout
from .settings import read_settings, write_settings


@dataclass(frozen=True, kw_only=True)
class Operation(ABC):
    """What a node of the tree does. A subclass per kind of operation, a field per setting.

    An operation is evaluated in two parts. `propose` does the work and is kept: it is evaluated again only when its
    settings or the polygons that it reads have changed. `decide` makes the outgoing layouts from that at little cost;
    what only sifts (thresholds, decisions by hand) belongs there, and its settings are marked as late.

    Attributes
    ----------
    type : str
        Its name in files and menus.
    outputs : int
        Number of layouts it gives: 1, but for selections into several sets.
    random : bool
        Whether chance has a part in what it proposes.
    """

    type: ClassVar[str]
    outputs: ClassVar[int] = 1
    random: ClassVar[bool] = False

    @abstractmethod
    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[Any]:
        """The costly part, as a stepper.

        Parameters
        ----------
        layout : Layout
            What comes in.
        node : str
            Id of the node that is evaluated.
        seed : int
            Of this node: chance must come from it alone.

        Returns
        -------
        generator of (float, str)
            Returns what `decide` needs.
        """

    @abstractmethod
    def decide(self, proposed: Any, layout: Layout, node: str) -> tuple[Layout, ...]:
        """The cheap part.

        Parameters
        ----------
        proposed : object
            What `propose` returned; not to be changed.
        layout : Layout
            What comes in.
        node : str
            Id of the node that is evaluated.

        Returns
        -------
        tuple of Layout
            As many as `outputs`.
        """

    def reads(self, layout: Layout) -> Iterable[Polygon]:
        """The polygons of the incoming scene that `propose` depends on; all, unless it knows better.

        Parameters
        ----------
        layout : Layout

        Returns
        -------
        iterable of Polygon
            In the scene's order.
        """
        return layout.scene.polygons

    def content(self, layout: Layout) -> tuple[Hashable, ...]:
        """All that `propose` depends on but its node and seed, hashable.

        Parameters
        ----------
        layout : Layout

        Returns
        -------
        tuple
        """
        return (self._lesson, *(polygon.content for polygon in self.reads(layout)))

    @cached_property
    def _lesson(self) -> str:
        return json.dumps([self.type, write_settings(self, late=False)], sort_keys=True)

    def to_dict(self) -> dict[str, Any]:
        """Its settings as plain data, as they are written to JSON.

        Returns
        -------
        dict
            Without those at their defaults.
        """
        return write_settings(self)

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> Self:
        """The operation that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        Operation

        Raises
        ------
        InputError
            For settings that are missing, unknown or damaged.
        """
        return cls(**read_settings(cls, plain, f"the operation {cls.type!r}"))
