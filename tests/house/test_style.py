"""Formatting, lint and types: as `make lint` runs them."""

import subprocess
import sys

import pytest
from checkout import ROOT


@pytest.mark.parametrize(
    "command",
    [["ruff", "format", "--check", "--diff", "."], ["ruff", "check", "."], ["mypy"]],
    ids=["format", "lint", "types"],
)
def test_style(command):
    done = subprocess.run([sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True, encoding="utf-8")
    assert done.returncode == 0, f"{' '.join(command)}:\n{done.stdout}{done.stderr}"
