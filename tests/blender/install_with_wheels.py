"""Install a zip into a Blender of its own, use the engine, and say which libraries it used.

python tests/blender/install_with_wheels.py EXTENSION.zip RESULT.json
"""

import importlib
import json
import sys
from importlib import metadata
from pathlib import Path

import bpy  # isort: skip
import addon_utils

bpy.ops.extensions.package_install_files(filepath=sys.argv[-2], repo="user_default", enable_on_install=True)
engine = importlib.import_module("bl_ext.user_default.geoanalogy.geoanalogy")

import manifold3d  # noqa: E402  # the libraries are on the path only now
import scipy.spatial  # noqa: E402
import shapely  # noqa: E402

ring = engine.Polygon([(0, 0), (2, 0), (2, 1), (0, 1)]).points
result = {
    "manifold3d": [metadata.version("manifold3d"), manifold3d.__file__],
    "scipy": [scipy.__version__, scipy.__file__],
    "shapely": [shapely.__version__, shapely.__file__],
    "area": shapely.Polygon(ring[scipy.spatial.ConvexHull(ring).vertices]).area,
    "warnings": dict(addon_utils._extensions_warnings_get()),
}
Path(sys.argv[-1]).write_text(json.dumps(result))
