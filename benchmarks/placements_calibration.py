"""Fit the table of certainty of placements to real layouts, and report it on layouts that were not fitted.

    GEOANALOGY_DATA=… python benchmarks/placements_calibration.py [--write] [--report] [--half 0|1] …

Reads `cmp_facades`, `bubenec_city` and `r2v_floorplans` below the folder named by GEOANALOGY_DATA. Every layout gives
a few cases: some rectangles of a label are shown, the others are to be found. With ``--report`` each half of the
layouts is fitted, and reported on the other one. With ``--write`` the table is fitted to all, or with ``--half`` to
every other layout alone, and written where the engine finds it. With ``--only`` the other judgements stay as they are.
"""

import argparse
import os
import pathlib
import pickle
import sys
from collections import defaultdict

import numpy as np
from scipy.optimize import minimize

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

import geoanalogy as ga
from benchmarks.placements_cases import every_case, rectangle
from geoanalogy.placements import calibration, survey
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.boxes import union_overlap
from geoanalogy.placements.candidates import predictions
from geoanalogy.placements.company import AMONG, Company
from geoanalogy.placements.evidence import SINGLE
from geoanalogy.placements.model import SEVERAL
from geoanalogy.placements.one_each import ONE_EACH
from geoanalogy.placements.selection import rescaled, useful_cut, without_overlaps

TABLE = pathlib.Path(__file__).resolve().parent.parent / "geoanalogy" / "placements" / "calibration_table.py"
RIGHT = 0.5
#: How sharply the choice among candidates follows their overlap with what is right.
SHARPNESS = 30.0
#: What a place that is right but for a mirroring is worth in rooms: which corner was taken is one choice of several.
MIRRORED_WORTH = 0.4
#: Sums that saturate, beside the plain one, in the last model: more of them fit better and judge no better.
REASONS = 6
#: Fits of them from other weights, of which the best is kept, and the least worth of a reason: at 0 it learns no more.
STARTS, LEAST_WORTH = 3, 0.25
#: Of how many wrong candidates one is fitted, and how many steps a fit takes at most.
THINNED, MOST_STEPS = 3, 150
ROOMS = ("toilet", "bathtub", "washing_basin", "cooking_counter")
#: The judgements by name, and the evidence of single candidates in each.
JUDGEMENTS = {"at home": SINGLE, "abroad": SINGLE, "alone": SINGLE + ONE_EACH}


def collected(cases):
    """Evidence of every arrangement of every case."""
    out = []
    for layout, kind, scene, shown, truth in cases:
        try:
            model = ga.learn_placement([ga.Example(s, rectangle(b)) for s, b in shown])
        except ga.InputError:  # all that is shown lies beyond the edge of the facade
            continue
        parents = [p for p in scene.polygons if p.label == model.label]
        found = [part(model, arrangement_of(scene, parent, 0.0), truth, kind) for parent in parents]
        if found:  # else what contained the examples is not in the target
            out.append({"layout": layout, "kind": kind, "parts": found, "truth": len(truth)})
    return out


