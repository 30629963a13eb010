"""How often pose propagation puts real furniture where it stands, beside a trivial copy, in the same run.

Reads `ifc_rooms` and `r2v_floorplans` below the folder named by GEOANALOGY_DATA. The trivial copy puts the object at
the same fractions of the room's bounding box, in the same direction.
"""

from __future__ import annotations

import json
import os
import time
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import mean, median
from typing import Any

import numpy as np
import shapely

import geoanalogy as ga

from .measuring import Table, duration

#: Depth of a door or window as a polygon inside its room, metres.
DEPTH = 0.1
#: Greatest distance of a right answer in metres, or as a share of a fixture's room, whose scale is an estimate.
NEAR, NEAR_SHARE = 0.3, 0.1
#: Greatest angle between a right answer and the truth.
TURN = np.radians(15)
#: Right turned by 180° as well: both senses occur in the models, or cannot be told.
BOTH_WAYS = ("table", "counter", "vanity", "desk", "bathtub")
#: Whose direction the data do not know.
ANY_WAY = ("chair", "washing_basin")

#: Fixtures and the rooms that they stand in.
FIXTURES = {"toilet": "restroom", "bathtub": "bathroom", "washing_basin": "washing_room", "cooking_counter": "kitchen"}
TARGETS = 8

Array = np.ndarray


@dataclass(frozen=True)
class Target:
    """Where an object is known to stand: the room's id and outline, the pose (x, y, angle), and what is near enough."""

    room: str
    outline: Array
    truth: tuple[float, float, float]
    near: float


@dataclass(frozen=True)
class Case:
    """An example, and the rooms in which the same object is looked for."""

    name: str
    label: str
    scene: ga.Scene
    pose: tuple[float, float, float]
    footprint: Array
    source: Array
    targets: Sequence[Target]


@dataclass(frozen=True)
class Outcome:
    """What came of one target."""

    first: bool
    four: bool
    copy: bool
    fate: str


#: What becomes of a target's first result: right, or how far it is another good answer.
FATES = ("right", "mirrored", "along the wall", "mirrored, along the wall", "elsewhere", "no result")


def is_right(pose: Sequence[float], target: Target, label: str) -> bool:
    """Whether a pose is where the object stands, and faces as it does where that is known."""
    if np.hypot(pose[0] - target.truth[0], pose[1] - target.truth[1]) > target.near:
        return False
    if any(name in label for name in ANY_WAY):
        return True
    senses = 2 if any(name in label for name in BOTH_WAYS) else 1
    return bool(abs(np.angle(np.exp(1j * senses * (pose[2] - target.truth[2])))) / senses <= TURN)


def copied(case: Case, target: Target) -> tuple[float, float, float]:
    """The trivial copy."""
    low, size = case.source.min(axis=0), np.ptp(case.source, axis=0)
    x, y = target.outline.min(axis=0) + (np.array(case.pose[:2]) - low) / size * np.ptp(target.outline, axis=0)
    return float(x), float(y), case.pose[2]


def images(pose: Sequence[float], outline: Array) -> list[tuple[float, float, float]]:
    """A pose mirrored across the two axes of a room's bounding box, and turned about its centre."""
    x, y, angle = pose[:3]
    across_x, across_y = outline.min(axis=0) + outline.max(axis=0) - (x, y)
    return [(across_x, y, np.pi - angle), (x, across_y, -angle), (across_x, across_y, angle + np.pi)]


def slides(pose: Sequence[float], target: Target, label: str) -> bool:
    """Whether a pose becomes right by a move along one side of the room's bounding box."""
    x, y, angle = pose[:3]
    return any(is_right(moved, target, label) for moved in ((target.truth[0], y, angle), (x, target.truth[1], angle)))


def fate(pose: Sequence[float] | None, target: Target, label: str) -> str:
    """Which of `FATES` a first result has: rooms leave people a choice of sides, and of places along a wall."""
    if pose is None:
        return "no result"
    mirrored = images(pose, target.outline)
    checks = (
        is_right(pose, target, label),
        any(is_right(image, target, label) for image in mirrored),
        slides(pose, target, label),
        any(slides(image, target, label) for image in mirrored),
    )
    return next((name for name, holds in zip(FATES, checks, strict=False) if holds), "elsewhere")


