"""Learning a placement from examples, and placing (chapter 5): the public face of the engine."""

from collections import OrderedDict
from collections.abc import Sequence
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arguments import flag, given, number
from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.rectangle import Rectangle
from ..geometry.scene import Scene
from ..progress import Progress, Stepper, run
from ..tolerances import PARALLEL_ANGLE
from .arrangement import Arrangement, arrangement_of
from .doubles import without_doubles
from .examples import Example, Orientation, checked, nearest_directions, orientation_of, parents_of
from .lesson import Lesson
from .options import PlacementOptions
from .pairs import with_twins
from .refinement import refined
from .regression import predicted_targets
from .results import Placement, disjoint, told
from .rule import Relation, learned_rule, reasons
from .selection import rescaled, shape_factor, useful_cut, without_overlaps
from .siblings import row_odds, standing_of
from .signature import PARENT_BOX, Signature, signature
from .survey import Survey, more_certain, survey
from .taught import Taught, coverage, teach

Array = NDArray[np.float64]

#: Arrangements whose candidates a model remembers: those on the screen, not those of a city.
SURVEYS_KEPT = 64
#: By how much the certainty of the one placement of a parent exceeds that of all others: it goes before them.
FOREMOST = 1 + 1e-9
#: Examples in one arrangement from which they may be all that is meant there: one alone shows no more than its kind.
SEVERAL = 2
#: What a stored model calls its form.
SCHEMA = "geoanalogy.placement/1"


