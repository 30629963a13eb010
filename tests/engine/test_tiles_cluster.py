"""Tiles on a Dask cluster of several processes, one of which is killed: the same result, nothing twice."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from shapes import rectangle

from geoanalogy import InputError, OperationsTree, Polygon, Scene
from geoanalogy.batch import cluster as dask_cluster
from geoanalogy.batch import remote
from geoanalogy.batch.generation import Choices, generate
from geoanalogy.batch.processes import Work
from geoanalogy.batch.product import together
from geoanalogy.operations.extrusion import Extrusion
from geoanalogy.operations.node import Node

ROOT = Path(__file__).resolve().parents[2]
TREE = OperationsTree([Node("up", Extrusion(label="plot", height=4.0, factor=(0.5, 1.5)))])
SCENE = Scene([Polygon(rectangle(8, 12, (10.0 * k, 0)), "plot", f"p{k:02d}") for k in range(24)])


def contents(job):
    whole = together(product for _, product in job.products())
    names = whole.masses.names
    assert len(names) == len(set(names)) == len(SCENE)
    return {name: whole.masses.single(k).vertices.tobytes() for k, name in enumerate(names)}


def started(module, *arguments):
    """One program of Dask, as a process with the engine on its path."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "DASK_DISTRIBUTED__WORKER__DAEMON": "False"}
    command = [sys.executable, "-W", "ignore", "-m", f"distributed.cli.{module}", *arguments]
    return subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


@pytest.fixture
def cluster(tmp_path):
    """The address of a scheduler, and its four workers."""
    distributed = pytest.importorskip(
        "distributed", reason="building on a cluster needs Dask (pip install distributed)"
    )
    crew = []
    file = tmp_path / "scheduler.json"
    try:
        crew.append(started("dask_scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", str(file)))
        crew += [
            started(
                "dask_worker",
                *("--scheduler-file", str(file), "--no-nanny", "--nthreads", "1", "--no-dashboard"),
                *("--local-directory", str(tmp_path)),
            )
            for _ in range(4)
        ]
        until = time.monotonic() + 60
        while not file.is_file() and time.monotonic() < until:
            time.sleep(0.2)
        address = json.loads(file.read_text())["address"]
        with distributed.Client(address, set_as_default=False) as client:
            client.wait_for_workers(4, timeout=120)
        yield address, crew[1:]
    finally:
        for process in crew:
            process.kill()
        for process in crew:
            process.wait()


@pytest.mark.filterwarnings("ignore")
def test_a_cluster_that_loses_a_worker_builds_the_same(cluster, tmp_path):
    address, workers = cluster
    expected = contents(generate(TREE, SCENE, tmp_path / "here", Choices(seed=5, per_tile=2)))
    lost = []

    def lose_one(share, _):
        if share > 0.2 and not lost:
            lost.append(workers[0].pid)
            os.kill(workers[0].pid, getattr(signal, "SIGKILL", signal.SIGTERM))
        return True

    job = generate(TREE, SCENE, tmp_path / "there", Choices(seed=5, per_tile=2, scheduler=address), lose_one)
    assert lost and not job.failed
    assert contents(job) == expected
    assert sorted(p for facts in job.facts.values() for p in facts["parcels"]) == sorted(
        str(p.id) for p in SCENE.polygons
    )


class Lost:
    """What a client says of a tile whose worker is killed after its first and before its second look at it."""

    def __init__(self):
        self.looks = 0

    def done(self):
        self.looks += 1
        return self.looks != 2

    @property
    def status(self):
        return "lost" if self.looks < 3 else "finished"


class Client:
    def __init__(self, future):
        self.future = future

    def submit(self, function, *_, **__):
        return self.future if function is remote.build else object()

    def gather(self, futures, errors):
        assert [f.status for f in futures] == ["finished"] and errors == "skip"
        return [("", b"product")]

    def cancel(self, futures):
        assert self.future in futures


def test_a_result_that_is_lost_with_its_worker_is_waited_for():
    answers = [a for a in dask_cluster._futures(Client(Lost()), "job", [Work("key", "scene")], remote) if a is not None]
    assert answers == [("key", "", b"product")]


@pytest.mark.filterwarnings("ignore")
def test_a_scheduler_that_is_not_there_is_named(tmp_path, monkeypatch):
    pytest.importorskip("distributed", reason="building on a cluster needs Dask (pip install distributed)")
    monkeypatch.setattr("geoanalogy.batch.cluster.REACHED", 1)
    with pytest.raises(InputError, match=r"no Dask scheduler answers at tcp://127.0.0.1:9 "):
        generate(TREE, SCENE, tmp_path, Choices(scheduler="tcp://127.0.0.1:9"))


def test_without_dask_one_sentence_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(
        InputError, match=r"distributed.*which --scheduler needs: install it \(pip install distributed\)"
    ):
        generate(TREE, SCENE, tmp_path, Choices(scheduler="tcp://127.0.0.1:9"))


def test_a_worker_without_the_library_or_with_another_says_so(monkeypatch):
    said, product = remote.build("", "", "another")
    assert "has another GeoAnalogy" in said and "install the same version everywhere" in said and product == b""
    monkeypatch.setitem(sys.modules, "geoanalogy.batch.computing", None)
    said, _ = remote.build("", "", "")
    assert "lacks the module" in said and "install geoanalogy there" in said