def part(model, arrangement, truth, kind):
    """Evidence of one arrangement."""
    lesson = model.lesson
    drawn = model._drawn(arrangement, model.shown_in(arrangement))[0]
    here = truth[(union_overlap(truth, arrangement.parent_box[None])[:, 0] > 0)]
    boxes, quick = survey.glance(lesson, arrangement, drawn, *predictions(lesson, arrangement))
    quick_iou = union_overlap(boxes, truth).max(axis=1)
    some = np.flatnonzero((quick_iou >= 0.4) | (np.arange(len(boxes)) % 16 == 0))
    seen, grounds = survey.search(lesson, arrangement, drawn, drawn)
    found = {
        "judge": "at home" if len(drawn) else "alone" if lesson.one_each else "abroad",
        "quick": quick[some].astype(np.float32),
        "quick_iou": quick_iou[some],
        "boxes": seen.boxes,
        "anchors": grounds.company.anchors,
        "single": grounds.single.astype(np.float32),
        "among": grounds.among.astype(np.float32),
        "present": drawn,
        "iou": union_overlap(seen.boxes, truth).astype(np.float32),
        "truth": len(here),
    }
    if found["judge"] == "alone" and len(here) and len(seen.boxes):
        worth = union_overlap(seen.boxes, here)
        if kind.split()[0] in ROOMS:
            middle = np.tile(arrangement.parent_box[:2] + arrangement.parent_box[2:], 2)
            ways = [here, *((middle - here[:, [2, 3, 0, 1]])[None] * w + here * (1 - w) for w in MIRRORINGS)]
            mirrored = np.max([union_overlap(seen.boxes, np.asarray(w).reshape(-1, 4)) for w in ways], axis=0)
            worth = (1 - MIRRORED_WORTH) * worth + MIRRORED_WORTH * mirrored
        found["worth"] = worth.max(axis=1)
    return found


#: Which coordinates are mirrored: along x, along y, both.
MIRRORINGS = np.array([(1, 0, 1, 0), (0, 1, 0, 1), (1, 1, 1, 1)], float)


def limits_of(names):
    """Evidence for and against has its sign; circumstances may have either."""
    return [
        (None, 0) if n in calibration.AGAINST else (None, None) if n in calibration.CIRCUMSTANCES else (0, None)
        for n in names
    ]


def thinned(evidence, right, weight):
    """Of the many wrong candidates every `THINNED`-th, which stands for that many; weights add up to 1."""
    some = (right > 0) | (np.arange(len(right)) % THINNED == 0)
    weight = np.where(right > 0, 1, THINNED)[some] * weight[some]
    return evidence[some].astype(np.float64), right[some], weight / weight.sum()


def fitted(evidence, right, weight, names, ridge=1e-4):
    """Weights of a logistic model."""
    evidence, right, weight = thinned(evidence, right, weight)
    scale = evidence.std(axis=0) + 1e-9
    z = evidence / scale

    def loss(p):
        value = z @ p[:-1] + p[-1]
        error = weight * (1 / (1 + np.exp(-value)) - right)
        return (
            float((weight * (np.logaddexp(0, value) - right * value)).sum() + ridge * (p[:-1] ** 2).sum()),
            np.append(z.T @ error + 2 * ridge * p[:-1], error.sum()),
        )

    limits = [*limits_of(names), (None, None)]
    solved = minimize(
        loss, np.zeros(len(names) + 1), jac=True, method="L-BFGS-B", bounds=limits, options={"maxiter": MOST_STEPS}
    )
    return calibration.Calibration(names, solved.x[:-1] / scale, float(solved.x[-1]))


