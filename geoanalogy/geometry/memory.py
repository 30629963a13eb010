"""What was derived from a scene, kept for the next query (relation fields depend on the scene, not on the example)."""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any, Protocol


class Sized(Protocol):
    """Anything that knows how much memory it holds."""

    @property
    def nbytes(self) -> int:
        """Bytes held."""


class Memory:
    """Derived things by a key of their content; the least recently used are forgotten when there are too many.

    Scenes made from one another share one, so that an edit in a room forgets nothing about the others.

    Parameters
    ----------
    limit : int
        Bytes to hold at the most.
    """

    def __init__(self, limit: int = 256 << 20) -> None:
        self.limit = limit
        self._kept: OrderedDict[Hashable, Any] = OrderedDict()

    def __len__(self) -> int:
        return len(self._kept)

    def recall(self, key: Hashable, derive: Callable[[], Any]) -> Any:
        """What is kept under a key, derived now where nothing is.

        Parameters
        ----------
        key : hashable
            Names the content completely.
        derive : callable
            Makes what has `nbytes`.

        Returns
        -------
        object
        """
        if key in self._kept:
            self._kept.move_to_end(key)
            return self._kept[key]
        made = self._kept[key] = derive()
        return made

    def settle(self) -> None:
        """Forget the least recently used until the rest fits the limit.

        Called between queries: things grow while they are used.
        """
        total = sum(thing.nbytes for thing in self._kept.values())
        while total > self.limit and len(self._kept) > 1:
            total -= self._kept.popitem(last=False)[1].nbytes

    def clear(self) -> None:
        """Forget everything."""
        self._kept.clear()
