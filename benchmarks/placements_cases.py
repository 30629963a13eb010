"""Cases for the calibration of placements: some rectangles of a layout are shown, the others are to be found."""

import json
from collections import defaultdict

import numpy as np

import geoanalogy as ga
from geoanalogy.placements.boxes import union_overlap

PLACED = ("window", "sill", "balcony", "blind", "cornice", "door", "shop", "deco", "pillar")
#: Cases of every kind of fixture, rooms to be furnished in each, and drawn streets.
ROOM_CASES, ROOMS, DRAWN_CASES = 18, 5, 120


def ring(box):
    x0, y0, x1, y1 = box
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def rectangle(box):
    x0, y0, x1, y1 = box
    return ga.Rectangle((x0 + x1) / 2, (y0 + y1) / 2, x1 - x0, y1 - y0)


def facade_cases(path, rng):
    """Cases of one facade: (layout, kind, scene, examples, boxes to find by parent id)."""
    facade = json.loads(path.read_text())
    rects = [r for r in facade["rects"] if r["box"][2] > r["box"][0] and r["box"][3] > r["box"][1]]
    shown = np.array([r["box"] for r in rects if r["label"] == "facade"] or [(0, 0, facade["width"], facade["height"])])
    whole = (*shown.min(axis=0)[:2], *shown.max(axis=0)[2:])
    for label in PLACED:
        boxes = np.array([r["box"] for r in rects if r["label"] == label], float).reshape(-1, 4)
        counts = [k for k in (1, 2, 4, 6, 10) if len(boxes) >= max(8, k + 4)]
        if not counts:
            continue
        polygons = [ga.Polygon(ring(whole), "facade", "facade", orientation=0.0)]
        polygons += [
            ga.Polygon(ring(r["box"]), r["label"], f"{i}", orientation=0.0)
            for i, r in enumerate(rects)
            if r["label"] not in ("facade", label)
        ]
        scene = ga.Scene(polygons)
        common = label in ("window", "sill", "blind", "balcony", "cornice")
        for k in counts if label == "window" else rng.choice([4, 4, 2, 6][: len(counts)], 2 if common else 1):
            if k not in counts:
                continue
            order = rng.permutation(len(boxes))
            examples, truth = boxes[order[:k]], boxes[order[k:]]
            truth = truth[(union_overlap(truth, examples) <= 0.3).all(axis=1)]
            if len(truth):
                yield path.stem, f"{label} {k}", scene, [(scene, b) for b in examples], truth
        k = 4 if len(boxes) >= 12 else 2
        order = rng.permutation(len(boxes))
        target, low, high = cropped(scene, whole, rng)
        middle = (boxes[:, :2] + boxes[:, 2:]) / 2
        truth = boxes[((middle >= low) & (middle <= high)).all(axis=1)]
        if len(truth) >= 3:
            yield path.stem, f"{label} {k} abroad", target, [(scene, b) for b in boxes[order[:k]]], truth


def cropped(scene, whole, rng):
    """Part of a facade as another facade: whatever was learned of its edges and columns does not hold there."""
    size = np.subtract(whole[2:], whole[:2])
    low = whole[:2] + size * rng.uniform(0, 0.4, 2)
    high = whole[2:] - size * rng.uniform(0, 0.4, 2)
    polygons = [ga.Polygon(ring((*low, *high)), "facade", "facade", orientation=0.0)]
    for p in scene.polygons[1:]:
        x0, y0, x1, y1 = p.bounds
        cut = np.array([max(x0, low[0]), max(y0, low[1]), min(x1, high[0]), min(y1, high[1])])
        inside = max(cut[2] - cut[0], 0) * max(cut[3] - cut[1], 0) / p.area if (cut[2:] > cut[:2]).all() else 0
        if inside > 0.5:
            polygons.append(ga.Polygon(ring(cut), p.label, p.id, orientation=0.0))
    return ga.Scene(polygons), low, high