def reasoned(evidence, right, weight, names, ridge=1e-5):
    """A logistic model of a sum and `REASONS` sums that saturate; each keeps to the signs of the evidence."""
    evidence, right, weight = thinned(evidence, right, weight)
    middle, scale = evidence.mean(axis=0), evidence.std(axis=0)
    # What never differs (rows of examples where there are none) says nothing.
    scale[scale < 1e-6] = np.inf
    z = ((evidence - middle) / scale).astype(np.float32)
    f, r = len(names), REASONS

    def parts(p):
        return p[: f * r].reshape(f, r), p[f * r : (f + 1) * r], p[(f + 1) * r : (f + 2) * r], p[(f + 2) * r : -1]

    def loss(p):
        reasons, thresholds, worth, direct = (part.astype(np.float32) for part in parts(p))
        sums = np.tanh(z @ reasons + thresholds)
        value = (sums @ worth + z @ direct).astype(np.float64) + p[-1]
        error = (weight * (1 / (1 + np.exp(-value)) - right)).astype(np.float32)
        back = error[:, None] * worth * (1 - sums**2)
        kept = [2 * ridge * reasons, 0.0, 2 * ridge * worth, 0.2 * ridge * direct]
        slopes = [g + k for g, k in zip((z.T @ back, back.sum(axis=0), sums.T @ error, z.T @ error), kept, strict=True)]
        small = (reasons**2).sum() + (worth**2).sum() + 0.1 * (direct**2).sum()
        return (
            float((weight * (np.logaddexp(0, value) - right * value)).sum() + ridge * small),
            np.concatenate([*(s.ravel() for s in slopes), [error.sum()]]).astype(np.float64),
        )

    limits = limits_of(names)
    sign = np.array([-1 if high == 0 else 1 for _, high in limits])
    free = np.array([low is None and high is None for low, high in limits])
    bounds = [
        *(one for one in limits for _ in range(r)),
        *[(None, None)] * r,
        *[(LEAST_WORTH, None)] * r,
        *limits,
        (None, None),
    ]

    def tried(seed):
        rng = np.random.default_rng(seed)
        start = rng.normal(0, 0.1, (f, r))
        start = np.where(free[:, None], start, sign[:, None] * np.abs(start))
        first = [start.ravel(), rng.normal(0, 0.5, r), np.full(r, 2 * LEAST_WORTH), np.zeros(f), [-2.0]]
        options = {"maxiter": MOST_STEPS}
        return minimize(loss, np.concatenate(first), jac=True, method="L-BFGS-B", bounds=bounds, options=options)

    solved = min((tried(seed) for seed in range(STARTS)), key=lambda one: one.fun)
    reasons, thresholds, worth, direct = parts(solved.x)
    reasons, direct = reasons / scale[:, None], direct / scale
    return calibration.Calibration(
        names, direct, float(solved.x[-1] - middle @ direct), reasons, thresholds - middle @ reasons, worth
    )


def chosen(parts, names, ridge=1e-3):
    """Weights of the odds of candidates among each other: those that overlap best with what is right."""
    evidence = np.concatenate([np.hstack([p["single"], p["among"], p["settled"]]) for p in parts])
    scale = evidence.std(axis=0) + 1e-9
    z = evidence / scale
    group = np.repeat(np.arange(len(parts)), [len(p["boxes"]) for p in parts])
    first = np.flatnonzero(np.diff(group, prepend=-1))

    def shares(value):
        top = np.maximum.reduceat(value, first)
        odds = np.exp(value - top[group])
        return odds / np.add.reduceat(odds, first)[group], top

    wanted, _ = shares(SHARPNESS * np.concatenate([p["worth"] for p in parts]))

    def loss(p):
        value = z @ p
        odds, _ = shares(value)
        error = (odds - wanted) / len(parts)
        return (
            float(-(wanted * np.log(odds + 1e-12)).sum() / len(parts) + ridge * (p**2).sum()),
            z.T @ error + 2 * ridge * p,
        )

    solved = minimize(
        loss,
        np.zeros(len(names)),
        jac=True,
        method="L-BFGS-B",
        bounds=limits_of(names),
        options={"maxiter": MOST_STEPS},
    )
    return calibration.Calibration(names, solved.x / scale, 0.0)


def fit(cases, only):
    """The judgements by name; those that are not to be fitted are the engine's."""
    models = dict(zip(JUDGEMENTS, (survey.AT_HOME, survey.ABROAD, survey.ALONE), strict=True))
    for name, single in JUDGEMENTS.items():
        if name not in only:
            continue
        some = [{**c, "parts": [p for p in c["parts"] if p["judge"] == name]} for c in cases]
        models[name] = judgement([c for c in some if c["parts"]], single)
    return models


