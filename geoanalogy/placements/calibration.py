"""How evidence adds up to certainty: logistic models, fitted to real layouts.

Fitted by ``benchmarks/placements_calibration.py`` to the development halves of the facades, plots and rooms: evidence
that speaks for a candidate can only raise its certainty, evidence against only lower it, so that nothing is more
certain than a perfect copy of an example's surroundings.

What some evidence is worth depends on other evidence: a row of examples says much at a column of examples and little
where something else stands already. The last models therefore add up a few reasons, each a sum of evidence that
saturates; they keep to the signs as well.
"""

from dataclasses import dataclass, field

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
    reasons : ndarray of shape (f, r)
        Weights of the evidence in each of r reasons; nothing where evidence is only added up.
    thresholds, worth : ndarray of shape (r,)
        Offset of each reason's sum, and how much it counts between -1 and 1 of it; the worth is not negative.
    """

    names: tuple[str, ...]
    weights: Array
    offset: float
    reasons: Array = field(default_factory=lambda: np.zeros((0, 0)))
    thresholds: Array = field(default_factory=lambda: np.zeros(0))
    worth: Array = field(default_factory=lambda: np.zeros(0))

    def value(self, evidence: Array) -> Array:
        """Log odds of rows of evidence.

        Parameters
        ----------
        evidence : ndarray of shape (n, f)

        Returns
        -------
        ndarray of shape (n,)
        """
        # Products so small are summed faster than they are spread over threads.
        value = np.einsum("nf,f->n", evidence, self.weights) + self.offset
        if len(self.worth):
            value += np.einsum(
                "nr,r->n", np.tanh(np.einsum("nf,fr->nr", evidence, self.reasons) + self.thresholds), self.worth
            )
        return value

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
    def of(cls, table: dict[str, dict[str, str]], single: tuple[str, ...] = SINGLE) -> "Judgement":
        """The models of a table of weights by the name of the evidence.

        Parameters
        ----------
        table : dict of str to dict of str to str
            By stage, then by evidence: its weight, and those in each reason; with the `OFFSET` and the `WORTH`.
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
        return cls(**{stage: _read(names[stage], rows) for stage, rows in table.items()})


def _read(names: tuple[str, ...], rows: dict[str, str]) -> Calibration:
    """The model of one stage of the table."""
    offset, *thresholds = map(float, rows[OFFSET].split())
    nothing = "0" + " 0" * len(thresholds)
    weights = np.array([rows.get(name, nothing).split() for name in names], dtype=np.float64)
    worth = np.array(rows.get(WORTH, "").split(), dtype=np.float64)
    return Calibration(names, weights[:, 0], offset, weights[:, 1:], np.array(thresholds), worth)


#: Rows of the table that are no evidence: the offset and the thresholds of the reasons; the worth of the reasons.
OFFSET, WORTH = "offset", "worth of reasons"


#: Where examples were drawn in the very arrangement: their rows and columns go on.
AT_HOME = Judgement.of(TABLE["at home"])
#: Where they were drawn elsewhere: only relations to what is there can tell.
ABROAD = Judgement.of(TABLE["abroad"])
#: Where every parent holds one of them.
ALONE = Judgement.of(TABLE.get("alone", TABLE["abroad"]), SINGLE + ONE_EACH)
