"""Weights of the three logistic models of `calibration`, by the name of the evidence."""

TABLE: dict[str, dict[str, float]] = {
    "glance": {
        "offset": -3.0,
        "similarity": 2.0,
        "anchors": 2.0,
        "best anchor": 2.0,
        "shape": -4.0,
        "covered": -1.0,
        "outside": -2.0,
    },
    "look": {
        "offset": -3.0,
        "similarity": 2.0,
        "anchors": 2.0,
        "best anchor": 2.0,
        "shape": -4.0,
        "covered": -1.0,
        "outside": -2.0,
    },
    "settle": {
        "offset": -3.0,
        "similarity": 2.0,
        "anchors": 2.0,
        "best anchor": 2.0,
        "shape": -4.0,
        "covered": -1.0,
        "outside": -2.0,
    },
}
