"""The batch program as a process: a real Ctrl-C, and a real limit on what can be written."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from shapes import rectangle

from geoanalogy import OperationsTree, Polygon, Scene, write_scene
from geoanalogy.command_line import ExitCode
from geoanalogy.operations.extrusion import Extrusion
from geoanalogy.operations.node import Node

ROOT = Path(__file__).resolve().parents[2]

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals and limits are those of POSIX")

#: Runs the program with a limit on the size of the files that it writes, in bytes: then a disk is full.
LIMITED = (
    "import resource, sys; sys.path.insert(0, {root!r}); resource.setrlimit(resource.RLIMIT_FSIZE, ({size}, {size})); "
    "from geoanalogy.command_line import main; sys.exit(main(sys.argv[1:]))"
)


@pytest.fixture
def files(tmp_path):
    """A folder with a tree and 80 plots, a tile each."""
    OperationsTree([Node("up", Extrusion(label="plot", height=4.0, factor=(0.5, 1.5)))]).save(tmp_path / "tree.json")
    plots = [Polygon(rectangle(8, 12, (10.0 * k, 0.0)), "plot", f"p{k:03d}") for k in range(80)]
    write_scene(Scene(plots), tmp_path / "parcels.geojson")
    return tmp_path


def arguments(folder, *more):
    parcels = ("--parcels", str(folder / "parcels.geojson"), "--per-tile", "1", "--seed", "7")
    output = ("--output", str(folder / "out.obj"), "--work", str(folder / "tiles"))
    return ["apply", "--tree", str(folder / "tree.json"), *parcels, *output, *more]


def run(folder, *more):
    command = [sys.executable, str(ROOT / "batch.py"), *arguments(folder, *more)]
    return subprocess.run(command, capture_output=True, text=True, timeout=300)


def last_line(text):
    return text.strip().splitlines()[-1]


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_ctrl_c_stops_with_a_sentence_and_the_same_command_goes_on(files, jobs):
    earlier = files / "out.obj"
    earlier.write_text("earlier")
    command = [sys.executable, str(ROOT / "batch.py"), *arguments(files, "--jobs", jobs)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True) as process:
        for line in process.stderr:
            if " 0 of " not in line:  # a tile is finished
                break
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does: the processes that build get it too
        said = last_line(process.stderr.read())
        assert process.wait(timeout=60) == ExitCode.CANCELLED
    assert said.startswith("geoanalogy: stopped; ") and said.endswith("the same command goes on from there")
    assert earlier.read_text() == "earlier" and not list(files.glob("*.part*"))
    kept = {path: path.stat().st_mtime_ns for path in (files / "tiles").glob("*.npz")}
    assert f"; {len(kept)} of 80 tiles are finished and kept in {files / 'tiles'}" in said and 0 < len(kept) < 80

    gone_on = run(files, "--jobs", jobs)
    assert gone_on.returncode == ExitCode.DONE, gone_on.stderr
    assert f"{len(kept)} tiles were finished before" in gone_on.stderr
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    resumed = earlier.read_bytes()
    assert run(files, "--work", str(files / "others")).returncode == ExitCode.DONE
    assert earlier.read_bytes() == resumed


#: Sizes of files in bytes between what is still written and what no longer is: a tile has 5 kB, the manifest 50.
@pytest.mark.parametrize(
    ("size", "jobs", "unwritten"),
    [(1000, "1", ".npz"), (1000, "2", ".npz"), (20_000, "1", "out.obj"), (50_000, "1", "out.manifest.json")],
)
def test_a_full_disk_is_said_and_leaves_the_earlier_output(files, size, jobs, unwritten):
    if unwritten == "out.manifest.json":  # which says of each parcel what is wrong with it
        plain = json.loads((files / "parcels.geojson").read_text())
        for feature in plain["features"][1:]:
            feature["properties"] = {"id": feature["properties"]["id"] * 1000}
        (files / "parcels.geojson").write_text(json.dumps(plain))
    results = {name: files / name for name in ("out.obj", "out.manifest.json")}
    for path in results.values():
        path.write_text("earlier")
    program = LIMITED.format(root=str(ROOT), size=size)
    command = [sys.executable, "-c", program, "--quiet", *arguments(files, "--jobs", jobs)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == ExitCode.WRITE_FAILED, done.stdout + done.stderr
    said = last_line(done.stderr)
    assert said.startswith("geoanalogy: cannot write ") and said.endswith(f"{unwritten}: File too large"), done.stderr
    assert [path.read_text() for path in results.values()] == ["earlier", "earlier"]
    assert not list(files.glob("**/*.part*"))
    again = run(files)
    assert again.returncode == ExitCode.DONE, again.stderr
    assert results["out.obj"].read_text() != "earlier" != results["out.manifest.json"].read_text()
