"""Run tests/blender with the bpy module, or inside the Blender given, and judge it by pytest's report.

    python scripts/run_blender_tests.py                   with the bpy module of this Python
    python scripts/run_blender_tests.py --blender PATH    inside that Blender

The bpy module may crash while Python shuts down, after the last test has passed: then the exit status says nothing, and
the report, which pytest writes when all is done, says everything. No report, no success.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.etree import ElementTree

import wheel_grid

ROOT = wheel_grid.ROOT
TESTS = ROOT / "tests" / "blender"


def judge(report: Path, status: int) -> int:
    """The exit status that the report deserves: 0 where tests ran and none failed."""
    if not report.is_file():
        print(f"pytest wrote no report (exit status {status}): it ended before the tests did.", file=sys.stderr)
        return status or 1
    counts = dict.fromkeys(("tests", "failures", "errors", "skipped"), 0)
    for suite in ElementTree.parse(report).getroot().iter("testsuite"):
        for key in counts:
            counts[key] += int(suite.get(key, 0))
    failed = counts["failures"] + counts["errors"]
    passed = counts["tests"] - failed - counts["skipped"]
    if status and not failed and passed:
        crashed = status < 0 or status > 128
        print(f"Blender ended with status {status} after all tests had passed.", file=sys.stderr)
        return 0 if crashed else status
    return 1 if failed or not passed else 0


def fetch_wheels(all_pythons: bool) -> None:
    """Fetch the libraries that the zip of this platform carries; a Blender's Python is known only once it runs."""
    pythons = wheel_grid.PYTHONS if all_pythons else [".".join(map(str, sys.version_info[:2]))]
    if wheel_grid.PLATFORM_HERE:
        command = [sys.executable, str(ROOT / "scripts" / "fetch_wheels.py"), "--platform", wheel_grid.PLATFORM_HERE]
        subprocess.run([*command, *(f"--python={python}" for python in pythons)], check=True)


def blender_command(blender: str, site: Path) -> list[str]:
    """The command that runs the tests inside a Blender, with a pytest that its Python lacks."""
    if not (site / "pytest").is_dir():
        subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--target", str(site), "pytest"], check=True)
    script = TESTS / "run_in_blender.py"
    return [blender, "--background", "--python-exit-code", "1", "--python", str(script), "--", str(site)]


def main() -> int:
    """Run, then judge."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", help="Blender's program; without it, the bpy module of this Python")
    arguments, pytest_arguments = parser.parse_known_args()
    fetch_wheels(all_pythons=arguments.blender is not None)
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder, "report.xml")
        profile = Path(folder, "profile")
        profile.mkdir()
        if arguments.blender:
            command = blender_command(arguments.blender, ROOT / ".venv" / "pytest-for-blender")
        else:
            command = [sys.executable, "-m", "pytest", str(TESTS)]
        command += [f"--junitxml={report}", "--durations=5", *pytest_arguments]
        environment = {**os.environ, "BLENDER_USER_RESOURCES": str(profile), "PYTHONUNBUFFERED": "1"}
        return judge(report, subprocess.run(command, cwd=ROOT, env=environment).returncode)


if __name__ == "__main__":
    sys.exit(main())
