"""How evidence adds up to certainty: logistic models, fitted to real layouts.

Fitted by ``benchmarks/placements_calibration.py`` to the development halves of the facades, plots and rooms: evidence
that speaks for a candidate can only raise its certainty, evidence against only lower it, so that nothing is more
certain than a perfect copy of an example's surroundings.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .calibration_table import TABLE
from .company import AMONG
from .evidence import SINGLE
from .one_each import ONE_EACH

Array = NDArray[np.float64]

#: Names of the last columns: the value of the previous model, and `AMONG` by its certainty.
SETTLED = ("first impression", *(f"{name} by certainty" for name in AMONG))

#: Evidence against a candidate: its weight is not positive.
AGAINST = frozenset(
    (
        "shortfall",
        "broken habit",
        "unexplained",
        "missed anchor",
        "missed along x",
        "missed along y",
        "misaligned along x",
        "misaligned along y",
        "shape",
        "beyond shapes",
        "covered",
        "uncovered",
        "touched",
        "outside",
        "relative size",
        "nearer",
        "freed",
        "off walls",
    )
)
#: What is the same for all candidates of an arrangement: its weight may have either sign.
CIRCUMSTANCES = frozenset(
    ("reliability", "reliability along x", "reliability along y", "reliability in parent", "cohesion", "number")
)


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
        # A product so small is summed faster than it is spread over threads.
        return np.einsum("nf,f->n", evidence, self.weights) + self.offset

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


@dataclass(frozen=True)
class Judgement:
    """The models that rate candidates, one after another.

    Attributes
    ----------
    glance : Calibration
        From the nearest elements alone: what is worth a look.
    look : Calibration
        From all relations of a candidate.
    settle : Calibration
        Together with what else is likely in its row, its column and its place.
    choose : Calibration or None
        Where there is one placement: which of the candidates it is. Odds among each other, not of each.
    """

    glance: Calibration
    look: Calibration
    settle: Calibration
    choose: Calibration | None = None

    @classmethod
    def of(cls, table: dict[str, dict[str, float]], single: tuple[str, ...] = SINGLE) -> "Judgement":
        """The models of a table of weights by the name of the evidence.

        Parameters
        ----------
        table : dict of str to dict of str to float
        single : tuple of str
            Names of the evidence of a single candidate.

        Returns
        -------
        Judgement
        """
        names = {
            "glance": single,
            "look": single + AMONG,
            "settle": single + AMONG + SETTLED,
            "choose": single + AMONG + SETTLED,
        }
        return cls(
            **{
                stage: Calibration(
                    names[stage], np.array([weights.get(n, 0.0) for n in names[stage]]), weights["offset"]
                )
                for stage, weights in table.items()
            }
        )


#: Where examples were drawn in the very arrangement: their rows and columns go on.
AT_HOME = Judgement.of(TABLE["at home"])
#: Where they were drawn elsewhere: only relations to what is there can tell.
ABROAD = Judgement.of(TABLE["abroad"])
#: Where every parent holds one of them.
ALONE = Judgement.of(TABLE.get("alone", TABLE["abroad"]), SINGLE + ONE_EACH)
