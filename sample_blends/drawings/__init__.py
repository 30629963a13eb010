"""Drawings for chapter 3: one region is painted, all that are like it follow."""

#: The pictures, by the figures of the thesis.
SCENES = (
    "snakes",
    "clovers",
    "fish",
    "corals",
    "giraffes",
    "harlequin",
    "skins",
    "butterflies",
    "flowers",
    "sun",
)
