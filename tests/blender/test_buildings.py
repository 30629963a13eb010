"""What an operations tree has built, as a .blend: by the batch program, and by its writer."""

import json
import sys

import bpy
import numpy as np
import pytest
from conftest import INSIDE_BLENDER, ROOT, batch_command, run
from flats import box, bridge, engine, face

HEIGHT = 3.0


def plots(count=3):
    """Plots in a row and a pond, as the engine's scene."""
    polygon = engine().Polygon
    rings = [[(x, 0), (x + 10, 0), (x + 10, 20), (x, 20)] for x in np.arange(count) * 15.0]
    pond = polygon([(0, 30), (4, 30), (4, 34), (0, 34)], label="pond", id="pond")
    return engine().Scene([*(polygon(r, label="plot", id=f"plot {i}") for i, r in enumerate(rings)), pond])


def tree():
    """Plots are extruded; a statue stands in the pond."""
    node, links = engine("operations.node").Node, engine("operations.node").Link
    extrusion = engine("operations.extrusion").Extrusion(label="plot", height=HEIGHT, factor=(0.5, 1.5))
    outline = [(-1, -0.5), (1, -0.5), (1, 0.5), (-1, 0.5)]
    model = engine().learn_pose(plots(), engine().Pose((2, 32), 0.0), outline, engine().PoseOptions(scale="fixed"))
    statue = engine("operations.pose_placement").PosePlacement(
        mesh="statue", label="figure", model=model, max_per={"pond": 1}
    )
    return engine().OperationsTree([node("up", extrusion), node("stand", statue, (links("up"),))])


@pytest.fixture
def files(tmp_path, request):
    """A folder with a tree, plots, and a library."""
    if INSIDE_BLENDER:
        # Its Python may lack what the extension brings.
        (tmp_path / "profile").symlink_to(request.getfixturevalue("profile") / "profile")
    tree().save(tmp_path / "tree.json")
    engine().write_scene(plots(), tmp_path / "plots.geojson")
    box("statue", (2.0, 1.0, 4.0))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"), copy=True)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    return tmp_path


def built_on(ground, recorded):
    """What a tree builds on parcels, as a product."""
    applied = recorded.apply(ground, seed=7)
    facts = {"parcels": [], "elements": len(applied), "problems": [], "known": 0, "surfaces": 0, "seconds": {}}
    outlines = engine("batch.placed").outlines_of(recorded)
    return engine("batch.product").product_of(applied, {}, facts, outlines)


def fill(ground, *products, library=None):
    return bridge("writing.buildings").fill(bpy.context.scene, ground, products, library)


def apply(folder, *options):
    names = ["--tree", str(folder / "tree.json"), "--parcels", str(folder / "plots.geojson"), "--seed", "7"]
    return run(batch_command("apply", *names, *options), folder)


def scene_of(path):
    """What a file holds: places and data of its objects, and the vertices of its meshes."""
    bpy.ops.wm.open_mainfile(filepath=str(path))
    objects = {o.name: (np.round(o.matrix_world, 5).tolist(), o.data.name) for o in bpy.context.scene.objects}
    meshes = {m.name: [tuple(v.co) for v in m.vertices] for m in bpy.data.meshes}
    return objects, meshes


