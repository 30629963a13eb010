"""Print what pip must install to work on the project: its dependencies and those of the extras named.

python scripts/list_requirements.py dev bpy | pip install --requirement /dev/stdin
"""

import sys
import tomllib
from pathlib import Path

project = tomllib.loads((Path(__file__).resolve().parents[1] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
print(
    *project["dependencies"],
    *(line for name in sys.argv[1:] for line in project["optional-dependencies"][name]),
    sep="\n",
)
