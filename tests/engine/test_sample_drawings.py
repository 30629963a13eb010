"""The drawn pictures: inside their sheets, with queries that hold, and true where they say that something belongs."""

import numpy as np
import pytest
import shapely
from scipy.spatial import cKDTree

from sample_blends.drawings import SCENES
from sample_blends.drawings.truth import measure, options_of, picture_of

#: Distance of a line from where the truth puts it, in diagonals of the place: what an unsteady hand leaves.
UNSTEADY = 0.012

#: Share of a shape's lines that others may hide.
HIDDEN = 0.4


@pytest.fixture(scope="module", params=SCENES)
def picture(request):
    return picture_of(request.param)


def test_all_lines_lie_on_the_sheet(picture):
    lines = np.vstack(picture.polylines)
    assert np.isfinite(lines).all()
    # Blades of grass and scribbles may run off it.
    inside = ((lines >= picture.low) & (lines <= picture.high)).all(axis=1)
    assert inside.mean() > 0.97


def test_queries_are_what_the_engine_takes(picture):
    for edit in picture.edits:
        assert options_of(edit).query_kind == ("region" if edit.closed else "stroke")
        if edit.closed:
            assert shapely.polygons(edit.query).is_valid
        places = np.vstack([truth(np.asarray(edit.query)) for truth in edit.truth])
        assert np.isfinite(places).all()


def test_the_truth_leads_from_lines_to_lines(picture):
    drawn = cKDTree(np.vstack(picture.polylines))
    for edit in picture.edits:
        own = np.vstack(picture.polylines)
        near = edit.region if edit.closed else shapely.linestrings(edit.query).buffer(0.05)
        own = own[shapely.contains_xy(near.buffer(-1e-3), own[:, 0], own[:, 1])]
        painted = own[edit.paint(own)[:, 3] > 0.05]
        assert len(painted) > 20
        for truth in edit.truth:
            there = truth(painted)
            size = np.linalg.norm(np.ptp(truth(np.asarray(edit.query)), axis=0))
            gaps = drawn.query(there)[0] / size
            assert np.quantile(gaps, 1.0 - HIDDEN) < UNSTEADY
            assert not np.allclose(there.mean(axis=0), painted.mean(axis=0), atol=0.05 * size)


def test_maps_of_truth_turn_nothing_inside_out(picture):
    step = 1e-3
    for edit in picture.edits:
        if not edit.closed:
            continue
        inside = np.vstack(picture.polylines)
        inside = inside[shapely.contains_xy(edit.region, inside[:, 0], inside[:, 1])]
        for truth in edit.truth:
            there = truth(inside)
            x, y = ((truth(inside + d) - there) / step for d in ((step, 0.0), (0.0, step)))
            area = x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0]
            assert max((area > 0.0).mean(), (area < 0.0).mean()) > 0.99


@pytest.mark.parametrize("name", ["corals", "flowers", "sun"])
def test_everything_alike_is_found_and_nothing_else(name):
    picture = picture_of(name)
    for edit in picture.edits:
        row = measure(picture, edit)
        assert row.found == row.places and row.false == 0
        assert row.error < 0.02
        assert 0.0 < row.inliers < row.weighted < 1.0
