"""Jobs in tiles: the same result whoever builds what, stopping and going on, failures, levels of detail."""

import errno
import gc
import json
import os
import signal
import sys
from pathlib import Path

import numpy as np
import pytest
from shapes import rectangle

from geoanalogy import InputError, OperationsTree, Polygon, Pose, Scene
from geoanalogy.batch import computing, processes
from geoanalogy.batch.detail import depths, simplified
from geoanalogy.batch.generation import Choices, Stopped, generate, merged, remaining
from geoanalogy.batch.manifest import SCHEMA, manifest
from geoanalogy.batch.product import Product, together
from geoanalogy.batch.release import digest, version
from geoanalogy.batch.store import Store
from geoanalogy.batch.tiles import divide, read_scene_text, scene_text, units_of, wanted_labels
from geoanalogy.geometry.extrusion import FaceLabels
from geoanalogy.geometry.solid import Solid
from geoanalogy.operations.boolean import Boolean
from geoanalogy.operations.extrusion import Extrusion
from geoanalogy.operations.group_placement import GroupPlacement
from geoanalogy.operations.node import Link, Node
from geoanalogy.operations.selection import Selection
from geoanalogy.poses.group_transfer import GroupObject, GroupTransfer
from geoanalogy.poses.local_mapping import TransferOptions


def tree():
    """Plots are extruded by chance; half of the tops get another block, whose top another."""
    top = Extrusion(label="top", height=1.0, factor=(0.5, 2.0), faces=FaceLabels(top="upper top"))
    return OperationsTree(
        [
            Node("up", Extrusion(label="plot", height=4.0, factor=(0.5, 1.5))),
            Node("some", Selection(label="top", weights=(1.0, 1.0)), (Link("up"),)),
            Node("block", top, (Link("some"),)),
            Node("all", Boolean(label="top", kind="merge"), (Link("block"), Link("some", 1))),
        ]
    )