def run(case: Case) -> tuple[list[Outcome], float]:
    """Propagate, and look into every target room; with the seconds it took."""
    start = time.perf_counter()
    results = ga.propagate_pose(case.scene, ga.Pose(case.pose[:2], case.pose[2]), case.footprint)
    taken = time.perf_counter() - start
    found = [(shapely.Point(r.pose.position), (*r.pose.position, r.pose.angle)) for r in results]
    outcomes = []
    for target in case.targets:
        room = shapely.Polygon(target.outline).buffer(DEPTH / 2)
        inside = [pose for point, pose in found if room.contains(point)][:4]
        right = [is_right(pose, target, case.label) for pose in inside]
        outcomes.append(
            Outcome(
                any(right[:1]),
                any(right),
                is_right(copied(case, target), target, case.label),
                fate(inside[0] if inside else None, target, case.label),
            )
        )
    return outcomes, taken


def opening(segment: Array, outline: Array, label: str, name: str, room: str) -> ga.Polygon | None:
    """A door or window as a thin rectangle inside its room; None where it has no length."""
    a, b = np.asarray(segment, dtype=float)
    length = float(np.hypot(*(b - a)))
    if length < DEPTH / 2:
        return None
    inwards = DEPTH * np.array([a[1] - b[1], b[0] - a[0]]) / length
    if not shapely.Polygon(outline).buffer(1e-6).contains(shapely.Point((a + b) / 2 + inwards / 2)):
        inwards = -inwards
    return ga.Polygon([a, b, b + inwards, a + inwards], label, name, parent=room)


