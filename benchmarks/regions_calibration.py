"""Fit the exponents of the similarity of regions to half of the shapes, and judge them and the engine's on the other.

    GEOANALOGY_DATA=… python benchmarks/regions_calibration.py [--every N] [--keep FILE]

Reads `spine_articulated` and `mpeg7_contours` below the folder named by GEOANALOGY_DATA. Every case gives the evidence
of the matches of all its places; a logistic regression tells those on the right one from the others. Shapes of even
and of odd number are the halves. What is shown follows from the exponents by `geoanalogy/regions/standing.py`. With
``--keep`` the evidence is kept in a file, and read from it where there is one.

The exponents in `geoanalogy/regions/evidence.py` are not what this prints. They were fitted in the same way to an
earlier state of the evidence, and `unmirrored` was lowered from 1.2 to 0.5 by hand afterwards. They stay because what
either half gives now is no better on the other one: the table has both, line by line. The default threshold was chosen
on half of the poses of `spine_articulated`, the contrast on the drawings of `sample_blends`, what may be chance on all
poses, and judged among clutter drawn anew.
"""

from __future__ import annotations

import argparse
import os
import pickle
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import geoanalogy as ga
from benchmarks.measuring import Table
from benchmarks.regions_quality import around, closed, lands, silhouettes, spine
from geoanalogy.regions.evidence import EXPONENTS, FLOOR, SPREAD, trusted
from geoanalogy.regions.standing import least_shown

Array = NDArray[np.float64]

#: Mean error, in per cent of the diagonal, below which a mapping is right, and above which it is as good as elsewhere.
RIGHT, WRONG = 6.0, 12.0
#: Strength of the regularisation, rounds, and how much more the best of a case's wrong matches count in all but the
#: first: the others are never shown before them.
STIFFNESS, ROUNDS, SHARPNESS = 0.003, 6, 2.0
#: What a mirror image may cost at most: the true targets of these cases are none, those of drawings often are.
MOST_UNMIRRORED = 0.5
NAMES = tuple(EXPONENTS)


@dataclass(frozen=True)
class Example:
    """The matches of one case.

    Attributes
    ----------
    kind : str
    name : str
        Whose shape the query is: examples of one shape are of one half.
    factors : (n, f) float
        Logarithms of the factors of the evidence.
    right : (n,) bool
        Whether a match lies on the right place.
    wrong : (n,) bool
        Whether it lies on the place of another shape: neither there nor on the query's own.
    error : (n,) float
        Mean error of its mapping in per cent of the diagonal; 0 where only the place is known.
    """

    kind: str
    name: str
    factors: Array
    right: NDArray[np.bool_]
    wrong: NDArray[np.bool_]
    error: Array


def examples(root: Path, every: int) -> Iterator[Example]:
    """The evidence of all cases."""
    for case in spine(root / "spine_articulated" / "dev", every):
        size = float(np.hypot(*np.ptp(case.answer, axis=0)))
        yield example(case.kind, case.name, case.lines, case.query, case.points, case.middles, (1,), case.answer, size)
    for name, shapes, at in silhouettes(root / "mpeg7_contours" / "dev", every):
        lines = [closed(s) for s in shapes]
        yield example("silhouettes", name, lines, around(shapes[0]), shapes[0], at, (1, 2))


def example(
    kind: str,
    name: str,
    lines: list[Array],
    query: Array,
    points: Array,
    middles: Array,
    right: tuple[int, ...],
    answer: Array | None = None,
    size: float = 1.0,
) -> Example:
    """Match a case, and compare all matches with the truth."""
    every = ga.match_regions(ga.Drawing(lines), query, ga.RegionOptions(threshold=0.0, contrast=0.0)).every
    mapped = [m.map(points) for m in every]
    factors = [[np.log(max(getattr(m.evidence, k), FLOOR)) for k in NAMES] for m in every]
    error = [0.0 if answer is None else 100.0 * np.linalg.norm(p - answer, axis=1).mean() / size for p in mapped]
    places = np.array([lands(p, middles) for p in mapped], int)
    there = np.isin(places, right)
    return Example(
        kind,
        name,
        np.reshape(factors, (-1, len(NAMES))),
        there,
        ~there & (places != 0),
        np.asarray(error, dtype=np.float64),
    )