def judgement(cases, single):
    """The models of one judgement."""
    parts = [p for c in cases for p in c["parts"]]
    stack = lambda key: np.concatenate([p[key] for p in parts])  # noqa: E731
    weigh = lambda key: np.concatenate(  # noqa: E731
        [np.full(len(p[key]), min(1 / c["truth"], 0.1)) for c in cases for p in c["parts"]]
    )
    glance = fitted(stack("quick"), (stack("quick_iou") >= RIGHT) * 1.0, weigh("quick"), single)
    right = np.concatenate([(p["iou"].max(axis=1, initial=0.0) >= RIGHT) * 1.0 for p in parts])
    first = np.hstack([stack("single"), stack("among")])
    look = fitted(first, right, weigh("boxes"), single + AMONG)
    for p in parts:
        settle_evidence(p, look)
    names = single + AMONG + calibration.SETTLED
    some = [p for p in parts if "worth" in p]
    # One of many alike is chosen by odds among each other: there are too few rooms for more than sums.
    settle = (fitted if some else reasoned)(np.hstack([first, stack("settled")]), right, weigh("boxes"), names)
    return calibration.Judgement(glance, look, settle, chosen(some, names) if some else None)


def settle_evidence(part, look):
    """Evidence of the last model: what the second one makes of the candidates among each other."""
    first = np.hstack([part["single"], part["among"]])
    part["settled"] = np.hstack(
        [
            look.value(first)[:, None],
            Company(part["boxes"], part["present"], part["anchors"]).evidence(look.certainty(first)),
        ]
    )


def f1(case, judgements, cuts):
    """F1 of a case at several cuts, by default and at best; its share of boxes among the candidates; IoU of the one.

    Of candidates as they are rated: before they are moved to where they fit best, doubted by rows and paired.
    """
    kept, iou, scores, of_one = [], [], [], []
    for p in case["parts"]:
        judge = judgements[p["judge"]]
        settle_evidence(p, judge.look)
        every = np.hstack([p["single"], p["among"], p["settled"]])
        certainty = judge.settle.certainty(every)
        if judge.choose is not None and len(certainty):
            value = judge.choose.value(every)
            best = np.argmax(union_overlap(p["boxes"], p["boxes"]) ** 2 @ np.exp(value - value.max()))
            certainty[best] = certainty.max() * (1 + 1e-9)
            if p["truth"]:
                of_one.append(p["iou"][best].max())
        index = without_overlaps(p["boxes"], certainty, p["present"], 0.15)
        kept.append(certainty[index])
        cut = useful_cut(certainty[index], p["judge"] == "alone", len(p["present"]) >= SEVERAL)
        scores.append(rescaled(certainty[index], cut))
        iou.append(p["iou"][index])
    kept, iou, scores = np.concatenate(kept), np.concatenate(iou), np.concatenate(scores)
    order = np.argsort(-scores, kind="stable")
    kept, iou, scores = kept[order], iou[order], scores[order]
    free = np.ones(iou.shape[1], bool)
    hits = np.zeros(len(kept))
    for i in range(len(kept)):
        best = np.argmax(np.where(free, iou[i], 0))
        if free[best] and iou[i, best] >= RIGHT:
            free[best], hits[i] = False, 1
    curve = 2 * np.cumsum(hits) / (np.arange(len(kept)) + 1 + case["truth"])
    at = [float(curve[(kept >= c).sum() - 1]) if (kept >= c).any() else 0.0 for c in cuts]
    at.append(float(curve[(scores >= 0.5).sum() - 1]) if (scores >= 0.5).any() else 0.0)
    reach = np.concatenate([p["iou"] for p in case["parts"]])
    reached = float((reach.max(axis=0, initial=0.0) >= RIGHT).mean())
    return [*at, float(curve.max(initial=0.0)), reached, float(np.mean(of_one)) if of_one else np.nan]


def report(title, cases, models):
    """Print a line per kind of case."""
    cuts = (0.2, 0.3, 0.4, 0.5)
    rows = defaultdict(list)
    for case in cases:
        rows[case["kind"]].append(f1(case, models, cuts))
    print(f"{title}: mean F1 by cut, of the best cut, share of boxes among the candidates, IoU where there is one each")
    print(f"  {'':18s} cases  " + "  ".join(f"{c:5.2f}" for c in cuts) + "  default   best  reach    IoU")
    for kind in sorted(rows):
        print(f"  {kind:18s} {len(rows[kind]):5d}  " + "  ".join(f"{v:5.3f}" for v in np.mean(rows[kind], axis=0)))