def shown():
    """What is instanced in the open file: names of objects, and their places."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return [(i.object.name, np.array(i.matrix_world)) for i in depsgraph.object_instances if i.is_instance]


def test_a_blend_is_written_with_masses_instances_and_a_picture(files):
    picture, output, library = (str(files / name) for name in ("out.png", "out.blend", "library.blend"))
    done = apply(files, "--output", output, "--render", picture, "--library", library)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "4 elements on 4 parcels" in done.stdout and "missing" not in done.stdout
    assert (files / "out.png").read_bytes()[:4] == b"\x89PNG"
    bpy.ops.wm.open_mainfile(filepath=output)
    scene = bpy.context.scene
    assert [c.name for c in scene.collection.children] == ["plot", "Library", "figure", "Surroundings"]
    (mass,), (figure,) = (list(bpy.data.collections[name].objects) for name in ("plot", "figure"))
    assert len(mass.data.vertices) == 3 * 8 and len(mass.data.polygons) == 3 * 12
    assert {m.name for m in mass.data.materials} == {"facade", "top", "base"}
    assert not any(p.use_smooth for p in mass.data.polygons)
    assert mass.data.validate() is False and len(mass.data.uv_layers) == 1
    assert figure["ga_label"] == "figure"
    ((name, place),) = shown()
    assert name == "statue" and place[:2, 3] == pytest.approx((2, 32), abs=1e-4)
    assert place[:3, :3] == pytest.approx(np.eye(3), abs=1e-4)
    assert list(scene["ga_offset"]) == [0.0, 0.0] and json.loads(scene["ga_manifest"])["seed"] == 7
    record = json.loads((files / "out.manifest.json").read_text())
    assert record["schema"] == "geoanalogy.manifest/1" and record["counts"]["elements"] == 4
    assert sorted(p.name for p in files.iterdir() if p.suffix in (".part", ".tiles")) == []
    assert scene.camera.name == "From the front"
    again = files / "again.blend"
    assert apply(files, "--output", str(again), "--library", library).returncode == 0
    assert scene_of(again) == scene_of(output)


def test_a_box_takes_the_place_of_what_the_library_does_not_have(files):
    bpy.ops.wm.save_as_mainfile(filepath=str(files / "bare.blend"), copy=True)
    done = apply(files, "--output", str(files / "out.blend"), "--library", str(files / "bare.blend"))
    assert done.returncode == 0, done.stdout + done.stderr
    assert "node 'stand': the library object 'statue' is missing" in done.stdout
    bpy.ops.wm.open_mainfile(filepath=str(files / "out.blend"))
    ((_, place),) = shown()
    assert np.linalg.norm(place[:3, :3], axis=0) == pytest.approx((2, 1, 1), abs=1e-4)
    assert place[:3, 3] == pytest.approx((1, 31.5, 0), abs=1e-4) and len(bpy.data.collections["plot"].objects) == 1


@pytest.mark.parametrize(
    ("options", "code", "message"),
    [
        ([], 2, "apply needs --output, --render or both"),
        (["--output", "out.stl"], 2, "out.stl should end in .blend or .obj"),
        (["--output", "nowhere/out.blend"], 5, "its folder does not exist"),
        (["--output", "out.blend", "--library", "no.blend"], 3, "no.blend is not there; check the path"),
        (["--output", "out.blend", "--library", "garbage.blend"], 3, "garbage.blend cannot be opened"),
    ],
)
def test_what_cannot_be_done_is_said(files, options, code, message):
    (files / "garbage.blend").write_bytes(b"garbage" * 100)
    done = apply(files, *options)
    assert done.returncode == code, done.stdout + done.stderr
    assert message in done.stderr
    assert not (files / "out.blend").exists()


def test_without_blender_one_sentence_says_what_to_do(files):
    (files / "bpy.py").write_text("raise ModuleNotFoundError(\"No module named 'bpy'\", name='bpy')")
    script = f"import sys; sys.path[:0] = [{str(files)!r}, {str(ROOT)!r}]; from geoanalogy.command_line import main; "
    names = ["--tree", str(files / "tree.json"), "--parcels", str(files / "plots.geojson")]
    code = script + f"sys.exit(main({['apply', *names, '--output', str(files / 'out.blend')]!r}))"
    done = run([sys.executable, "-c", code], files)
    assert done.returncode == 3 and done.stderr.startswith("geoanalogy: the module bpy is missing: install"), (
        done.stderr
    )


def test_tiles_are_files_of_their_own_that_the_output_links(files):
    output = files / "out.blend"
    done = apply(files, "--output", str(output), "--tiles", str(files / "parts"), "--per-tile", "2", "--jobs", "2")
    assert done.returncode == 0, done.stdout + done.stderr
    assert sorted(p.name for p in (files / "parts").iterdir()) == ["tile 001.blend", "tile 002.blend"]
    bpy.ops.wm.open_mainfile(filepath=str(output))
    assert sorted(library.filepath for library in bpy.data.libraries) == [
        "//parts/tile 001.blend",
        "//parts/tile 002.blend",
    ]
    masses = [o for o in bpy.context.scene.objects if o.get("ga_label") == "plot"]
    assert sum(len(mass.data.vertices) for mass in masses) == 3 * 8 and len(shown()) == 1


def test_a_single_tile_writes_nothing_until_all_are_there(files):
    work = ["--work", str(files / "work"), "--per-tile", "2"]
    one = apply(files, *work, "--only", "1")
    assert one.returncode == 0 and "1 of 2 tiles are finished" in one.stdout
    whole = apply(files, *work, "--output", str(files / "out.blend"))
    assert whole.returncode == 0 and "1 tiles were finished before" in whole.stderr
    assert (files / "out.blend").is_file() and len(list((files / "work").glob("*.npz"))) == 2


def test_the_open_file_may_have_the_parcels(files):
    face("ground", [(0, 0), (10, 0), (10, 20), (0, 20)], "plot")
    path = files / "parcels.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    arguments = ["apply", "--tree", str(files / "tree.json"), "--output", str(files / "out.obj")]
    if INSIDE_BLENDER:
        command = batch_command(*arguments, file=path)
    else:
        program = (
            f"import sys, bpy; bpy.ops.wm.open_mainfile(filepath={str(path)!r}); sys.path.insert(0, {str(ROOT)!r}); "
            f"from geoanalogy.command_line import main; sys.exit(main({arguments!r}))"
        )
        command = [sys.executable, "-c", program]
    done = run(command, files)
    assert "1 elements on 1 parcels" in done.stdout, done.stdout + done.stderr


def test_an_earlier_output_stays_where_writing_fails(files, monkeypatch):
    buildings = bridge("writing.buildings")
    output, picture = files / "out.blend", files / "out.png"
    output.write_bytes(b"earlier")
    picture.write_bytes(b"earlier")

    def full(scene, path):
        path.write_bytes(b"half of it")
        raise OSError("no space left on device")

    monkeypatch.setattr(buildings, "draw_picture", full)
    ground = plots()
    with pytest.raises(OSError, match="no space left on device"):
        buildings.write(ground, [("tile 001", built_on(ground, tree()))], buildings.Results(output, picture))
    assert output.read_bytes() == picture.read_bytes() == b"earlier"
    assert not list(files.glob("*.part*"))


@pytest.mark.skipif(INSIDE_BLENDER or sys.platform == "win32", reason="the limit is set by Python on POSIX")
def test_a_file_that_is_cut_off_is_no_result(files):
    names = ["--tree", str(files / "tree.json"), "--parcels", str(files / "plots.geojson")]
    arguments = ["apply", *names, "--output", str(files / "out.blend")]
    for name in ("out.blend", "out.manifest.json"):
        (files / name).write_bytes(b"earlier")
    program = (
        f"import resource, sys; sys.path.insert(0, {str(ROOT)!r}); "
        "resource.setrlimit(resource.RLIMIT_FSIZE, (65536, 65536)); "
        f"from geoanalogy.command_line import leave, main; leave(main({arguments!r}))"
    )
    done = run([sys.executable, "-c", program], files)
    assert done.returncode == 5, done.stdout + done.stderr
    assert "geoanalogy: cannot write" in done.stderr and "Traceback" not in done.stderr
    assert (files / "out.blend").read_bytes() == (files / "out.manifest.json").read_bytes() == b"earlier"
    assert not list(files.glob("*.part*"))


def test_a_tree_of_the_map_is_an_instance(files):
    polygon = engine().Polygon
    ground = engine().Scene([polygon([(0, 0), (4, 0), (4, 4), (0, 4)], label="statue", id="t")])
    built = fill(ground, library=files / "library.blend")
    bpy.context.view_layer.update()
    ((name, place),) = shown()
    assert built.problems == () and name == "statue" and "Parcels" not in bpy.context.scene.objects
    assert place[:3, 3] == pytest.approx((2, 2, 0)) and np.linalg.norm(place[:3, 0]) == pytest.approx(2)


def bent_hedge(pieces=32):
    """A long lawn with a hedge along its edge and a round one of radius 2 about (20, 0), and a tree that bends it."""
    polygon, transfer = engine().Polygon, engine("poses.group_transfer")
    turn = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    long = polygon([(-40, -1), (-20, -1), (-20, 1), (-40, 1)], label="lawn", id="long")
    lawns = [long, polygon(np.column_stack([20 + 2 * np.cos(turn), 2 * np.sin(turn)]), label="lawn", id="round")]
    outline = np.array([(-4, -0.2), (4, -0.2), (4, 0.2), (-4, 0.2)])
    standing = transfer.GroupObject(engine().Pose((-30, -0.5), 0.0), outline)
    options = engine("poses.local_mapping").TransferOptions(distance="absolute", shape="outline")
    group = transfer.GroupTransfer(long, [standing], options)
    operation = engine("operations.group_placement").GroupPlacement(meshes=("hedge",), labels=("hedge",), group=group)
    x = np.linspace(-4, 4, pieces + 1)
    points = [(u, v, h) for u in x for v, h in ((-0.2, 0), (0.2, 0), (0.2, 0.8), (-0.2, 0.8))]
    sides = [
        [4 * i + k, 4 * i + (k + 1) % 4, 4 * i + 4 + (k + 1) % 4, 4 * i + 4 + k]
        for i in range(pieces)
        for k in range(4)
    ]
    mesh = bpy.data.meshes.new("hedge")
    mesh.from_pydata(points, [], sides)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("hedge", mesh))
    return engine().Scene(lawns), engine().OperationsTree([engine("operations.node").Node("take", operation)])


def test_objects_of_a_group_are_bent(files):
    ground, recorded = bent_hedge()
    recorded.save(files / "tree.json")
    engine().write_scene(ground, files / "plots.geojson")
    bpy.ops.wm.save_as_mainfile(filepath=str(files / "hedges.blend"), copy=True)
    done = apply(files, "--output", str(files / "out.blend"), "--library", str(files / "hedges.blend"))
    assert done.returncode == 0, done.stdout + done.stderr
    bpy.ops.wm.open_mainfile(filepath=str(files / "out.blend"))
    depsgraph = bpy.context.evaluated_depsgraph_get()
    there = [(i.object.data, i.matrix_world.copy()) for i in depsgraph.object_instances if i.is_instance]
    assert len(there) == 2
    points = (np.array([place @ v.co for v in data.vertices]) for data, place in there)
    straight, bent = sorted(points, key=lambda one: one[:, 0].min())
    rest = np.array([v.co for v in bpy.data.meshes["hedge"].vertices])
    assert straight == pytest.approx(np.add(rest, (-30, -0.5, 0)), abs=1e-5)
    away = np.hypot(bent[:, 0] - 20, bent[:, 1])
    assert away == pytest.approx(2 - np.where(rest[:, 1] < 0, 0.3, 0.7), abs=0.02)
    assert bent[:, 2] == pytest.approx(rest[:, 2], abs=1e-5)
    kept = {o.data.name for o in bpy.data.collections["Library"].objects}
    assert kept == {data.name for data, _ in there} and len(kept) == 2


def test_a_box_that_stands_for_what_is_bent_is_not(files):
    ground, recorded = bent_hedge()
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    built = fill(ground, built_on(ground, recorded))
    bpy.context.view_layer.update()
    assert built.instances == 2 and len(built.problems) == 1
    lengths = sorted(np.linalg.norm(place[:3, 0]) for _, place in shown())
    assert lengths[1] == pytest.approx(8.0, abs=1e-4) and lengths[0] == pytest.approx(1.8, abs=0.1)


def test_rotations_are_kept_exactly_by_many_instances(files):
    rng = np.random.default_rng(3)
    axes, _ = np.linalg.qr(rng.normal(size=(500, 3, 3)))
    axes *= np.sign(np.linalg.det(axes))[:, None, None]
    axes[:3] = [np.diag(d) for d in ((1, -1, -1), (-1, 1, -1), (-1, -1, 1))]
    places, sizes = rng.normal(size=(500, 3)), rng.uniform(0.5, 2.0, (500, 3))
    source = box("statue", (1.0, 1.0, 1.0))
    scattering = bridge("writing.scattering")
    turns = scattering.quaternions(axes)
    single = (np.asarray(a, np.float32) for a in (places, turns, sizes))
    made = scattering.scattered("many", source, *single)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.update()
    found = np.array([place for _, place in shown()])
    assert found[:, :3, 3] == pytest.approx(places, abs=1e-5)
    assert found[:, :3, :3] == pytest.approx(axes * sizes[:, None], abs=1e-5)


def test_the_cameras_see_everything(files):
    fill(plots(), built_on(plots(), tree()))
    scene = bpy.context.scene
    bpy.context.view_layer.update()
    from bpy_extras.object_utils import world_to_camera_view

    cameras = [o for o in scene.objects if o.type == "CAMERA"]
    assert len(cameras) == 2
    for camera in cameras:
        for name in ("plot", "Parcels"):
            seen = [world_to_camera_view(scene, camera, v.co) for v in scene.objects[name].data.vertices]
            assert all(
                0 < p.x < 1 and 0 < p.y < 1 and camera.data.clip_start < p.z < camera.data.clip_end for p in seen
            )


def test_parcels_reach_down_to_the_ground(files):
    fill(plots(), built_on(plots(), tree()))
    parcels, ground = (bpy.context.scene.objects[name].data for name in ("Parcels", "Ground"))
    heights = sorted({round(v.co.z, 6) for v in parcels.vertices})
    assert heights == pytest.approx([-0.06, -0.03], abs=1e-6) and ground.vertices[0].co.z == pytest.approx(-0.06)
    edges = {}
    for polygon in parcels.polygons:
        for key in polygon.edge_keys:
            edges[key] = edges.get(key, 0) + 1
    open_at = {round(parcels.vertices[k].co.z, 6) for key, count in edges.items() if count == 1 for k in key}
    assert open_at == {heights[0]}


def test_an_empty_plan_is_refused():
    with pytest.raises(engine("errors").InputError, match="nothing was built and there are no parcels"):
        fill(engine().Scene([]), built_on(engine().Scene([]), tree()))


@pytest.mark.parametrize(
    ("name", "like"), [("entrance door", "door"), ("lower window sill", "sill"), ("Street Wall", "wall")]
)
def test_the_last_word_that_is_known_gives_the_colour(name, like):
    shading = bridge("writing.shading")
    assert shading.finish_of(name) == shading.FINISHES[like]
    assert shading.finish_of("quince") == shading.finish_of("quince") != shading.finish_of("medlar")
