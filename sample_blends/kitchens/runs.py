"""Runs of cabinets: bodies along the walls, their fronts and worktops, and what is built into them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..houses.recorder import Box, Draw, Sheet
from ..library.fittings import FITTINGS
from . import furniture, shell
from .drawn import Along, KitchenRecorder, after, ahead_of, centre, filling, free, gap

BACK, LEFT, RIGHT = "back wall", "left wall", "right wall"

#: Metres: height and depth of cabinets, height and thickness of plinths and of worktops, width and height of fridges.
HEIGHT, DEPTH = 0.86, 0.58
PLINTH, STEP = 0.1, 0.05
SLAB, OVERHANG = 0.04, 0.03
TALL_WIDTH, TALL_HEIGHT = 0.66, 2.06

#: In a single run: how far the middle of the oven is from the fridge, and that of the sink from the other end.
AT_FRIDGE, AT_END = 0.45, 0.6

#: How far from the wall with the door the cabinets along the sides end.
CLEAR = 1.2


def left_of_fridge(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [(x0, y0, x1 - TALL_WIDTH, y0 + HEIGHT)]


def right_of_fridge(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [(x0 + TALL_WIDTH, y0, x1, y0 + HEIGHT)]


def fridge_right(s: Sheet) -> Sequence[Box]:
    _, y0, x1, _ = s.edges
    return [(x1 - TALL_WIDTH, y0, x1, y0 + TALL_HEIGHT)]


def fridge_left(s: Sheet) -> Sequence[Box]:
    x0, y0, _, _ = s.edges
    return [(x0, y0, x0 + TALL_WIDTH, y0 + TALL_HEIGHT)]


def along_left(s: Sheet) -> Sequence[Box]:
    """From the other cabinets, at its right, towards the door."""
    (_, y0, _, _), (start, end) = s.edges, free(s, HEIGHT / 2)
    return [(start + CLEAR, y0, end, y0 + HEIGHT)]


def along_right(s: Sheet) -> Sequence[Box]:
    (_, y0, _, _), (start, end) = s.edges, free(s, HEIGHT / 2)
    return [(start, y0, end - CLEAR, y0 + HEIGHT)]


def plinth(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [(x0, y0, x1, y0 + PLINTH)]


def dishwasher_right(s: Sheet) -> Sequence[Box]:
    _, y0, x1, y1 = s.edges
    return [(x1 - 0.66, y0 + PLINTH, x1 - 0.06, y1)]


def dishwasher_left(s: Sheet) -> Sequence[Box]:
    x0, y0, _, y1 = s.edges
    return [(x0 + 0.06, y0 + PLINTH, x0 + 0.66, y1)]


def dishwasher_by_sink(s: Sheet) -> Sequence[Box]:
    _, y0, x1, y1 = s.edges
    return [(x1 - 1.36, y0 + PLINTH, x1 - 0.76, y1)]


def oven_at(middle: Along) -> Draw:
    """As high as the front above its plinth."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        x = middle(x0, x1)
        return [(x - 0.3, y0 + PLINTH, x + 0.3, y1)]

    return draw


