"""Long work in slices: what a modal operator does between two looks at the keyboard."""

from time import perf_counter
from typing import Any

from ..progress import Stepper

#: Least and most seconds that a slice takes, but for a single long step. Between them, as long as the window took to
#: draw since the last one: a slow display takes no more than half of the time.
SHORTEST, LONGEST = 0.02, 0.3


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

    def advance(self, seconds: float | None = None) -> None:
        """Take steps until the time is up or the work is done.

        Parameters
        ----------
        seconds : float, optional
            None: as long as nothing was done since the last slice, within `SHORTEST` and `LONGEST`.

        Raises
        ------
        InputError
            What a step raised; the work is over then.
        """
        if seconds is None:
            seconds = min(max(perf_counter() - self._paused, SHORTEST), LONGEST)
        until = perf_counter() + seconds
        while not self.finished:
            try:
                self.fraction, self.text = next(self._stepper)
            except StopIteration as end:
                self.finished, self.result = True, end.value
            if perf_counter() >= until:
                break
        self._paused = perf_counter()

    def cancel(self) -> None:
        """Stop between two steps; nothing has been written."""
        self._stepper.close()
