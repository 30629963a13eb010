"""Run this folder's tests inside a complete Blender.

    blender -b --python-exit-code 1 --python tests/blender/run_in_blender.py -- SITE [pytest's arguments]

SITE is a folder that holds pytest (`pip install --target SITE pytest`), since Blender's Python has none; it comes last
on the path, so that Blender's own packages win.
"""

import sys
from pathlib import Path

site, *arguments = sys.argv[sys.argv.index("--") + 1 :]
sys.path.append(site)
sys.dont_write_bytecode = True

import pytest  # noqa: E402

here = Path(__file__).resolve().parent
sys.exit(pytest.main(["-p", "no:cacheprovider", "--rootdir", str(here.parents[1]), str(here), *arguments]))
