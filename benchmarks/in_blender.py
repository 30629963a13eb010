"""Measuring in a process that has the bpy module."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

#: What programs begin with: the most memory that this process had, in megabytes, and the words that it ends with.
BEGIN = """
import os, resource, sys, time
from pathlib import Path
import numpy as np
import bpy
def peak():
    status = Path("/proc/self/status")
    if status.exists():  # what the system says of resources includes the process that has started this one
        return next(int(line.split()[1]) for line in status.read_text().splitlines() if line[:5] == "VmHWM") / 1e3
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
def end(*values):
    print("RESULT", *values)
    sys.stdout.flush()
    os._exit(0)
"""


def in_blender(program: str, *arguments: object) -> list[float] | None:
    """The figures that a program ends with, run in a process that has the bpy module; None where there is none."""
    if importlib.util.find_spec("bpy") is None:
        return None
    command = [sys.executable, "-c", BEGIN + program, *map(str, arguments)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("RESULT")]
    return [float(v) for v in line.split()[1:]]