def row_of_parents(parts, label, gap):
    """Rooms or plots side by side: polygons and the boxes in them, moved."""
    x, polygons, boxes = gap, [], []
    for i, (outline, inner, box) in enumerate(parts):
        shift = np.array([x, gap]) - np.min(outline, axis=0)
        polygons.append(ga.Polygon(np.asarray(outline) + shift, label, f"p{i}", orientation=0.0))
        for j, (points, name) in enumerate(inner):
            polygons.append(ga.Polygon(np.asarray(points) + shift, name, f"p{i} {j}", parent=f"p{i}", orientation=0.0))
        boxes.append(np.asarray(box) + np.tile(shift, 2))
        x += np.ptp(np.asarray(outline)[:, 0]) + gap
    return ga.Scene(polygons), np.array(boxes)


def thin_strip(segment, outline, depth):
    """An opening as a thin rectangle along the inner side of an outline."""
    a, b = np.asarray(segment, float)
    along = (b - a) / np.hypot(*(b - a))
    inward = np.array([-along[1], along[0]])
    if np.dot(np.mean(outline, axis=0) - (a + b) / 2, inward) < 0:
        inward = -inward
    return [a, b, b + depth * inward, a + depth * inward]


def room_cases(path, rng):
    """Fixtures in rooms: one of each kind per room, lengths in estimated metres."""
    kinds = {"toilet": "restroom", "bathtub": "bathroom", "washing_basin": "washing_room", "cooking_counter": "kitchen"}
    rooms = defaultdict(list)
    for plan in json.loads(path.read_text()):
        for room in plan["rooms"]:
            for kind, label in kinds.items():
                items = [f for f in room["furniture"] if f["label"] == kind]
                if room["labels"] == [label] and len(items) == 1:
                    scale = plan["scale_m_per_px"]
                    outline = np.array(room["polygon"], float) * scale
                    inner = [
                        (thin_strip(np.array(s, float) * scale, outline, 0.1), "opening")
                        for s in room["openings"]
                        if np.hypot(*(np.subtract(*s))) * scale > 0.05
                    ]
                    rooms[kind].append((outline, inner, np.array(items[0]["box"], float).ravel() * scale))
    for kind, label in kinds.items():
        order = rng.permutation(len(rooms[kind]))
        for n in range(ROOM_CASES):
            k = (2, 4, 6)[n % 3]
            some = np.roll(order, -n * (ROOMS + 4))[: ROOMS + k]
            scene, boxes = row_of_parents([rooms[kind][i] for i in some], label, 2.0)
            yield f"{kind} {n}", f"{kind} {k}", scene, [(scene, b) for b in boxes[:k]], boxes[k:]


