"""Fitting transformation functions to the lines of the drawing: every candidate is verified and refined.

The sets of correspondences that section 3.5 finds are coarse (their query points lie beside the lines, not on them),
and some are wrong in a way that only the lines can tell. So each candidate is fitted to the contours: samples of the
query's lines look for their counterparts along the lines near their images (Viterbi, so that neighbours stay
neighbours), the smoothest function through the counterparts is one linear solve, and the two alternate.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Contours, Floats
from .growing import grown
from .least_squares import Blended
from .query import Query
from .samples import Samples, Sampling
from .target import Target
from .transformation import Nodes, TransformationFunction, smoothness

#: Stiffness of the functions, round by round: (strain, bend) weights beside a mean squared distance of 1.
ROUNDS = ((0.3, 0.3), (0.1, 0.2), (0.03, 0.1), (0.02, 0.1), (0.01, 0.1), (0.01, 0.1))
#: After so many rounds only some candidates are fitted on: those with most counterparts and evidence.
FIRST_ROUNDS = 2
#: In the rounds before that, one of so many samples is fitted, where they still turn by this share of what all do: with
#: fewer, teeth and marks along a line would be passed over, and with them how far along it a target lies.
COARSE, TURNED = 2, 0.8
#: Candidates whose images' centres are nearer than this, in extents of the images, are of one place.
PLACE = 0.35
#: Functions that take the query points on average nearer than this, in extents of the images, lead to one fit.
SAME = 0.01
#: Distance, in extents of the query at the target's scale, at which a counterpart is no evidence any more.
FAR = 0.05


@dataclass(frozen=True)
class Costs:
    """Costs of the Viterbi search for counterparts.

    Attributes
    ----------
    stretch, turn : float
        Of stretch and of turn between neighbours, beside a squared distance in units of FAR.
    missing : float
        Of a sample without counterpart.
    """

    stretch: float
    turn: float
    missing: float


#: While fitting, lines that were cut should rather end than be stretched, and corners should fall on corners. What a
#: fit is worth is measured by counterparts that were not chosen to turn alike: then their turns say something.
FITTING, MEASURING = Costs(0.8, 3.0, 0.15), Costs(0.35, 1.5, 0.4)
#: Cost of stepping to another line (and the squared distance, in units of FAR, by which the step misses the one of the
#: image), and of any step at most.
CHANGE, MOST_COST = 0.15, 4.0


@dataclass(frozen=True)
class Fit:
    """A transformation function and its evidence at the samples.

    Attributes
    ----------
    function : TransformationFunction
    counterpart : (s,) int
        Index into the target's points of each sample's counterpart, -1 where it has none.
    distance : (s,) float
        Distance of counterpart and image, in extents of the query at the target's scale; infinite without counterpart.
    tilt : (s,) float
        Unsigned angle between the line's image and the line there, radians.
    """

    function: TransformationFunction
    counterpart: NDArray[np.intp]
    distance: Floats
    tilt: Floats


class Fitter:
    """Fits many candidates of one query at once."""

    def __init__(self, contours: Contours, query: Query, nodes: Nodes):
        self.target = Target(contours, query)
        self.nodes, self.size = nodes, query.size
        self.strain, self.bend = smoothness(nodes)
        self.sampling, coarse = (Sampling.of(contours, query, nodes, every) for every in (1, COARSE))
        simple = coarse.samples.turning >= TURNED * self.sampling.samples.turning
        self.coarse = coarse if simple else self.sampling

    def start(
        self, source: Complex, image: Complex, weight: Floats, stiffness: tuple[float, float] = (0.3, 0.3)
    ) -> Complex:
        """Unknowns (2m,) of the smoothest function through given correspondences (images conjugated where mirrored)."""
        return self.solve(Blended(self.nodes, source), image[None], weight[None], stiffness)[0]

    def through(self, node: NDArray[np.intp], image: Complex, factor: Complex, weight: Floats) -> Complex:
        """Unknowns (2m,) of the smoothest function near given similarities at some of the nodes."""
        m = len(self.nodes.at)
        at = np.concatenate([node, m + node])
        share = np.concatenate([weight, 0.5 * weight * self.nodes.spacing**2]) / max(1.5 * weight.sum(), 1e-12)
        left, right = np.zeros((2 * m, 2 * m), complex), np.zeros(2 * m, complex)
        np.add.at(left, (at, at), share)
        np.add.at(right, at, share * np.concatenate([image, factor]))
        return np.linalg.solve(left + self._smooth(0.1, 0.1), right)

    def solve(
        self,
        source: Blended,
        image: Complex,
        weight: Floats,
        stiffness: tuple[float, float],
        rigid: tuple[float, Complex] | None = None,
    ) -> Complex:
        """Weighted least squares with smoothness, for several candidates: (h, k) images and weights to (h, 2m).

        `rigid` is a weight and the factors (h, m) of functions before: the factors are drawn to their rotations at one
        scale, the median of theirs. That is "as rigid as possible", one step at a time: a rotation by itself is no
        linear function of a factor, towards a known one it is.
        """
        smooth, m = self._smooth(*stiffness), len(self.nodes.at)
        if rigid is None:
            return source.solve(image, weight, smooth)
        share, size = rigid[0] * self.nodes.spacing**2 / m, np.abs(rigid[1])
        factors = np.arange(m, 2 * m)
        smooth[factors, factors] += share
        toward = np.zeros((len(image), 2 * m), complex)
        toward[:, m:] = share * np.median(size, axis=1, keepdims=True) * rigid[1] / np.maximum(size, 1e-12)
        return source.solve(image, weight, smooth, toward)

    def _smooth(self, strain: float, bend: float) -> Complex:
        """What keeps functions smooth, (2m, 2m), and normal equations solvable."""
        return strain * self.strain + bend * self.bend + 1e-9 * np.eye(len(self.strain))

    def fit(
        self,
        unknowns: Complex,
        mirrored: NDArray[np.bool_],
        finalists: tuple[int, int],
        agreeing: Callable[[Complex, NDArray[np.bool_]], Floats],
    ) -> list[Fit]:
        """Refine candidates, and give up those that find few lines.

        Parameters
        ----------
        unknowns : (h, 2m) complex
            Functions to start from.
        mirrored : (h,) bool
        finalists : (int, int)
            Candidates that are fitted to the end: of each place, and in all.
        agreeing : callable
            What else speaks for functions, (h,) from 0 to 1: those that are stretched over a gap find the most lines.
        """
        sampling = self.coarse
        for number, stiffness in enumerate(ROUNDS):
            if number == FIRST_ROUNDS:
                _, _, weight, _, _ = self.counterparts(sampling, unknowns, mirrored, FITTING)
                order = np.argsort(-weight.mean(1) * (0.5 + 0.5 * agreeing(unknowns, mirrored)), kind="stable")
                near = SAME * self.size * np.abs(unknowns[:, len(self.nodes.at) :]).mean(1)
                order = order[distinct(unknowns[order], mirrored[order], near[order])]
                best = order[self.apart(unknowns[order], mirrored[order], *finalists)]
                unknowns, mirrored = unknowns[best], mirrored[best]
                sampling = self.sampling
            unknowns = self.moved(sampling, unknowns, mirrored, stiffness)
        return self.measured(unknowns, mirrored)

    def moved(
        self,
        sampling: Sampling,
        unknowns: Complex,
        mirrored: NDArray[np.bool_],
        stiffness: tuple[float, float],
        costs: Costs = FITTING,
        rigidity: float = 0.0,
        growing: bool = False,
    ) -> Complex:
        """One round: functions (h, 2m) moved onto their counterparts, which may be continued along the lines.

        `rigidity` is the weight of one scale beside a mean squared distance of 1.
        """
        at, image, weight, _, _ = self.counterparts(sampling, unknowns, mirrored, costs)
        if growing:
            image, weight = grown(sampling, self.target, unknowns, mirrored, (at, image, weight))
        rigid = (rigidity, unknowns[:, len(self.nodes.at) :]) if rigidity > 0.0 else None
        return self.solve(sampling.blended, image, weight + 1e-6, stiffness, rigid)

    def measured(self, unknowns: Complex, mirrored: NDArray[np.bool_]) -> list[Fit]:
        """Functions as fits: with counterparts that say what they are worth."""
        at, _, _, distance, tilt = self.counterparts(self.sampling, unknowns, mirrored, MEASURING)
        m = len(self.nodes.at)
        return [
            Fit(TransformationFunction(self.nodes, u[:m], u[m:], bool(flip)), a, d, t)
            for u, flip, a, d, t in zip(unknowns, mirrored, at, distance, tilt, strict=True)
        ]

    def promise(self, unknowns: Complex, mirrored: NDArray[np.bool_]) -> Floats:
        """How many of some samples land near lines that run along their images, (h,): what is worth fitting."""
        image = unknowns @ self.sampling.rows[::3].T
        way = np.angle(unknowns @ self.sampling.ahead[::3].T - image)
        seen = np.where(mirrored[:, None], np.conj(image), image)
        way = np.where(mirrored[:, None], -way, way)
        gap, near = self.target.tree.query(np.stack([seen.real, seen.imag], -1))
        m = len(self.nodes.at)
        unit = np.maximum(np.abs(unknowns[:, m:]).mean(1) * self.size, 1e-12)[:, None]
        along = np.cos(self.target.heading[near] - way) ** 2
        return np.asarray((np.exp(-0.5 * (gap / (FAR * unit)) ** 2) * (0.5 + 0.5 * along)).mean(1), dtype=np.float64)

    def places(self, unknowns: Complex, mirrored: NDArray[np.bool_]) -> tuple[Complex, Floats]:
        """Where functions lead: the centres of the images, (h,), and their extents, (h,)."""
        m = len(self.nodes.at)
        centre = unknowns[:, :m].mean(1)
        return np.where(mirrored, np.conj(centre), centre), self.size * np.abs(unknowns[:, m:]).mean(1)

    def apart(self, unknowns: Complex, mirrored: NDArray[np.bool_], each: int, most: int) -> NDArray[np.intp]:
        """Indices of about `most` candidates, given best first: of every place `each`, then the best of the rest.

        A place with many candidates (a circle fits in every direction) would otherwise crowd out all others. Every
        place gets its first before any gets its second; where there are more places than `most`, up to half as many
        more candidates are taken.
        """
        centre, extent = self.places(unknowns, mirrored)
        turn = np.full(len(unknowns), each)
        kept: list[int] = []
        for i in range(len(unknowns)):
            reach = PLACE * np.maximum(extent[i], extent[kept])
            before = int((np.abs(centre[kept] - centre[i]) < reach).sum())
            if before < each:
                kept.append(i)
                turn[i] = before
        most = min(max(most, int((turn == 0).sum())), 3 * most // 2)
        return np.sort(np.argsort(turn, kind="stable")[:most])

    def counterparts(
        self, sampling: Sampling, unknowns: Complex, mirrored: NDArray[np.bool_], costs: Costs
    ) -> tuple[NDArray[np.intp], Complex, Floats, Floats, Floats]:
        """Counterparts of the samples on the lines near their images, by Viterbi along the query's lines."""
        s, target = sampling.samples, self.target
        image = unknowns @ sampling.rows.T
        way = np.angle(unknowns @ sampling.ahead.T - image)
        m = len(self.nodes.at)
        scale = np.abs(unknowns[:, m:]).mean(1)
        unit = np.maximum(scale * self.size, 1e-12)[:, None]
        seen = np.where(mirrored[:, None], np.conj(image), image)
        seen_way = np.where(mirrored[:, None], -way, way)
        _, near = target.tree.query(np.stack([seen.real, seen.imag], -1), k=24)
        # the nearest point whose line runs along the image
        gap = np.abs(target.points[near] - seen[:, :, None]) / unit[:, :, None]
        skew = np.abs(np.sin(target.heading[near] - seen_way[:, :, None]))
        pick = np.argmin(gap + 0.05 * skew, axis=2)
        centre = np.take_along_axis(near, pick[:, :, None], 2)[:, :, 0]
        stride = np.maximum(1, np.round(0.5 * s.step.max() * scale[:, None] / target.spacing[centre])).astype(int)
        offset = stride[:, :, None] * np.arange(-sampling.band, sampling.band + 1)
        at = target.walk(np.broadcast_to(centre[:, :, None], offset.shape), offset)
        point = target.points[at]
        distance = np.abs(point - seen[:, :, None]) / unit[:, :, None]
        angle = target.heading[at] - seen_way[:, :, None]
        tilt = np.abs(np.arcsin(np.clip(np.sin(angle), -1, 1)))
        cost = (distance / FAR) ** 2 + np.sin(angle) ** 2 * 0.5
        cost[at < 0] = np.inf
        chosen = self._viterbi(s, cost, at, point, seen, np.sign(np.cos(angle)), scale, mirrored, costs)
        h, k = np.indices(chosen.shape)
        here = at[h, k, chosen]
        away, skewed = distance[h, k, chosen], tilt[h, k, chosen]
        missing = chosen < 0
        here = np.where(missing, -1, here)
        away = np.where(missing, np.inf, away)
        weight = np.where(missing, 0.0, 1.0 / (1.0 + (away / FAR) ** 2) ** 2)
        goal = np.where(mirrored[:, None], np.conj(target.points[here]), target.points[here])
        return here, goal, weight, away, np.where(missing, np.pi / 2, skewed)

    def _viterbi(
        self,
        s: Samples,
        cost: Floats,
        at: NDArray[np.intp],
        point: Complex,
        seen: Complex,
        side: Floats,
        scale: Floats,
        mirrored: NDArray[np.bool_],
        costs: Costs,
    ) -> NDArray[np.intp]:
        """Index of the chosen candidate of every sample (h, s); -1: none."""
        target = self.target
        count, length, width = cost.shape
        single = np.float32
        missing = single(costs.missing)
        cost = np.minimum(cost, 1e6).astype(single)
        total = np.concatenate([cost[:, 0], np.full((count, 1), missing)], 1)
        back = np.zeros((length, count, width + 1), np.int8)
        sign = np.where(mirrored, -1.0, 1.0).astype(single)[:, None, None]
        unit = (FAR * scale * self.size).astype(single)[:, None, None]
        # what each candidate says, once; the steps only take differences
        stretch_of, heading = target.stretch[at], target.heading[at].astype(single)
        place, side = target.place[at].astype(single), side.astype(single)
        spacing, around = target.spacing[at].astype(single), target.around[at].astype(single)
        away = (point - seen[:, :, None]).astype(np.complex64)
        full = np.empty((count, width + 1, width + 1), single)  # the candidate before last: minima of rows are fast
        full[:, -1, :] = full[:, :, -1] = 0.3
        full[:, -1, -1] = 0.0
        for i in range(1, length):
            before, here = (slice(None), i - 1, None, slice(None)), (slice(None), i, slice(None), None)
            move = full[:, :-1, :-1]
            if s.step[i] == 0.0:
                move[...] = 0.0
            else:
                walk = place[here] - place[before]
                walk -= around[before] * np.round(walk / around[before])
                walk *= spacing[before] * side[here] / (s.step[i] * scale).astype(single)[:, None, None]
                stretch = np.log(np.maximum(walk, single(0.03)))
                turn = heading[here] - heading[before]
                turn -= single(2 * np.pi) * np.round(turn / single(2 * np.pi))
                turn *= side[here] * side[before] > 0
                miss = sign * single(s.turn[i]) - turn
                np.minimum(
                    single(costs.stretch) * stretch**2 + single(costs.turn) * np.minimum(miss**2, single(2.0)),
                    single(MOST_COST),
                    out=move,
                )
                other = stretch_of[before] != stretch_of[here]
                if other.any():
                    jump = np.abs(away[here] - away[before]) / unit
                    np.copyto(move, np.minimum(single(CHANGE) + jump**2, single(MOST_COST)), where=other)
            step = full + total[:, None, :]
            best = step.argmin(2)
            back[i] = best
            total = np.take_along_axis(step, best[:, :, None], 2)[:, :, 0]
            total[:, :-1] += cost[:, i]
            total[:, -1] += missing
        chosen = np.empty((count, length), int)
        chosen[:, -1] = total.argmin(1)
        rows = np.arange(count)
        for i in range(length - 1, 0, -1):
            chosen[:, i - 1] = back[i][rows, chosen[:, i]]
        return np.where(chosen == width, -1, chosen)


def distinct(unknowns: Complex, mirrored: NDArray[np.bool_], near: Floats) -> NDArray[np.intp]:
    """Indices of the first of every group of functions that map the query points to nearly the same places.

    Parameters
    ----------
    unknowns : (h, 2m) complex
    mirrored : (h,) bool
    near : (h,) float
        Mean distance from an earlier function up to which one repeats it.

    Returns
    -------
    (k,) int
        Ascending.
    """
    at = unknowns[:, : unknowns.shape[1] // 2]
    kept: list[int] = []
    for k in range(len(at)):
        same = mirrored[kept] == mirrored[k]
        if not (np.abs(at[kept] - at[k]).mean(1)[same] <= near[k]).any():
            kept.append(k)
    return np.array(kept, dtype=np.intp)
