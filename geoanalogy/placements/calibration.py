"""How evidence adds up to certainty: three logistic models, fitted to real layouts.

Fitted by ``benchmarks/placements_calibration.py`` to the development halves of the facades, plots and rooms: evidence
that speaks for a candidate can only raise its certainty, evidence against only lower it, so that nothing is more
certain than a perfect copy of an example's surroundings.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .calibration_table import TABLE
from .evidence import AMONG, SINGLE

Array = NDArray[np.float64]

#: Names of the last columns: the value of the previous model, and `AMONG` by its certainty.
SETTLED = ("first impression", *(f"{name} by certainty" for name in AMONG))

#: Evidence against a candidate: its weight is not positive.
AGAINST = frozenset(
    (
        "missed anchor",
        "missed along x",
        "missed along y",
        "shape",
        "mean shape",
        "covered",
        "uncovered",
        "touched",
        "outside",
    )
)
#: What is the same for all candidates of an arrangement: its weight may have either sign.
CIRCUMSTANCES = frozenset(("absent", "reliability", "reliability along x", "reliability along y", "cohesion", "number"))


@dataclass(frozen=True)
class Calibration:
    """A logistic model.

    Attributes
    ----------
    names : tuple of str
        Of the columns of evidence.
    weights : ndarray of shape (f,)
    offset : float
    """

    names: tuple[str, ...]
    weights: Array
    offset: float

    def value(self, evidence: Array) -> Array:
        """Log odds of rows of evidence.

        Parameters
        ----------
        evidence : ndarray of shape (n, f)

        Returns
        -------
        ndarray of shape (n,)
        """
        return evidence @ self.weights + self.offset

    def certainty(self, evidence: Array) -> Array:
        """Probability of rows of evidence.

        Parameters
        ----------
        evidence : ndarray of shape (n, f)

        Returns
        -------
        ndarray of shape (n,)
        """
        return 1.0 / (1.0 + np.exp(-np.clip(self.value(evidence), -60.0, 60.0)))


def _calibration(stage: str, names: tuple[str, ...]) -> Calibration:
    weights = TABLE[stage]
    return Calibration(names, np.array([weights.get(name, 0.0) for name in names]), weights["offset"])


#: At a glance: what is worth a look.
GLANCE = _calibration("glance", SINGLE)
#: From all relations of a candidate.
LOOK = _calibration("look", SINGLE + AMONG)
#: Together with what else is likely in its row, its column and its place.
SETTLE = _calibration("settle", SINGLE + AMONG + SETTLED)