class PlacementModel:
    """A learned placement: it holds all it needs, no scenes.

    Made by `learn_placement` or `from_dict`.

    Parameters
    ----------
    label : str
        Label of the polygons that placements are made in.
    orientation : Orientation
    lesson : Lesson
    """

    def __init__(self, label: str, orientation: Orientation, lesson: Lesson) -> None:
        self.label = label
        self.orientation = orientation
        self.lesson = lesson
        self._surveys: OrderedDict[Arrangement, Survey] = OrderedDict()

    @property
    def options(self) -> PlacementOptions:
        """The options it was learned with."""
        return self.lesson.options

    def place(
        self,
        scene: Scene,
        threshold: float | None = None,
        progress: Progress | None = None,
        include_examples: bool = False,
    ) -> list[Placement]:
        """Every place in a scene that stands in the learned relations.

        Parameters
        ----------
        scene : Scene
        threshold : float, optional
            Least score; None: that of the options; 0: all candidates, overlapping or not.
        progress : callable (fraction, text) -> bool, optional
            Returning False cancels.
        include_examples : bool
            Whether examples that were drawn in this very arrangement are placed again, with their target as score; for
            replaying an edit from scratch.

        Returns
        -------
        list of Placement
            Best first; from a threshold above 0 on, without overlaps among themselves and with the examples.

        Raises
        ------
        InputError
            For a threshold outside [0, 1].
        Cancelled
            When `progress` returned False.
        """
        return run(self.placing(scene, threshold, include_examples), progress)

    def placing(
        self, scene: Scene, threshold: float | None = None, include_examples: bool = False
    ) -> Stepper[list[Placement]]:
        """`place` as a stepper: one step per parent.

        Parameters
        ----------
        scene : Scene
        threshold : float, optional
        include_examples : bool

        Returns
        -------
        generator of (float, str)
            Returns the list of Placement.
        """
        least = self.options.threshold if threshold is None else threshold
        given(scene, Scene, "the scene", "Scene([polygon, …])")
        flag(include_examples, "include_examples")
        least = number(least, "the threshold", 0, 1)
        parents = [p for p in scene.polygons if p.label == self.label]
        taught = [self.lesson.taught[i].standing for i in self.lesson.positive]
        against = row_odds(scene, self.label, [s for s in taught if s is not None])
        found: list[Placement] = []
        for i, parent in enumerate(parents):
            yield i / len(parents), f"placing in {self.label or 'polygon'} {i + 1} of {len(parents)}"
            found += self._place_in(scene, parent, least, include_examples, against.get(str(parent.id), 0.0))
        return sorted(found, key=lambda p: -p.score)

    def novelties(self, scene: Scene) -> list[tuple[Polygon, float]]:
        """How far every parent is from anything that was taught, whether something is placed there or not.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        list of (Polygon, float)
            1 less the similarity of the place most like an example, 1 where there is no such place; the newest first:
            there an example more would help most.
        """
        found = []
        given(scene, Scene, "the scene", "Scene([polygon, …])")
        for parent in (p for p in scene.polygons if p.label == self.label):
            nearest = 0.0
            for frame in self.orientation.frames(parent):
                arrangement = arrangement_of(scene, parent, frame)
                shown = self.shown_in(arrangement)
                seen = self._survey(arrangement, *self._drawn(arrangement, shown))
                nearest = max(nearest, float(seen.similarities.max(initial=0.0)), float(any(shown)))
            found.append((parent, float(np.clip(1.0 - nearest, 0.0, 1.0))))
        return sorted(found, key=lambda one: -one[1])

    def _place_in(
        self, scene: Scene, parent: Polygon, least: float, include_examples: bool, against: float
    ) -> list[Placement]:
        found: list[Placement] = []
        frames = self.orientation.frames(parent)
        for frame in frames:
            arrangement = arrangement_of(scene, parent, frame)
            shown = self.shown_in(arrangement)
            positive, drawn = self._drawn(arrangement, shown)
            seen = self._survey(arrangement, positive, drawn)
            score = more_certain(self.scores(seen, drawn), against)
            good = score >= max(least, 1e-6)
            if self.orientation.by_segment:
                good &= self._faces(arrangement, seen.boxes)
            if self.options.forbid_intersections:
                good &= ~self._intersects(arrangement, seen.boxes)
            index = np.flatnonzero(good)
            if least > 0:
                index = index[without_overlaps(seen.boxes[index], score[index], drawn, self.options.allow_overlaps)]
            else:
                index = index[np.argsort(-score[index], kind="stable")]
            allowed = self.options.allow_overlaps if least > 0 else 1.0
            boxes, similar = refined(self.lesson, arrangement, seen, index, drawn, allowed)
            score = score[index]
            if least > 0:
                boxes, similar, score = with_twins(self.lesson, arrangement, positive, boxes, similar, score)
                still = without_overlaps(boxes, score, drawn, self.options.allow_overlaps)
                still = still[score[still] >= least]
                still = still[without_doubles(self.lesson, arrangement, boxes[still], drawn)]
                boxes, similar, score = boxes[still], similar[still], score[still]
            why = cache(partial(self._reasons, arrangement, boxes))
            for k, (box, alike) in enumerate(zip(boxes, similar, strict=True)):
                like = self.lesson.positive[np.argmax(alike[self.lesson.positive])]
                found.append(
                    Placement(
                        Rectangle.from_box(box, frame, self.lesson.taught[like].quarter),
                        float(score[k]),
                        parent,
                        float(np.clip(1.0 - alike.max(), 0.0, 1.0)),
                        partial(told, why, k),
                    )
                )
            if include_examples:
                found += [Placement(t.rectangle, t.target, parent, 0.0) for t in shown if t.target >= max(least, 1e-6)]
        return disjoint(found, self.options.allow_overlaps) if len(frames) > 1 and least > 0 else found

    def _reasons(self, arrangement: Arrangement, boxes: Array) -> list[tuple[Relation, ...]]:
        """Why boxes are where they are."""
        seen = signature(arrangement, boxes, self.options.neighbours, self.lesson.labels, outlines=False)
        return reasons(self.lesson, self.label, self.lesson.match(seen))

    def _survey(self, arrangement: Arrangement, positive: Array, drawn: Array) -> Survey:
        """The rated candidates of an arrangement; the last few are kept, so that another threshold costs no search."""
        if arrangement not in self._surveys:
            self._surveys[arrangement] = survey(self.lesson, arrangement, positive, drawn)
            if len(self._surveys) > SURVEYS_KEPT:
                self._surveys.popitem(last=False)
        return self._surveys[arrangement]

    def rule(self) -> list[Relation]:
        """The learned rule in words.

        Returns
        -------
        list of Relation
            The surest first.
        """
        return learned_rule(self.lesson, self.label)

    def shown_in(self, arrangement: Arrangement) -> list[Taught]:
        """The examples that were drawn in this very arrangement.

        Parameters
        ----------
        arrangement : Arrangement

        Returns
        -------
        list of Taught
        """
        same = [t for t in self.lesson.taught if t.fingerprint == arrangement.fingerprint]
        if not self.orientation.by_segment:
            return same
        centres = np.array([(t.rectangle.x, t.rectangle.y) for t in same]).reshape(-1, 2)
        if not same:
            return []
        facing = nearest_directions(arrangement.parent, centres) + self.orientation.offset
        return [t for t, angle in zip(same, facing, strict=True) if _parallel(angle, arrangement.frame)]

    def _drawn(self, arrangement: Arrangement, shown: list[Taught]) -> tuple[Array, Array]:
        """Boxes of the positive and of all examples that were drawn here."""
        boxes = np.array([t.rectangle.box(arrangement.frame)[0] for t in shown]).reshape(-1, 4)
        return boxes[[t.target > 0 for t in shown]] if shown else boxes, boxes

    def scores(self, seen: Survey, drawn: Array) -> Array:
        """Scores of surveyed candidates.

        Their certainty, times the predicted target (eq. 5.6) and the penalty on shapes (eq. 5.9), scaled so that 0.5 is
        the score from which a result is of more use than harm in its arrangement.

        Parameters
        ----------
        seen : Survey
        drawn : ndarray of shape (k, 4)
            Examples drawn in the arrangement.

        Returns
        -------
        ndarray of shape (n,)
        """
        lesson = self.lesson
        if not len(seen.boxes):
            return np.zeros(0)
        target = predicted_targets(seen.contrast, lesson.contrast.gram, lesson.targets)
        shape = shape_factor(
            seen.boxes[:, 2:] - seen.boxes[:, :2],
            lesson.sizes[lesson.positive],
            self.options.aspect_tolerance,
            self.options.area_tolerance,
        )
        certainty = np.clip(seen.certainty * shape, 0.0, 1.0)
        if seen.chosen is not None:
            certainty[seen.chosen] = certainty.max() * FOREMOST
        wanted = certainty * target / lesson.targets.max()  # what is like a counter-example is no use at all
        apart = without_overlaps(seen.boxes, wanted, drawn, self.options.allow_overlaps)
        cut = useful_cut(wanted[apart], lesson.one_each and not len(drawn), len(drawn) >= SEVERAL)
        return np.minimum(rescaled(certainty, cut), 1.0) * target

    def _faces(self, arrangement: Arrangement, boxes: Array) -> NDArray[np.bool_]:
        """Whether the segment nearest to each box is one that the arrangement's frame belongs to."""
        centres = arrangement.unturned((boxes[:, :2] + boxes[:, 2:]) / 2)
        return _parallel(nearest_directions(arrangement.parent, centres) + self.orientation.offset, arrangement.frame)

    def _intersects(self, arrangement: Arrangement, boxes: Array) -> NDArray[np.bool_]:
        """Whether each box intersects an element of a label that no positive example intersects (section 5.5)."""
        covered = coverage(arrangement, boxes)[0]
        taught = [self.lesson.taught[i] for i in self.lesson.positive]
        hit = np.zeros(len(boxes), dtype=bool)
        for label, share in covered.items():
            if max(t.covered.get(label, 0.0) for t in taught) <= 0.02:
                hit |= share > 0.02
        return hit

    def to_dict(self) -> dict[str, Any]:
        """The model as plain data, as it is written to JSON.

        Returns
        -------
        dict
        """
        kept = self.lesson.kept
        return {
            "schema": SCHEMA,
            "label": self.label,
            "orientation": self.orientation.to_dict(),
            "options": self.options.to_dict(),
            "examples": [t.to_dict() for t in self.lesson.taught],
            "boxes": {key: _plain(value) for key, value in kept.boxes.items()},
            "outlines": {key: _plain(value) for key, value in kept.outlines.items()},
        }

    @classmethod
    def from_dict(cls, plain: dict[str, Any]) -> "PlacementModel":
        """The inverse of `to_dict`.

        Parameters
        ----------
        plain : dict

        Returns
        -------
        PlacementModel

        Raises
        ------
        InputError
            For data that is no stored placement model.
        """
        if not isinstance(plain, dict) or not isinstance(plain.get("schema"), str) or plain["schema"] != SCHEMA:
            raise InputError(f"this is no stored placement model (its schema is not {SCHEMA!r}); learn it again")
        try:
            taught = [Taught.from_dict(t) for t in plain["examples"]]
            kept = Signature(
                {key: np.array(value, dtype=np.float64) for key, value in plain["boxes"].items()},
                {key: np.array(value, dtype=np.float64) for key, value in plain["outlines"].items()},
            )
            if not taught or any(len(v) != len(taught) for part in (kept.boxes, kept.outlines) for v in part.values()):
                raise ValueError("its relations are not those of its examples")
            if PARENT_BOX not in kept.boxes:
                raise KeyError(PARENT_BOX)
            options = PlacementOptions.from_dict(plain["options"])
            return cls(
                given(plain["label"], str, "its label", "text"),
                Orientation(**plain["orientation"]),
                Lesson(taught, kept, options),
            )
        except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
            raise InputError(f"the stored placement model is damaged ({error}); learn it again") from error