def own_frame(ring: Array, pose: Sequence[float]) -> Array:
    """A ring in the frame of a pose."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return (np.asarray(ring) - pose[:2]) @ np.array([[c, -s], [s, c]])


# ------------------------------------------------------------------------------------------------ buildings


def rooms_of(path: Path) -> list[dict[str, Any]]:
    """The rooms of a building, storeys side by side."""
    rooms = json.loads(path.read_text("utf-8"))["rooms"]
    x = [p[0] for r in rooms for p in r["polygon"]]
    storeys = list(dict.fromkeys(r["storey"] for r in rooms))
    for r in rooms:
        aside = np.array([1.5 * (max(x) - min(x)) * storeys.index(r["storey"]), 0.0])
        r["polygon"] = np.array(r["polygon"]) + aside
        for o in r["doors"] + r["windows"]:
            o["segment"] = np.array(o["segment"]) + aside
        for f in r["furniture"] or []:
            f["polygon"] = np.array(f["polygon"]) + aside
            f["pose"] = (*(np.array(f["center"]) + aside), np.radians(f["angle_deg"]))
    return rooms


def shell(rooms: Iterable[dict[str, Any]]) -> list[ga.Polygon]:
    """Rooms with their doors and windows."""
    found: list[ga.Polygon | None] = []
    for r in rooms:
        found.append(ga.Polygon(r["polygon"], r["label"], r["id"]))
        for kind in ("door", "window"):
            for i, o in enumerate(r[f"{kind}s"]):
                found.append(opening(o["segment"], r["polygon"], kind, f"{r['id']} {kind} {i}", r["id"]))
    return [p for p in found if p is not None]


def furniture(rooms: Iterable[dict[str, Any]], *without: dict[str, Any]) -> list[ga.Polygon]:
    """What stands in rooms, but for some pieces."""
    return [
        ga.Polygon(f["polygon"], f["label"], f"{r['id']} {i}", parent=r["id"])
        for r in rooms
        for i, f in enumerate(r["furniture"] or [])
        if not any(f is w for w in without)
    ]


def flats(folder: Path) -> Iterator[Case]:
    """Every piece of flat A to flat B, which is flat A turned by 180°; with the other furniture, and without."""
    rooms = rooms_of(folder / "duplex.json")
    of = {r["number"]: r for r in rooms}
    # The same space, which the model names only in one flat.
    of["B105"]["label"] = of["A105"]["label"]
    pairs = [(r, of[f"B{number[1:]}"]) for number, r in of.items() if number.startswith("A")]
    for a, b in pairs:
        centre = (a["polygon"].mean(axis=0) + b["polygon"].mean(axis=0)) / 2

        def turned(f: dict[str, Any], centre: Array = centre) -> dict[str, Any]:
            place = (*(2 * centre - f["pose"][:2]), f["pose"][2] + np.pi)
            return {**f, "polygon": 2 * centre - f["polygon"], "pose": place}

        # Where the data keep one of the two rooms back, the other one turned stands for it.
        known = {id(r): r["furniture"] for r in (a, b)}
        for r, other in ((a, b), (b, a)):
            if known[id(r)] is None:
                r["furniture"] = [turned(f) for f in known[id(other)] or []]
    for a, b in pairs:
        left = list(b["furniture"])
        centre = (a["polygon"].mean(axis=0) + b["polygon"].mean(axis=0)) / 2
        for piece in a["furniture"]:
            there = 2 * centre - piece["pose"][:2]
            twins = [f for f in left if f["label"] == piece["label"]]
            if not twins:
                continue
            twin = min(twins, key=lambda f, there=there: np.hypot(*(f["pose"][:2] - there)))
            left = [f for f in left if f is not twin]
            for name, others in (("flat, furnished", furniture(rooms, piece, twin)), ("flat, bare", [])):
                target = Target(b["id"], b["polygon"], twin["pose"], NEAR)
                ring = own_frame(piece["polygon"], piece["pose"])
                scene = ga.Scene(shell(rooms) + others)
                yield Case(name, piece["label"], scene, piece["pose"], ring, a["polygon"], [target])


def single_offices(rooms: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """The offices with one desk and one chair."""
    return [
        r
        for r in rooms
        if r["label"] == "office" and sorted(f["label"] for f in r["furniture"] or []) == ["chair", "desk"]
    ]


def offices(folder: Path, sources: int) -> Iterator[Case]:
    """The desk of an office to the others, then the chair to the others' desks."""
    rooms = rooms_of(folder / "AC11-Institute-Var-2-IFC.json")
    furnished = single_offices(rooms)
    piece = {(r["id"], f["label"]): f for r in furnished for f in r["furniture"]}
    for source in furnished[:: max(1, len(furnished) // sources)][:sources]:
        others = [r for r in furnished if r is not source]
        for label in ("desk", "chair"):
            example = piece[source["id"], label]
            x, y, angle = example["pose"]
            if label == "chair":
                # The model's angle says nothing: it faces its desk.
                desk = piece[source["id"], "desk"]["pose"]
                angle = float(np.arctan2(desk[1] - y, desk[0] - x))
            chairs = [piece[r["id"], "chair"] for r in furnished]
            given = furniture(furnished, *chairs) if label == "chair" else []
            yield Case(
                f"office, {label}",
                label,
                ga.Scene(shell(rooms) + given),
                (x, y, angle),
                own_frame(example["polygon"], (x, y, angle)),
                source["polygon"],
                [Target(r["id"], r["polygon"], piece[r["id"], label]["pose"], NEAR) for r in others],
            )


def best_place(folder: Path) -> tuple[int, int]:
    """In how many offices one single place for the desk could be right, chosen knowing all desks; of how many.

    Offices of one desk and one chair are rectangles of one depth and nearly one width, with the door in the same
    corner once they are mirrored or turned; the place is sought in that frame, in steps of 5 cm.
    """
    desks = []
    for r in single_offices(rooms_of(folder / "AC11-Institute-Var-2-IFC.json")):
        low, size = r["polygon"].min(axis=0), np.ptp(r["polygon"], axis=0)
        desk = next(np.array(f["pose"][:2]) for f in r["furniture"] if f["label"] == "desk") - low
        beyond = np.mean(r["doors"][0]["segment"], axis=0) - low > size / 2
        desks.append(np.where(beyond, size - desk, desk))
    known = np.array(desks)
    x, y = (np.arange(0.0, extent, 0.05) for extent in known.max(axis=0) + NEAR)
    apart = np.hypot(x[:, None, None] - known[:, 0], y[None, :, None] - known[:, 1])
    return int((apart <= NEAR).sum(axis=2).max()), len(known)


# ------------------------------------------------------------------------------------------------ fixtures


def fixture_rooms(path: Path) -> dict[str, list[dict[str, Any]]]:
    """By fixture, the rooms that have one of it; each from its own lower left corner, in metres."""
    found = defaultdict(list)
    for plan in json.loads(path.read_text("utf-8")):
        for i, r in enumerate(plan["rooms"]):
            for kind, label in FIXTURES.items():
                own = [f for f in r["furniture"] if f["label"] == kind]
                if r["labels"] != [label] or len(own) != 1:
                    continue
                low = np.min(r["polygon"], axis=0)
                scale = plan["scale_m_per_px"]
                place = lambda p, low=low, scale=scale: (np.array(p, dtype=float) - low) * scale  # noqa: E731
                room = {"id": f"{plan['id']} {i}", "label": label, "polygon": place(r["polygon"])}
                room["openings"] = [place(o) for o in r["openings"]]
                room["box"] = place(np.reshape(own[0]["box"], (2, 2)))
                room["front"] = own[0]["front_deg"]
                found[kind].append(room)
    return found


def fixture_pose(room: dict[str, Any]) -> tuple[float, float, float]:
    """A fixture's centre, and where it faces: as annotated, else along its long side."""
    x, y = room["box"].mean(axis=0)
    wide, high = np.ptp(room["box"], axis=0)
    front = room["front"]
    angle = np.radians(front) if front is not None else (0.0 if wide >= high else np.pi / 2)
    return float(x), float(y), float(angle)


def fixtures(path: Path, cases: int) -> Iterator[Case]:
    """A fixture of one room to rooms of the same label in other plans, laid in a row."""
    for kind, rooms in fixture_rooms(path).items():
        mixed = [rooms[i] for i in np.random.default_rng(0).permutation(len(rooms))]
        for first in range(0, min(len(mixed) - TARGETS, cases * (TARGETS + 1)), TARGETS + 1):
            polygons: list[ga.Polygon | None] = []
            placed = []
            x = 0.0
            for r in mixed[first : first + TARGETS + 1]:
                aside = np.array([x, 0.0])
                moved = {**r, "polygon": r["polygon"] + aside, "box": r["box"] + aside}
                polygons.append(ga.Polygon(moved["polygon"], r["label"], r["id"]))
                for i, o in enumerate(r["openings"]):
                    polygons.append(opening(o + aside, moved["polygon"], "opening", f"{r['id']} opening {i}", r["id"]))
                placed.append(moved)
                x = float(moved["polygon"][:, 0].max()) + 2.0
            source, *others = placed
            pose = fixture_pose(source)
            (x0, y0), (x1, y1) = source["box"].min(axis=0), source["box"].max(axis=0)
            yield Case(
                kind.replace("_", " "),
                kind,
                ga.Scene([p for p in polygons if p is not None]),
                pose,
                own_frame(np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]), pose),
                source["polygon"],
                [
                    Target(r["id"], r["polygon"], fixture_pose(r), NEAR_SHARE * np.hypot(*np.ptp(r["polygon"], axis=0)))
                    for r in others
                ],
            )


