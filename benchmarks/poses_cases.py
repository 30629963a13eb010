"""Real rooms with known furniture, as cases of pose propagation: two flats, offices, fixtures of annotated plans."""

from __future__ import annotations

import json
import random
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import shapely

import geoanalogy as ga

#: Depth of a door or window as a polygon inside its room, metres.
DEPTH = 0.1
#: Greatest distance of a right answer in metres, or as a share of a fixture's room, whose scale is an estimate.
NEAR, NEAR_SHARE = 0.3, 0.1

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
    mixed = list(furnished)
    random.Random("offices").shuffle(mixed)
    for source in mixed[:sources]:
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
