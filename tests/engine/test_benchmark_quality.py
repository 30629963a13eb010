"""What counts as right in the benchmark of real rooms, and that it runs on files of their form."""

import json

import numpy as np
import pytest

from benchmarks import poses_cases as cases
from benchmarks import poses_quality as quality

ROOM = np.array([(0.0, 0), (4, 0), (4, 2), (0, 2)])


def target(angle=0.0):
    return cases.Target("r", ROOM, (1.0, 1.0, angle), 0.3)


@pytest.mark.parametrize(
    ("pose", "label", "right"),
    [
        ((1.0, 1.29, 0.0), "bed", True),
        ((1.0, 1.31, 0.0), "bed", False),
        ((1.0, 1.0, np.radians(14)), "bed", True),
        ((1.0, 1.0, np.radians(16)), "bed", False),
        ((1.0, 1.0, np.radians(361)), "bed", True),
        ((1.0, 1.0, np.pi), "bed", False),
        ((1.0, 1.0, np.pi), "desk", True),
        ((1.0, 1.0, np.pi / 2), "desk", False),
        ((1.0, 1.0, 2.0), "chair", True),
    ],
)
def test_what_is_right(pose, label, right):
    assert quality.is_right(pose, target(), label) == right


def test_an_opening_lies_inside_its_room_whichever_way_it_is_drawn():
    for segment in ([(1, 0), (2, 0)], [(2, 0), (1, 0)]):
        door = cases.opening(segment, ROOM, "door", "d", "r")
        assert door.bounds == pytest.approx([1, 0, 2, cases.DEPTH])
    assert cases.opening([(1, 0), (1.01, 0)], ROOM, "door", "d", "r") is None


def test_a_ring_in_its_own_frame_is_the_same_seen_from_there():
    pose = (1.0, 2.0, 0.7)
    ring = np.array([(2.0, 2), (3, 5), (0, 1)])
    assert cases.ga.Pose(pose[:2], pose[2]).to_scene(cases.own_frame(ring, pose)) == pytest.approx(ring)


def test_without_the_data_it_says_so(monkeypatch, capsys):
    monkeypatch.delenv("GEOANALOGY_DATA", raising=False)
    assert list(quality.tables()) == []
    assert capsys.readouterr().out.startswith("GEOANALOGY_DATA names no folder with ifc_rooms")


def plan(number, width):
    room = {
        "labels": ["restroom"],
        "polygon": [[0, 0], [width, 0], [width, 150], [0, 150]],
        "openings": [[[10, 0], [80, 0]]],
        "furniture": [{"label": "toilet", "box": [width / 2 - 20, 90, width / 2 + 20, 150], "front_deg": 270}],
    }
    return {"id": f"p{number}", "scale_m_per_px": 0.01, "rooms": [room]}


def test_fixtures_of_rooms_that_are_alike_are_found(tmp_path, monkeypatch):
    plans = tmp_path / "r2v_floorplans" / "dev" / "plans.json"
    plans.parent.mkdir(parents=True)
    plans.write_text(json.dumps([plan(i, 90 + 5 * i) for i in range(cases.TARGETS + 2)]))
    (tmp_path / "ifc_rooms" / "dev").mkdir(parents=True)
    monkeypatch.setenv("GEOANALOGY_DATA", str(tmp_path))
    monkeypatch.setattr(quality, "flats", lambda folder: iter(()))
    monkeypatch.setattr(quality, "offices", lambda folder, sources: iter(()))
    monkeypatch.setattr(quality, "best_place", lambda folder: (6, 14))
    shares, fates = quality.tables()
    (row,) = shares.rows
    assert row[:6] == ("toilet", 1, cases.TARGETS, "1.00", "1.00", "1.00")
    assert fates.rows == [("toilet", cases.TARGETS, 0, 0, 0, 0, 0)]
    assert "more than 6 of the 14 offices" in fates.note


@pytest.mark.parametrize(
    ("pose", "name"),
    [
        ((1.0, 1.0, 0.0), "right"),
        ((3.0, 1.0, np.pi), "mirrored"),
        ((1.9, 1.0, 0.0), "along the wall"),
        ((1.0, 0.5, 0.0), "along the wall"),
        ((2.3, 1.0, np.pi), "mirrored, along the wall"),
        ((1.0, 1.0, np.pi / 2), "elsewhere"),
        (None, "no result"),
    ],
)
def test_a_first_result_is_right_or_another_good_answer(pose, name):
    assert quality.fate(pose, target(), "bed") == name


def office(number, door, desk):
    return {
        "id": f"o{number}",
        "label": "office",
        "storey": "0",
        "polygon": [[0, 0], [2.8, 0], [2.8, 4.4], [0, 4.4]],
        "doors": [{"segment": door}],
        "windows": [],
        "furniture": [
            {"label": label, "center": desk, "angle_deg": 0, "polygon": [desk]} for label in ("desk", "chair")
        ],
    }


def test_the_best_single_place_is_counted_from_the_door(tmp_path):
    # The second room is the first one turned by 180°, the third has its desk at the other wall.
    below, above = [[0.2, 0], [1.2, 0]], [[2.6, 4.4], [1.6, 4.4]]
    rooms = [office(1, below, [0.4, 2.0]), office(2, above, [2.4, 2.5]), office(3, below, [2.4, 2.0])]
    (tmp_path / "AC11-Institute-Var-2-IFC.json").write_text(json.dumps({"rooms": rooms}))
    assert quality.best_place(tmp_path) == (2, 3)
