"""The 26 edits that furnish the apartment floor."""

from __future__ import annotations

from .edit import Edit

#: Furniture keeps its size.
FIXED = {"scale": "fixed"}
MIRRORED = {**FIXED, "mirror": True}


def near(*labels: str) -> dict[str, object]:
    """Options where above all the place beside some things counts."""
    return {**FIXED, "relation_weights": dict.fromkeys(labels, 4.0)}


EDITS = [
    # bedroom 4 a
    Edit("double bed", (35.11, 19.80, 0.0), most=1, options=FIXED),
    Edit("night table", (34.27, 20.93, 0.0), most=2, options=MIRRORED),
    Edit("wardrobe", (35.00, 17.37, 90.0), most=1, options=FIXED),
    Edit("desk", (36.60, 21.58, -90.0), most=1, options=FIXED),
    Edit("office chair", (36.60, 20.86, 90.0), most=1, threshold=0.6, options=near("desk")),
    Edit("chest", (37.90, 19.70, 180.0), most=1, options=FIXED),
    # living room 6
    Edit("television", (20.715, 3.10, 180.0), most=1, options=FIXED),
    Edit("coffee table", (19.00, 3.10, 0.0), most=1, options=near("television")),
    Edit("sofa", (17.75, 3.10, 0.0), most=1, options=near("coffee table")),
    Edit("armchair", (18.90, 1.62, 90.0), most=1, options={**near("coffee table", "sofa"), "mirror": True}),
    Edit("dining table", (19.60, 5.64, -90.0), most=1, options=FIXED),
    Edit(
        "dining chair", (18.88, 5.25, 0.0), most=4, options={**near("dining table"), "mirror": True, "symmetries": True}
    ),
    Edit("bookshelf", (16.73, 0.90, 0.0), most=1, options=FIXED),
    Edit("potted plant", (20.60, 0.45, 180.0), most=1, options=FIXED),
    # kitchen 2
    Edit("fridge", (19.61, 15.02, 180.0), most=1, options=FIXED),
    Edit("sink", (19.63, 14.25, 180.0), most=1, options=FIXED),
    Edit("stove", (19.63, 13.50, 180.0), most=1, options=FIXED),
    Edit("dishwasher", (19.63, 12.90, 180.0), most=1, options=FIXED),
    # bathroom 1
    Edit("bathtub", (2.65, 11.94, 0.0), most=1, options=FIXED),
    Edit("washbasin", (3.95, 11.31, 90.0), most=1, options=FIXED),
    Edit("toilet", (4.60, 11.90, 180.0), most=1, options=FIXED),
    Edit("washing machine", (2.57, 13.43, -90.0), most=1, options=FIXED),
    Edit("bath mat", (3.35, 11.94, 0.0), most=1, options=FIXED),
    # toilet 5, closet 6, hall 6
    Edit("toilet", (8.00, 9.50, 180.0), most=1, options=FIXED),
    Edit("shelf", (13.285, 6.70, 0.0), most=1, options=FIXED),
    Edit("shoe cabinet", (17.58, 8.40, 180.0), most=1, options=FIXED),
]