# ------------------------------------------------------------------------------------------------ the tables


def tables(full: bool = False) -> Iterator[Table]:
    """The table of this benchmark; `full` takes more sources and more plans."""
    folder = os.environ.get("GEOANALOGY_DATA")
    root = Path(folder or "nowhere")
    rooms, plans = root / "ifc_rooms" / "dev", root / "r2v_floorplans" / "dev" / "plans.json"
    if not (rooms.is_dir() and plans.is_file()):
        print("GEOANALOGY_DATA names no folder with ifc_rooms and r2v_floorplans: quality is not measured.")
        return
    outcomes: dict[str, list[Outcome]] = defaultdict(list)
    taken: dict[str, list[float]] = defaultdict(list)
    for cases in (flats(rooms), offices(rooms, 12 if full else 4), fixtures(plans, 12 if full else 4)):
        for case in cases:
            found, time_taken = run(case)
            outcomes[case.name] += found
            taken[case.name].append(time_taken)
    rows = [
        (
            name,
            len(taken[name]),
            len(some),
            *(f"{mean(getattr(o, key) for o in some):.2f}" for key in ("first", "four", "copy")),
            duration(median(taken[name])),
        )
        for name, some in outcomes.items()
    ]
    yield Table(
        "Furniture of real buildings, fixtures of real flats",
        ("object", "examples", "targets", "first right", "among the first four", "copy", "time"),
        rows,
        f"Shares of targets in which the object is put within {NEAR} m and {np.degrees(TURN):.0f}° of where it stands,"
        f" by one example and the default options. Fixtures: within {NEAR_SHARE:.0%} of the room's diagonal, as the"
        " scale of those plans is an estimate. Where a thing stands is one human choice of several: a mirrored place"
        " counts as wrong.",
    )
    counts = {name: [o.fate for o in some] for name, some in outcomes.items()}
    right, offices_known = best_place(rooms)
    yield Table(
        "What the first result is",
        ("object", *FATES),
        [(name, *(fates.count(f) for f in FATES)) for name, fates in counts.items()],
        "Targets. Mirrored: its image across an axis of the room's bounding box, or turned about the centre, is right."
        " Along the wall: it is right but for a move along a side of that box. Both are answers that another person"
        f" could have given. Even with all desks known, no single place for them is right in more than {right} of the"
        f" {offices_known} offices, which are the same room but for 0.2 m.",
    )