def plot_cases(path, rng):
    """Main buildings on plots, turned so that the street front lies below, in metres."""
    plots = defaultdict(list)
    for plot in json.loads(path.read_text())["plots"]:
        if not plot["buildings"]:
            continue
        a, b = np.asarray(plot["front"], float)
        if np.cross(b - a, np.mean(plot["polygon"], axis=0) - a) < 0:
            a, b = b, a
        angle = np.arctan2(*(b - a)[::-1])
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        outline, front = np.asarray(plot["polygon"]) @ turn, np.asarray(plot["front"]) @ turn
        rect = np.asarray(max(plot["buildings"], key=lambda q: q["area"])["rect"]) @ turn
        sides = rect[1] - rect[0], rect[2] - rect[1]
        w, h = (np.hypot(*s) for s in sides)
        if abs(sides[0][0]) < abs(sides[0][1]):
            w, h = h, w
        middle = rect.mean(axis=0)
        half = np.array([w, h]) / 2
        box = np.concatenate([middle - half, middle + half])
        plots[plot["label"]].append((outline, [(thin_strip(front, outline, 0.3), "front")], box))
    for label, some in plots.items():
        for n in range(max(2, len(some) // 3)):
            order = rng.permutation(len(some))[:9]
            scene, boxes = row_of_parents([some[i] for i in order], label, 5.0)
            if len(boxes) > 5:
                yield f"{label} {n}", f"plot {label}", scene, [(scene, b) for b in boxes[:4]], boxes[4:]


def drawn_street(rng):
    """A street as one draws it: facades of regular windows; what belongs to every window or door, by label."""
    off = rng.choice([0.0, 0.0, 0.01, 0.03])
    size, step = rng.uniform((0.8, 1.2), (1.6, 2.0)), rng.uniform((2.4, 2.8), (3.6, 3.6))
    polygons, placed, x = [], defaultdict(list), 0.0
    gap, thick, over = rng.uniform(0.0, 0.4), rng.uniform(0.1, 0.4), rng.choice([0.0, rng.uniform(0.05, 0.3)])
    for _ in range(rng.integers(2, 4)):
        columns, rows = rng.integers(2, 7), rng.integers(1, 6)
        wide = size * (rng.uniform(0.7, 1.5) if rng.random() < 0.4 else 1.0, 1.0)
        width, height = columns * step[0] + 1, rows * step[1] + 3.2
        polygons.append((0, "facade", (x, 0, x + width, height)))
        door = x + rng.uniform(0.2, 0.8) * width
        polygons.append((0, "door", (door - 0.6, 0, door + 0.6, 2.2)))
        placed["lamp"].append((door + 0.8, 1.6, door + 1.0, 2.0))
        for i in range(columns):
            for j in range(rows):
                a = np.array([x + 1 + step[0] * i, 3.6 + step[1] * j]) + rng.normal(0, 1, 2) * off
                b = a + wide
                placed["window"].append((*a, *b))
                placed["sill"].append((a[0] - over, a[1] - gap - thick, b[0] + over, a[1] - gap))
                placed["lintel"].append((a[0] - over, b[1] + 0.1, b[0] + over, b[1] + 0.1 + thick))
                placed["blind"].append((a[0] - 0.3, a[1], a[0], b[1]))
                if j % 2:
                    placed["balcony"].append((a[0] - 0.4, a[1] - 0.2, b[0] + 0.4, a[1] + 0.8))
        x += width + 3
    moved = {label: np.array(b) + rng.normal(0, 1, (len(b), 4)) * off for label, b in placed.items()}
    return polygons, moved


def drawn_cases(rng, count):
    """Drawn streets: one label to be found, some of the others shown."""
    for n in range(count):
        polygons, placed = drawn_street(rng)
        label = str(rng.choice(["sill", "sill", "lintel", "blind", "balcony", "lamp", "window"]))
        others = [
            o for o in ("window", "sill", "lintel", "blind") if o != label and (o == "window" or rng.random() < 0.4)
        ]
        boxes = placed.get(label, np.zeros((0, 4)))
        everything = [*polygons, *((0, o, b) for o in others for b in placed[o])]
        scene = ga.Scene([ga.Polygon(ring(b), o, orientation=0.0) for _, o, b in everything])
        k = int(rng.choice([1, 2, 3, 4, 6]))
        if len(boxes) < k + 2:
            continue
        # All of one facade as often as of any: a rule that was learned here is used there.
        order = np.argsort(boxes[:, 0], kind="stable") if rng.random() < 0.5 else np.arange(len(boxes))
        shown = rng.permutation(order[: max(k, len(boxes) // 2)])[:k]
        truth = np.delete(boxes, shown, axis=0)
        yield f"drawn {n}", f"drawn {label}", scene, [(scene, boxes[i]) for i in shown], truth


def every_case(root, paths, seed, alone=True, share=1.0):
    """A share of the cases of facades at some paths, drawn streets, and rooms and plots, which hold one box each."""
    rng = np.random.default_rng(seed)
    for path in paths:
        yield from (case for case in facade_cases(path, rng) if rng.random() < share)
    if alone:
        yield from room_cases(root / "r2v_floorplans" / "dev" / "plans.json", rng)
        yield from plot_cases(root / "bubenec_city" / "dev" / "scene.json", rng)
    yield from drawn_cases(rng, DRAWN_CASES)