def shortest(number):
    """A weight in three decimals, no zero more than needed."""
    return f"{round(number, 3) + 0.0:.3f}".rstrip("0").rstrip(".").replace("-0.", "-.").removeprefix("0") or "0"


def written(models):
    """Write the table where the engine finds it."""
    rows = [
        '"""Weights of the models of `calibration` by evidence; a benchmark writes this file."""',
        "",
        "TABLE: dict[str, dict[str, dict[str, str]]] = {",
    ]
    for place, judge in models.items():
        rows.append(f'    "{place}": {{')
        for stage in ("glance", "look", "settle", "choose"):
            model = getattr(judge, stage)
            if model is None:
                continue
            weights = np.column_stack([model.weights, model.reasons.reshape(len(model.names), -1)])
            numbers = {calibration.OFFSET: [model.offset, *model.thresholds]}
            if len(model.worth):
                numbers[calibration.WORTH] = model.worth
            numbers |= {n: w for n, w in zip(model.names, weights, strict=True) if (np.abs(w) >= 5e-4).any()}
            rows.append(f'        "{stage}": {{')
            rows += [f'            "{name}": "{" ".join(map(shortest, some))}",' for name, some in numbers.items()]
            rows.append("        },")
        rows.append("    },")
    TABLE.write_text("\n".join([*rows, "}", ""]))


def use(models):
    """Let the engine collect candidates with these models."""
    survey.AT_HOME, survey.ABROAD, survey.ALONE = (models[name] for name in JUDGEMENTS)


def main():
    """Collect, fit, report, write."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--facades", type=int, help="at most so many")
    parser.add_argument("--share", type=float, default=1.0, help="share of the facades' cases")
    parser.add_argument("--rounds", type=int, default=2, help="how often candidates are collected anew")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--half", type=int, choices=(0, 1), help="fit the written table to every other layout alone")
    parser.add_argument("--report", action="store_true", help="fit each half and report it on the other one")
    parser.add_argument("--keep", help="write the collected evidence to this file")
    parser.add_argument("--kept", help="read it from this file instead of collecting it")
    parser.add_argument("--only", choices=JUDGEMENTS, nargs="+", default=list(JUDGEMENTS), help="judgements to fit")
    parser.add_argument("--seed", type=int, default=5)
    args = parser.parse_args()
    root = os.environ.get("GEOANALOGY_DATA")
    if not root or not pathlib.Path(root, "cmp_facades").is_dir():
        print("GEOANALOGY_DATA names no folder with cmp_facades: nothing is calibrated")
        return
    root = pathlib.Path(root)
    paths = sorted((root / "cmp_facades" / "dev").glob("*.json"))
    if args.facades:
        paths = paths[:: max(1, len(paths) // args.facades)]
    for turn in range(1 if args.kept else args.rounds):
        if args.kept:
            every = pickle.loads(pathlib.Path(args.kept).read_bytes())
        else:
            every = collected(every_case(root, paths, args.seed, "alone" in args.only, args.share))
        if args.keep:
            pathlib.Path(args.keep).write_bytes(pickle.dumps(every))
        layouts = sorted({c["layout"] for c in every})
        halves = [set(layouts[::2]), set(layouts[1::2])]
        for i, half in enumerate(halves):
            if not args.report and args.half != i:
                continue
            models = fit([c for c in every if c["layout"] in half], args.only)
            report(f"round {turn + 1}, not fitted half {1 - i}", [c for c in every if c["layout"] not in half], models)
            sys.stdout.flush()
            if args.half == i:
                of_half = models
        models = fit(every, args.only) if args.half is None else of_half
        use(models)
    if args.write:
        written(models)


if __name__ == "__main__":
    main()
