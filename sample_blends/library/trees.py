"""Trees, bushes and hedges."""

from __future__ import annotations

import numpy as np

from ..plans.outlines import centred_rectangle, circle
from .assets import asset
from .solids import Solid, Vector, cards, cylinder, dense_ball, dense_box, ellipsoid, joined, lathe, tube


def _foliage(
    blobs: list[tuple[Vector, float]], leaves: int, size: float, finishes: tuple[str, str], seed: int
) -> Solid:
    """Leaves about balls (centre, radius), the lighter finish towards the top, with dark balls inside."""
    rng = np.random.default_rng(seed)
    centres_of = np.array([centre for centre, _ in blobs])
    radii = np.array([radius for _, radius in blobs])
    which = rng.choice(len(blobs), leaves, p=radii**2 / (radii**2).sum())
    out = rng.normal(size=(leaves, 3))
    out[:, 2] = np.abs(out[:, 2]) * np.where(rng.uniform(size=leaves) < 0.78, 1.0, -1.0)
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    centres = centres_of[which] + out * (radii[which] * rng.uniform(0.86, 1.06, leaves))[:, None]
    # A leaf deep inside another ball is never seen.
    depth = np.linalg.norm(centres[:, None] - centres_of, axis=2) / radii
    kept = depth.min(axis=1) > 0.8
    centres, out = centres[kept], out[kept]
    normals = out + 0.45 * rng.normal(size=out.shape)
    sizes = size * rng.uniform(0.75, 1.25, len(out))
    light = out[:, 2] + 0.5 * rng.normal(size=len(out)) > 0.55
    parts = [
        cards(centres[mask], normals[mask], sizes[mask], finish, rng)
        for mask, finish in ((light, finishes[1]), (~light, finishes[0]))
    ]
    parts += [ellipsoid((r * 0.88, r * 0.88, r * 0.86), centre, "shade leaf", 10, 7) for centre, r in blobs]
    return joined(parts)


@asset("broad-leaved tree", "garden", circle(2.2, count=28), label="tree")
def broad_leaved_tree() -> Solid:
    """Lime tree, seven metres tall."""
    blobs = [((0.0, 0.0, 4.6), 1.75), ((0.2, -0.1, 5.9), 1.15)]
    for i in range(5):
        turn = np.radians(72 * i + 20)
        blobs.append(((1.15 * np.cos(turn), 1.15 * np.sin(turn), 4.0 + 0.35 * (i % 2)), 1.05))
    branches = [
        tube(
            [(0.0, 0.0, 2.0), (0.45 * np.cos(t), 0.45 * np.sin(t), 2.8), (1.1 * np.cos(t), 1.1 * np.sin(t), 3.7)],
            (0.12, 0.09, 0.05),
            "bark",
            7,
        )
        for t in np.radians([20, 92, 164, 236, 308])
    ]
    trunk = tube(
        [(0.0, 0.0, 0.0), (0.02, 0.0, 0.4), (0.03, 0.02, 1.6), (0.0, 0.0, 3.6)], (0.3, 0.2, 0.17, 0.1), "bark", 10
    )
    return joined((_foliage(blobs, 3400, 0.2, ("tree leaf", "sunny leaf"), 31), trunk, *branches))


@asset("small tree", "garden", circle(1.0, count=24), label="small tree")
def small_tree() -> Solid:
    """Clipped tree: a ball on a stem."""
    trunk = cylinder(0.09, 1.6, (0.0, 0.0, 0.0), "bark", sides=9, top=0.07)
    return joined((_foliage([((0.0, 0.0, 2.3), 0.95)], 1000, 0.15, ("leaf", "pale leaf"), 37), trunk))


@asset("conifer", "garden", circle(0.85, count=24), label="conifer")
def conifer() -> Solid:
    """Cypress-like cone, four and a half metres tall."""
    rng = np.random.default_rng(41)
    count = 1100
    rise = 1 - np.sqrt(rng.uniform(0.0, 1.0, count))
    turn = rng.uniform(0.0, 2 * np.pi, count)
    profile = 0.8 * (1 - rise) ** 0.8 * np.minimum(1.0, 0.6 + rise * 4) + 0.03
    radius = profile * rng.uniform(0.86, 1.06, count)
    centres = np.column_stack((radius * np.cos(turn), radius * np.sin(turn), 0.35 + 4.1 * rise))
    normals = np.column_stack((np.cos(turn), np.sin(turn), np.full(count, 0.5))) + 0.35 * rng.normal(size=(count, 3))
    leaves = cards(centres, normals, rng.uniform(0.12, 0.2, count), "needle", rng)
    heights = np.linspace(0.0, 1.0, 8)
    core = [(0.72 * float((1 - h) ** 0.8 * min(1.0, 0.6 + h * 4)), 0.32 + 4.0 * float(h)) for h in heights]
    return joined((leaves, lathe(core, "shade leaf", 12), cylinder(0.1, 0.4, (0.0, 0.0, 0.0), "bark", sides=8)))


@asset("bush", "garden", circle(0.55, count=20))
def bush() -> Solid:
    """Box clipped into a ball."""
    ball = dense_ball(0.53, 13, (0.0, 0.0, 0.52), "box leaf")
    return joined((ball.roughened(0.024, 43), cylinder(0.1, 0.1, (0.0, 0.0, 0.0), "bark", sides=8)))


@asset("hedge", "garden", centred_rectangle(2.0, 0.7))
def hedge() -> Solid:
    """Piece of clipped hedge, long along +X."""
    return dense_box((2.0, 0.7, 1.2), 0.1, "box leaf").roughened(0.02, 47)