def fridge_front(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return [(x0 + 0.01, y0 + 0.05, x1 - 0.01, y1 - 0.01)]


def lying(name: str, middle: Along, off: float) -> Draw:
    """A fitting in its own size on a worktop, so far from the wall."""
    width, depth = FITTINGS[name].size

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, _ = s.edges
        x = middle(x0, x1)
        return [(x - width / 2, y0 + off, x + width / 2, y0 + off + depth)]

    return draw


def next_to(name: str, label: str, gap: float, off: float, least: float = 0.0) -> Draw:
    """A fitting in its own size on a worktop, so far after what has a label, where there is so much room behind it."""
    width, depth = FITTINGS[name].size

    def draw(s: Sheet) -> Sequence[Box]:
        _, y0, x1, _ = s.edges
        return [
            (a1 + gap, y0 + off, a1 + gap + width, y0 + off + depth)
            for _, _, a1, _ in s.boxes(label)
            if a1 + gap + width + least < x1
        ]

    return draw


def before(name: str, label: str, gap: float, off: float, least: float = 0.0) -> Draw:
    """The same before it."""
    width, depth = FITTINGS[name].size

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, _, _ = s.edges
        return [
            (a0 - gap - width, y0 + off, a0 - gap, y0 + off + depth)
            for a0, _, _, _ in s.boxes(label)
            if a0 - gap - width - least > x0
        ]

    return draw


@dataclass(frozen=True)
class Plan:
    """How a kitchen is laid out: the names of its runs, and what is drawn for them, seen by who faces the wall.

    Attributes
    ----------
    run : str
        What the run along the back is called.
    along, fridge, dishwasher : Draw
        The run along the back, the fridge beside it, and the dishwasher in its front.
    side : (str, Draw) or None
        Wall and place of the run round the corner.
    open : str
        The wall that stays free.
    hood : str
        Of the library.
    over : Draw
        The window over the run along the back.
    """

    run: str
    along: Draw
    fridge: Draw
    dishwasher: Draw
    side: tuple[str, Draw] | None
    open: str
    hood: str
    over: Draw


#: The window over a run: wider over wider ones, or over the sink.
WIDE = shell.window_over("back run", lambda x0, x1: (x0 + 0.3 * (x1 - x0), x1 - 0.3 * (x1 - x0)))
NARROW = shell.window_over("single run", lambda x0, x1: (x1 - AT_END - 0.5, x1 - AT_END + 0.5))

#: Seed of the choice of plans: in the rooms that are recorded, each is chosen three times.
DIVISION = 18

PLANS = (
    Plan("back", left_of_fridge, fridge_right, dishwasher_right, (LEFT, along_left), RIGHT, "chimney hood", WIDE),
    Plan("back", right_of_fridge, fridge_left, dishwasher_left, (RIGHT, along_right), LEFT, "flat hood", WIDE),
    Plan("single", right_of_fridge, fridge_left, dishwasher_by_sink, None, RIGHT, "flat hood", NARROW),
)


def bodies(r: KitchenRecorder, plan: Plan) -> None:
    """The room with its cabinets, as far as the plans differ."""
    run, front = f"{plan.run} run", f"{plan.run} front"
    r.extrude("kitchen", 2.5, walls=0.12, side="wall", top="rim", bottom="floor", outside="outside")
    r.place(run, BACK, plan.along, 4, max_per={BACK: 1})
    r.place("tall", BACK, plan.fridge, 4, max_per={BACK: 1})
    r.attach(run, DEPTH, top=front, side=run)
    r.attach("tall", DEPTH + 0.02, top="tall front", side="tall side")
    if plan.side:
        wall, along = plan.side
        r.place("side run", wall, along, 4, max_per={wall: 1})
        r.attach("side run", DEPTH, top="side front", side="side run")
    r.fit("dishwasher front", front, plan.dishwasher)
    if plan.side:
        doors(r, "cabinet door", front, ("dishwasher",), (int(plan.dishwasher is dishwasher_left),))


def doors(r: KitchenRecorder, name: str, front: str, beside: Sequence[str], numbers: Sequence[int]) -> None:
    """Fill parts of a front, counted from the left, that the appliances leave free."""
    for number in numbers:
        r.fit(name, front, gap(beside, number), fit=("divide", "scale"), forbid_intersections=True)


def fronts(r: KitchenRecorder) -> None:
    """Plinths, worktops, ovens and doors of all runs."""
    for kind in ("back", "side", "single"):
        front, top = f"{kind} front", f"upper {kind} run"
        r.place(f"{kind} toe", front, plinth, 3, max_per={front: 1})
        r.recess(f"{kind} toe", STEP, "plinth", "plinth")
        r.place(f"{kind} slab", top, filling((0.0, 0.0, 0.0, OVERHANG)), 3, max_per={top: 1})
        r.attach(f"{kind} slab", SLAB, top=f"{kind} worktop", side="worktop edge")
    r.fit("oven", "side front", oven_at(centre))
    r.fit("oven", "single front", oven_at(after(AT_FRIDGE)))
    doors(r, "drawers", "side front", ("oven",), (0, 1))
    doors(r, "cabinet door", "single front", ("oven", "dishwasher"), (1, 2))
    r.fit("fridge doors", "tall front", fridge_front, 3)


def worktops(r: KitchenRecorder) -> None:
    """What is built into worktops and stands on them; on a worktop, x runs to the left of who faces the wall."""
    r.fit("inset sink", "back worktop", lying("inset sink", centre, 0.08))
    r.fit("hob", "side worktop", lying("hob", centre, 0.07))
    r.fit("inset sink", "single worktop", lying("inset sink", after(AT_END), 0.08))
    r.fit("hob", "single worktop", lying("hob", ahead_of(AT_FRIDGE), 0.07))
    r.fit("kettle", "back worktop", next_to("kettle", "sink", 0.15, 0.1, 0.1))
    r.fit("bread board", "side worktop", next_to("bread board", "hob", 0.2, 0.2, 0.1))
    r.fit("jars", "side worktop", before("jars", "hob", 0.15, 0.05, 0.1))
    r.fit("jars", "single worktop", before("jars", "hob", 0.1, 0.05, 1.1), forbid_intersections=True)


def record(r: KitchenRecorder) -> None:
    """Record all that is built from the floor up to the worktops, in three layouts by chance."""
    ends = []
    for plan, link in zip(PLANS, r.select("kitchen", (1.0, 1.0, 1.0), DIVISION), strict=True):
        r.at = (link,)
        bodies(r, plan)
        shell.openings(r, plan.over, plan.open)
        if plan.side:
            shell.hanging(r, shell.BACK, "back run", None, ("window",), (0, 1))
            shell.hanging(r, plan.side[0], "side run", (plan.hood, centre), ("hood",), (0, 1))
        else:
            shell.hanging(r, shell.BACK, "single run", (plan.hood, after(AT_FRIDGE)), ("hood", "window"), (1,))
        ends.append(r.at[0])
    r.at = tuple(ends)
    fronts(r)
    worktops(r)
    shell.windows(r)
    shell.cabinets(r)
    shell.entrance(r)
    furniture.record(r)