def plots(count=12, label="plot"):
    return Scene(
        [Polygon(rectangle(8, 12, (10.0 * (k % 4), 20.0 * (k // 4))), label, f"p{k:02d}") for k in range(count)]
    )


def contents(job):
    """What has been built, whatever tile it was in."""
    whole = together(product for _, product in job.products())
    every = {name: whole.masses.single(k) for k, name in enumerate(whole.masses.names)}
    return {
        n: (m.vertices.tobytes(), m.faces.tobytes(), m.uv.tobytes(), [m.materials[k] for k in m.material_index])
        for n, m in sorted(every.items())
    }


def built(scene, folder, choices, progress=None):
    return generate(tree(), scene, folder, choices, progress)


def test_tiles_order_and_processes_change_nothing(tmp_path):
    scene = plots()
    whole = contents(built(scene, tmp_path / "a", Choices(seed=3, per_tile=100)))
    assert len(whole) == 12
    assert contents(built(scene, tmp_path / "b", Choices(seed=3, per_tile=1))) == whole
    shuffled = Scene(scene.polygons[::-1])
    assert contents(built(shuffled, tmp_path / "c", Choices(seed=3, per_tile=5))) == whole
    assert contents(built(scene, tmp_path / "d", Choices(seed=3, per_tile=2, jobs=2))) == whole
    assert contents(built(scene, tmp_path / "e", Choices(seed=4))) != whole
    applied = {e.id: e.mesh.vertices.tobytes() for e in tree().apply(scene, 3) if not isinstance(e.mesh, str)}
    assert applied == {name: parts[0] for name, parts in whole.items()}


def test_a_stopped_job_goes_on_where_it_was(tmp_path):
    scene, choices = plots(), Choices(seed=3, per_tile=3)
    with pytest.raises(Stopped, match=r"stopped; 2 of 4 tiles are finished and kept in .*goes on from there"):
        built(scene, tmp_path / "s", choices, lambda share, _: share < 0.5)
    begun = {path: path.stat().st_mtime_ns for path in (tmp_path / "s").glob("*.npz")}
    said = []
    job = built(scene, tmp_path / "s", choices, lambda _, text: said.append(text) or True)
    assert job.reused == 2 and "2 tiles were finished before" in said[0]
    assert {path: path.stat().st_mtime_ns for path in begun} == begun
    assert contents(job) == contents(built(scene, tmp_path / "whole", choices))
    assert built(scene, tmp_path / "s", choices).reused == 4
    assert built(scene, tmp_path / "s", Choices(seed=4, per_tile=3)).reused == 0


def test_processes_stop_too(tmp_path):
    with pytest.raises(Stopped):
        built(plots(), tmp_path, Choices(per_tile=1, jobs=2), lambda share, _: share == 0.0)
    assert not list(tmp_path.glob("*.json"))


def test_a_damaged_tile_is_built_again(tmp_path):
    job = built(plots(), tmp_path, Choices(per_tile=6))
    before = contents(job)
    damaged = job.store.path(job.keys[0])
    damaged.write_bytes(damaged.read_bytes()[:500])
    again = built(plots(), tmp_path, Choices(per_tile=6))
    assert again.reused == 1 and contents(again) == before
    damaged.unlink()
    with pytest.raises(InputError, match="tile 001 is no longer in"):
        contents(again)


def test_a_full_disk_leaves_what_was_there(tmp_path, monkeypatch):
    store = Store(tmp_path)
    store.keep("a", b"earlier")

    def full(path, content):
        path.touch()
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match="No space left on device"):
        store.keep("a", b"later")
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [("a.npz", b"earlier")]
    with pytest.raises(OSError, match="No space left on device"):
        built(plots(), tmp_path, Choices())


def test_nothing_of_a_tile_is_kept_when_it_is_done(tmp_path):
    computing._worker.cache_clear()
    counted = {}

    def count(share, _):
        if share not in counted:
            gc.collect()
            counted[share] = sum(isinstance(thing, Solid) for thing in gc.get_objects())
        return True

    built(plots(6), tmp_path, Choices(per_tile=1), count)
    after = list(counted.values())[1:]
    assert len(after) == 6 and len(set(after)) == 1


def test_single_tiles_are_built_apart(tmp_path):
    one = built(plots(), tmp_path, Choices(per_tile=3, only=(2,)))
    assert not one.finished and len(one.facts) == 1
    rest = built(plots(), tmp_path, Choices(per_tile=3))
    assert rest.reused == 1 and rest.finished
    with pytest.raises(InputError, match="there is no tile 9; give numbers from 1 to 4"):
        built(plots(), tmp_path, Choices(per_tile=3, only=(9,)))
    rest.store.forget()
    assert not tmp_path.exists()


def test_a_parcel_that_fails_is_named_and_the_others_are_built(tmp_path, monkeypatch):
    build = computing._Worker.build

    def failing(self, ground, units, progress):
        if any(unit.parcel == "p05" for unit in units):
            raise ZeroDivisionError("by chance")
        return build(self, ground, units, progress)

    monkeypatch.setattr(computing._Worker, "build", failing)
    job = built(plots(), tmp_path, Choices(per_tile=6))
    problems = [p for key in job.keys for p in job.facts[key]["problems"]]
    assert problems == ["parcel 'p05' stays empty: internal error (ZeroDivisionError: by chance)"]
    assert {name.split("/")[1].split("@")[0] for name in contents(job)} == {f"p{k:02d}" for k in range(12)} - {"p05"}


@pytest.mark.parametrize("jobs", [1, 2])
def test_without_a_library_nothing_is_kept(tmp_path, monkeypatch, jobs):
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    with pytest.raises(ModuleNotFoundError, match="manifold3d"):
        built(plots(), tmp_path, Choices(jobs=jobs, per_tile=6))
    assert not list(tmp_path.iterdir())


def test_a_library_that_is_missing_is_no_fault_of_a_parcel(monkeypatch):
    def failing(self, ground, units, progress):
        raise ModuleNotFoundError("No module named 'manifold3d'", name="manifold3d")

    monkeypatch.setattr(computing._Worker, "build", failing)
    scene = plots(2)
    units = units_of(scene, wanted_labels(tree()))
    with pytest.raises(ModuleNotFoundError, match="manifold3d"):
        computing.compute(computing.job_text(tree(), 7, "full"), scene_text(scene, units))


def test_a_process_that_is_killed_is_replaced(tmp_path):
    killed = []
    started = processes._started

    def weak():
        process = started()
        if not killed:
            killed.append(process.pid)
            os.kill(process.pid, getattr(signal, "SIGKILL", signal.SIGTERM))
            process.wait()
        return process

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(processes, "_started", weak)
        job = built(plots(), tmp_path / "k", Choices(seed=3, per_tile=3, jobs=2))
    assert killed and not job.failed
    assert contents(job) == contents(built(plots(), tmp_path / "o", Choices(seed=3, per_tile=3)))


def test_where_no_process_starts_one_sentence_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(processes, "PROGRAM", "raise SystemExit(1)  # {paths} {package}")
    with pytest.raises(InputError, match="no tile could be built: its process ended without a result"):
        built(plots(), tmp_path, Choices(per_tile=6, jobs=2))


def test_what_nothing_is_built_on_is_said(tmp_path):
    with pytest.raises(
        InputError, match=r"no parcel of this file: their labels are 'lot', and it begins with 'plot'; "
    ):
        built(plots(label="lot"), tmp_path, Choices())


def test_units_hold_what_they_depend_on():
    block = Polygon(rectangle(100, 100, (0, 0)), "block", "block")
    one = Polygon(rectangle(10, 10, (0, 0)), "plot", "one", parent="block")
    other = Polygon(rectangle(10, 10, (20, 0)), "plot", "other", parent="block")
    pond = Polygon(rectangle(2, 2, (3, 3)), "pond", "pond")
    scene = Scene([block, one, other, pond])
    units = units_of(scene, wanted_labels(tree()))
    assert [(u.parcel, u.members) for u in units] == [("one", ("block", "one", "pond")), ("other", ("block", "other"))]
    assert [u.parcel for u in units_of(scene, None)] == ["block"]
    again, read = read_scene_text(scene_text(scene, units[:1]))
    assert read == units[:1] and [p.id for p in again.polygons] == ["block", "one", "pond"]
    assert again.parent("pond").id == "one" and again.parent("one").id == "block"


def test_parcels_that_share_something_built_on_are_built_together():
    left = Polygon(rectangle(10, 10, (0, 0)), "plot", "left")
    right = Polygon(rectangle(10, 10, (10, 0)), "plot", "right")
    across = Polygon(rectangle(4, 4, (8, 3)), "plot", "across")
    units = units_of(Scene([left, right, across]), frozenset({"plot"}))
    assert len(units) == 1 and set(units[0].members) == {"left", "right", "across"}


def test_tiles_are_neighbours_and_do_not_depend_on_the_order():
    scene = plots(16)
    units = units_of(scene, frozenset({"plot"}))
    tiles = divide(scene, units, 4)
    assert [len(t.units) for t in tiles] == [4] * 4 and sorted(p for t in tiles for p in t.parcels) == sorted(
        str(p.id) for p in scene.polygons
    )
    assert divide(scene, units[::-1], 4) == tiles
    assert divide(scene, [], 4) == []


def test_levels_of_detail_leave_out_what_is_finer(tmp_path):
    assert depths(tree()) == {"up": 0, "some": 0, "block": 1, "all": 1}
    assert [n.muted for n in simplified(tree(), "mass").nodes] == [n.id in ("block", "all") for n in tree().nodes]
    assert simplified(tree(), "facade").nodes == tree().nodes
    full = contents(built(plots(), tmp_path / "f", Choices(seed=3)))
    mass = contents(built(plots(), tmp_path / "m", Choices(seed=3, detail="mass")))
    assert mass.keys() == full.keys() and mass != full
    # The heights that chance has given do not change; half of the plots have nothing on them.
    assert 0 < sum(mass[name] == full[name] for name in mass) < len(mass)


def test_a_product_is_read_as_it_was_written(tmp_path):
    job = built(plots(), tmp_path, Choices())
    ((_, product),) = job.products()
    assert Product.from_bytes(product.to_bytes()).content() == product.content()
    assert set(product.masses.parcels) == {f"p{k:02d}" for k in range(12)}
    with pytest.raises(InputError, match="the finished tile is damaged"):
        Product.from_bytes(b"PK nothing")


def test_products_say_how_objects_are_bent(tmp_path):
    long = Polygon(rectangle(20, 2, (-40, -1)), "lawn", "long")
    lawns = [long, *(Polygon(rectangle(9, 9, (20.0 * k, 0.0)), "lawn", f"square {k}") for k in range(3))]
    hedge = GroupObject(Pose((-30.0, -0.5), 0.0), np.array(rectangle(8, 0.4, (-4, -0.2)), float))
    bench = GroupObject(Pose((-30.0, 0.5), 0.0), np.array(rectangle(2, 0.4, (-1, -0.2)), float))
    kinds = ("hedge", "bench")
    for shape in ("rigid", "outline"):
        group = GroupTransfer(long, [hedge, bench], TransferOptions(distance="absolute", shape=shape))
        take = OperationsTree([Node("take", GroupPlacement(meshes=kinds, labels=kinds, group=group, everything=True))])
        job = generate(take, Scene(lawns), tmp_path, Choices(per_tile=2))
        products = [product for _, product in job.products()]
        assert len(products) == 2
        for product in (*products, together(products)):
            placed = product.placed
            assert len(placed) == 2 * len(product.facts["parcels"])
            for k, mesh in enumerate(placed.meshes):
                assert (placed.bend[k] >= 0) == (shape == "outline" and "long" not in placed.keys[k] and mesh in kinds)
        if shape == "rigid":
            assert not together(products).placed.bends
            continue
        placed = together(products).placed
        assert Product.from_bytes(together(products).to_bytes()).content() == together(products).content()
        for k, mesh in enumerate(placed.meshes):
            if placed.bend[k] < 0:
                continue
            rows = placed.bends[placed.bend[k]]
            assert rows[:, :2] == pytest.approx(group.outlines[kinds.index(mesh)], abs=1e-9)
            assert placed.low[k, :2] == pytest.approx(rows[:, 2:].min(axis=0), abs=1e-9)


def test_the_manifest_says_what_was_made(tmp_path):
    job = built(plots(), tmp_path, Choices(per_tile=6))
    tiles = [(tile, key, job.facts[key]) for tile, key in zip(job.tiles, job.keys, strict=True)]
    plain = json.loads(json.dumps(manifest([], {}, {"seed": 0}, tiles, ["a sliver"])))
    assert plain["schema"] == SCHEMA and plain["version"] == version() and plain["engine"] == digest()
    assert plain["counts"]["parcels"] == 12 and [len(t["parcels"]) for t in plain["tiles"]] == [6, 6]
    assert plain["problems"] == ["a sliver"] and plain["seconds"]["all"] >= plain["seconds"]["extrusion"] > 0


def test_several_trees_are_one():
    one = OperationsTree([Node("up", Extrusion(label="house", height=2.0))])
    other = OperationsTree([Node("up", Extrusion(label="tower", height=9.0))])
    whole = merged([("low", one), ("high", other)])
    assert [n.id for n in whole.nodes] == ["high up", "low up"]
    assert merged([("low", one)]) is one
    scene = Scene([Polygon(rectangle(5, 5), "house", "h"), Polygon(rectangle(5, 5, (9, 0)), "tower", "t")])
    assert sorted(e.solid.volume for e in whole.apply(scene)) == pytest.approx([50, 225])


@pytest.mark.parametrize(("seconds", "said"), [(3, "10 s"), (44, "40 s"), (150, "2 min"), (7500, "2 h 5 min")])
def test_the_remaining_time_is_said_roughly(seconds, said):
    assert remaining(seconds) == said