def learn_placement(examples: Sequence[Example], options: PlacementOptions | None = None) -> PlacementModel:
    """Learn where rectangles are meant to be, from a few of them (sections 5.2 to 5.4).

    Parameters
    ----------
    examples : sequence of Example
        They may be of several scenes; 2 to 10 of them, if possible in different situations.
    options : PlacementOptions, optional

    Returns
    -------
    PlacementModel

    Raises
    ------
    InputError
        For no examples, examples outside every polygon, targets that are all 0, or two targets for one rectangle.
    """
    kept = checked(examples)
    parents = parents_of(kept)
    orientation = orientation_of(kept, parents)
    chosen = PlacementOptions() if options is None else options
    given(chosen, PlacementOptions, "options", "PlacementOptions(…)")
    drawn: dict[Arrangement, list[int]] = {}
    for i, (example, parent) in enumerate(zip(kept, parents, strict=True)):
        frame = orientation.frame_at(parent, np.array([example.rectangle.x, example.rectangle.y]))
        drawn.setdefault(arrangement_of(example.scene, parent, frame), []).append(i)
    lessons: dict[int, tuple[Taught, Signature]] = {}
    for arrangement, some in drawn.items():
        standing = standing_of(kept[some[0]].scene, arrangement.parent)
        taught = teach(arrangement, [(kept[i].rectangle, kept[i].target) for i in some], chosen, standing)
        lessons |= dict(zip(some, taught, strict=True))
    ordered = [lessons[i] for i in range(len(kept))]
    return PlacementModel(
        parents[0].label, orientation, Lesson.of([t for t, _ in ordered], [s for _, s in ordered], chosen)
    )


def _parallel(angle: Any, frame: float) -> Any:
    return np.abs((np.asarray(angle) - frame + np.pi) % (2 * np.pi) - np.pi) <= PARALLEL_ANGLE


def _plain(values: Array) -> Any:
    """Nested lists with None for NaN: JSON knows no NaN."""
    plain = values.astype(object)
    plain[np.isnan(values)] = None
    return plain.tolist()
