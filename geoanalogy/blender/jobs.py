"""Long work in slices: what a modal operator does between two looks at the keyboard."""

from time import perf_counter
from typing import Any
from weakref import WeakSet

import bpy

from ..errors import InputError
from ..progress import Stepper

#: Least and most seconds that a slice takes, but for a single long step. Between them, as long as the window took to
#: draw since the last one: a slow display takes no more than half of the time.
SHORTEST, LONGEST = 0.02, 0.3

#: What jobs know by its address, and another window may delete between two slices.
COUNTED = ("objects", "collections", "scenes", "node_groups", "meshes", "curves", "images")

#: Jobs that are neither finished nor cancelled. Another window may change meanwhile what they work on.
_at_work: WeakSet["Job"] = WeakSet()


def at_work() -> bool:
    """Whether any job is at work, in whatever window."""
    return bool(_at_work)


def stop_jobs(why: str) -> None:
    """Stop all jobs before what they work on is freed: they know objects and nodes, and must not touch them again.

    Parameters
    ----------
    why : str
        A sentence that the next slice of each raises.
    """
    for job in list(_at_work):
        job.stop(why)


def _counts() -> list[int]:
    """How many there are of what is counted: nobody deletes and adds equally many between two slices."""
    return [len(getattr(bpy.data, kind)) for kind in COUNTED]


class Job:
    """A stepper that is advanced in slices.

    Parameters
    ----------
    stepper : generator of (float, str)

    Attributes
    ----------
    fraction : float
        How much is done, 0 to 1.
    text : str
        What is being done.
    finished : bool
        Whether it has come to its end.
    result : object
        What the stepper returned.
    """

    def __init__(self, stepper: Stepper[Any]) -> None:
        self._stepper = stepper
        self.fraction, self.text = 0.0, ""
        self.finished = False
        self.result: Any = None
        self._paused = perf_counter()
        self._advancing, self._stopped = False, ""
        self._counts = _counts()
        _at_work.add(self)

    def advance(self, seconds: float | None = None) -> None:
        """Take steps until the time is up or the work is done.

        Parameters
        ----------
        seconds : float, optional
            None: as long as nothing was done since the last slice, within `SHORTEST` and `LONGEST`.

        Raises
        ------
        InputError
            What a step raised, or why the job was stopped; the work is over then.
        """
        if self._counts != _counts():
            self.stop("something was added or deleted while the scene was being worked on; start again")
        if self._stopped:
            raise InputError(self._stopped)
        if seconds is None:
            seconds = min(max(perf_counter() - self._paused, SHORTEST), LONGEST)
        self._advancing = True
        try:
            self._take_steps(perf_counter() + seconds)
        except BaseException:
            _at_work.discard(self)
            raise
        finally:
            self._advancing = False
            self._counts = _counts()
            self._paused = perf_counter()

    def _take_steps(self, until: float) -> None:
        while not self.finished:
            try:
                self.fraction, self.text = next(self._stepper)
            except StopIteration as end:
                self.finished, self.result = True, end.value
                _at_work.discard(self)
            if perf_counter() >= until:
                break

    def cancel(self) -> None:
        """Stop between two steps; nothing has been written."""
        self._stepper.close()
        _at_work.discard(self)

    def stop(self, why: str) -> None:
        """Stop between two steps, and say why at the next slice; within a step, what happens is the job's own doing.

        Parameters
        ----------
        why : str
        """
        if not self._advancing:
            self.cancel()
            self._stopped = why
