"""Long work as steppers: generators that yield ``(fraction, text)`` and return their result.

A stepper never knows who drives it: a modal operator takes a few steps per timer event, a batch runs it to its end, and
both can stop between two steps.
"""

from collections.abc import Callable, Generator
from typing import TypeVar

from .arguments import shown
from .errors import Cancelled, InputError

Result = TypeVar("Result")
Step = tuple[float, str]
Stepper = Generator[Step, None, Result]
Progress = Callable[[float, str], bool]


def run(stepper: Stepper[Result], progress: Progress | None = None) -> Result:
    """Drive a stepper to its end.

    Parameters
    ----------
    stepper : generator of (float, str)
        Yields the finished fraction, from 0 to 1, and what is being done; returns its result.
    progress : callable (fraction, text) -> bool, optional
        Called once per step; returning False cancels.

    Returns
    -------
    object
        What the stepper returned.

    Raises
    ------
    InputError
        For a `progress` that cannot be called.
    Cancelled
        When `progress` returned False.

    Examples
    --------
    >>> def count():
    ...     for i in range(3):
    ...         yield i / 3, "counting"
    ...     return "counted"
    >>> run(count())
    'counted'
    """
    if progress is not None and not callable(progress):
        raise InputError(f"progress is {shown(progress)}; give a callable (fraction, text) -> bool, or leave it out")
    while True:
        try:
            fraction, text = next(stepper)
        except StopIteration as end:
            return end.value
        if progress is not None and progress(fraction, text) is False:
            stepper.close()
            raise Cancelled(text)


def within(stepper: Stepper[Result], start: float, end: float) -> Stepper[Result]:
    """A stepper whose fractions run from `start` to `end`: one stage of a longer stepper.

    Parameters
    ----------
    stepper : generator of (float, str)
        The stage; its fractions run from 0 to 1.
    start, end : float
        The part of the whole that the stage takes.

    Returns
    -------
    generator of (float, str)
        Returns what the stage returned (use it with ``yield from``).
    """
    while True:
        try:
            fraction, text = next(stepper)
        except StopIteration as done:
            return done.value
        yield start + (end - start) * fraction, text
