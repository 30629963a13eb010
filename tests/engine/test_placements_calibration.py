"""Models of certainty: sums of evidence and of reasons, and signs that hold whatever they were fitted to."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geoanalogy.placements.calibration import (
    ABROAD,
    AGAINST,
    ALONE,
    AT_HOME,
    CIRCUMSTANCES,
    OFFSET,
    WORTH,
    Calibration,
    Judgement,
)
from geoanalogy.placements.evidence import SINGLE

MODELS = {
    f"{where} {stage}": getattr(judgement, stage)
    for where, judgement in (("at home", AT_HOME), ("abroad", ABROAD), ("alone", ALONE))
    for stage in ("glance", "look", "settle", "choose")
    if getattr(judgement, stage) is not None
}


def test_evidence_is_added_up():
    model = Calibration(("row", "covered"), np.array([2.0, -1.0]), 0.5)
    assert np.allclose(model.value(np.array([[1.0, 0.0], [0.5, 2.0]])), [2.5, -0.5])
    assert np.allclose(model.certainty(np.array([[0.0, 0.5]])), [0.5])


def test_reasons_saturate():
    model = Calibration(
        ("row", "column"), np.zeros(2), -1.0, np.array([[3.0], [3.0]]), np.array([-4.5]), np.array([2.0])
    )
    neither, one, both = model.value(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]))
    assert np.allclose([neither, one, both], -1 + 2 * np.tanh([-4.5, -1.5, 1.5]))
    assert one - neither < 0.3 < both - one, "a row alone says little, at a column much"


def test_a_table_names_what_it_weighs():
    stage = {OFFSET: "-1 .5 0", WORTH: "2 3", "similarity": "1 0 4", "outside": "-2 -1 0"}
    rest = {OFFSET: "0"}
    model = Judgement.of({"glance": stage, "look": rest, "settle": rest}).glance
    at = {name: i for i, name in enumerate(SINGLE)}
    evidence = np.zeros((1, len(SINGLE)))
    evidence[0, at["similarity"]], evidence[0, at["outside"]] = 0.5, 0.25
    expected = -1 + 0.5 - 0.5 + 2 * np.tanh(0.5 - 0.25) + 3 * np.tanh(4 * 0.5)
    assert np.allclose(model.value(evidence), expected)


@pytest.mark.parametrize("name", MODELS)
@given(seed=st.integers(0, 2**32 - 1), column=st.integers(0, 1000), more=st.floats(0.01, 1.0))
def test_evidence_for_never_lowers_and_evidence_against_never_raises_certainty(name, seed, column, more):
    model = MODELS[name]
    evidence = np.random.default_rng(seed).uniform(0, 1, (20, len(model.names)))
    kind = model.names[column % len(model.names)]
    changed = evidence.copy()
    changed[:, column % len(model.names)] += more
    rise = model.value(changed) - model.value(evidence)
    if kind in AGAINST:
        assert (rise <= 1e-9).all(), kind
    elif kind not in CIRCUMSTANCES:
        assert (rise >= -1e-9).all(), kind