def fitted(some: Sequence[Example]) -> Array:
    """Exponents by logistic regression: every case's right matches weigh as much as its wrong ones."""
    groups: list[tuple[Array, bool]] = []
    for e in some:
        good, bad = e.right & (e.error < RIGHT), e.wrong | (e.right & (e.error > WRONG))
        groups += [(e.factors[which], value) for which, value in ((good, True), (bad, False)) if which.any()]
    x = np.concatenate([g for g, _ in groups])
    sign = np.concatenate([np.full(len(g), 1.0 if value else -1.0) for g, value in groups])
    edges = np.cumsum([len(g) for g, _ in groups])[:-1]
    weight = np.concatenate([np.full(len(g), 1.0 / len(g)) for g, _ in groups])
    bounds = [(None, None)] + [(0.0, MOST_UNMIRRORED if k == "unmirrored" else None) for k in NAMES]
    found = np.zeros(1 + len(NAMES))
    for number in range(ROUNDS):
        if number:
            z = SHARPNESS * (x @ found[1:])
            weight = np.concatenate([np.exp(p - np.logaddexp.reduce(p)) for p in np.split(z, edges)])

        def loss(p: Array, w: Array = weight) -> float:
            miss = np.logaddexp(0.0, -sign * (x @ p[1:] + p[0]))
            return float((w * miss).sum() / w.sum() + STIFFNESS * (p[1:] ** 2).sum())

        found = minimize(loss, found, bounds=bounds).x
    return np.asarray(found[1:], dtype=np.float64)


def judged(some: Sequence[Example], exponents: Array) -> list[str]:
    """Shares of cases whose best match is right, is right and shown, and of those that show nothing else; the error."""
    options = ga.RegionOptions()
    first, shown, clean, errors = [], [], [], []
    for e in some:
        coverage = np.exp(e.factors[:, NAMES.index("coverage")])
        similarity = np.exp(e.factors @ exponents / SPREAD) * trusted(coverage)
        order = np.argsort(-similarity, kind="stable")
        similarity, right, wrong, error = similarity[order], e.right[order], e.wrong[order], e.error[order]
        corners = 1.0 + e.factors[order, NAMES.index("corners")]
        above = similarity >= least_shown(similarity, corners, options.threshold, options.contrast)
        first.append(bool(right[:1].any()))
        shown.append(bool((right & above)[:1].any()))
        clean.append(not (above & wrong).any())
        errors += list(error[right][:1])
    return [f"{np.mean(first):.2f}", f"{np.mean(shown):.2f}", f"{np.mean(clean):.2f}", f"{np.median(errors):.1f}"]


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--every", type=int, default=1, help="take every so many of the cases")
    parser.add_argument("--keep", type=Path, help="file of the evidence")
    arguments = parser.parse_args()
    root = Path(os.environ.get("GEOANALOGY_DATA") or "nowhere")
    if arguments.keep and arguments.keep.is_file():
        cases = pickle.loads(arguments.keep.read_bytes())
    elif not (root / "spine_articulated").is_dir():
        parser.error("GEOANALOGY_DATA names no folder with spine_articulated and mpeg7_contours")
    else:
        cases = list(examples(root, arguments.every))
        if arguments.keep:
            arguments.keep.write_bytes(pickle.dumps(cases))
    number = {
        name: k % 2
        for silhouette in (False, True)
        for k, name in enumerate(sorted({e.name for e in cases if (e.kind == "silhouettes") == silhouette}))
    }
    halves = [[e for e in cases if number[e.name] == h] for h in (0, 1)]
    kept = np.array([EXPONENTS[k] for k in NAMES])
    rows = []
    for h in (0, 1):
        found = fitted(halves[h])
        found *= kept.sum() / found.sum()  # one number for all changes no order: similarities spread as they did
        print(f"fitted to half {h}: {dict(zip(NAMES, found.round(2).tolist(), strict=True))}")
        for kind in sorted({e.kind for e in cases}):
            others = [e for e in halves[1 - h] if e.kind == kind]
            rows.append((f"half {h}", kind, len(others), *judged(others, found)))
            rows.append(("in the engine", kind, len(others), *judged(others, kept)))
    header = ("exponents of", "judged on the other half", "n", "first", "shown first", "clean", "median error, %")
    print(Table("Similarity of regions", header, rows).markdown())


if __name__ == "__main__":
    main()
