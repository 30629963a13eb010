"""The command `apply`: stored operations trees on a file of parcels, in tiles, and what comes of it as files."""

import argparse
import json
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from .batch.detail import DETAILS
from .batch.generation import Choices, Job, generate, merged
from .batch.manifest import file_of, manifest, manifest_bytes
from .batch.product import Product
from .batch.store import ensure_folder, ready
from .batch.tiles import PARCELS_PER_TILE, wanted_labels
from .errors import InputError
from .formats import obj
from .formats.files import read_parcels
from .formats.repair import of_few_vertices, without_overlaps
from .geometry.mesh import Mesh
from .geometry.scene import Scene
from .operations.tree import OperationsTree
from .progress import Progress


def count(text: str) -> int:
    """A positive whole number of a command line.

    Parameters
    ----------
    text : str

    Returns
    -------
    int
    """
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} should be a whole number from 1 on")
    return int(text)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Those of `apply` that need no Blender.

    Parameters
    ----------
    parser : argparse.ArgumentParser
    """
    parser.add_argument("--label", metavar="NAME", help="property of the file that holds the labels")
    parser.add_argument("--labels", type=Path, metavar="TABLE.json", help="how tags of a map become labels")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="seed of all chance (0)")
    parser.add_argument("--detail", choices=DETAILS, default="full", help="how far down the surfaces (full)")
    parser.add_argument("--jobs", type=count, default=1, metavar="N", help="processes of this machine (1)")
    parser.add_argument("--scheduler", default="", metavar="ADDRESS", help="build on this Dask cluster")
    parser.add_argument(
        "--per-tile", type=count, default=PARCELS_PER_TILE, metavar="N", help=f"parcels of a tile ({PARCELS_PER_TILE})"
    )
    parser.add_argument(
        "--only", type=count, action="append", default=[], metavar="K", help="build the tile of this number (all)"
    )
    parser.add_argument("--work", type=Path, metavar="FOLDER", help="keep finished tiles here (beside the output)")
    parser.add_argument("--tiles", type=Path, metavar="FOLDER", help="write a .blend per tile here, and link them")


def results_of(arguments: argparse.Namespace) -> list[Path]:
    """The files that were asked for.

    Parameters
    ----------
    arguments : argparse.Namespace

    Returns
    -------
    list of Path

    Raises
    ------
    ArgumentTypeError
        Where nothing would come of the work, or what is asked for does not fit together.
    """
    results = [path for path in (arguments.output, arguments.render) if path is not None]
    if not results and not (arguments.only and arguments.work):
        raise argparse.ArgumentTypeError(
            "apply needs --output, --render or both: it would do nothing (with --only, --work is enough)"
        )
    if arguments.tiles is not None and (arguments.output is None or arguments.output.suffix.lower() != ".blend"):
        raise argparse.ArgumentTypeError("--tiles needs an --output that ends in .blend, which links the tiles")
    if arguments.scheduler and arguments.jobs > 1:
        raise argparse.ArgumentTypeError("--scheduler and --jobs are two ways to build; choose one")
    return results


def apply(arguments: argparse.Namespace, progress: Progress) -> str:
    """Apply trees to a file of parcels, and write what was asked for.

    Parameters
    ----------
    arguments : argparse.Namespace
    progress : callable (fraction, text) -> bool
        Returning False stops.

    Returns
    -------
    str
        What has been made, and what could not be.

    Raises
    ------
    InputError
        Where a file cannot be used at all.
    Cancelled
        When `progress` returned False; finished tiles are kept.
    OSError
        Where something cannot be written.
    """
    results = results_of(arguments)
    if arguments.library is not None and not arguments.library.is_file():
        raise InputError(f"{arguments.library} is not there; check the path")
    if arguments.tiles is not None:  # before the long work, in case it cannot be made
        ensure_folder(arguments.tiles)
    meshes_only = arguments.output is not None and arguments.output.suffix.lower() == ".obj"
    drawn = [path for path in results if not (meshes_only and path == arguments.output)]
    if drawn:  # before the long work, in case there is no Blender
        from .blender.writing import buildings
    trees = [(path, OperationsTree.load(path)) for path in arguments.tree]
    for path, recorded in trees:
        if not recorded.nodes:
            raise InputError(f"{path.name} has no operations; record some and save it again")
    tree = merged([(path.stem, recorded) for path, recorded in trees])
    scene, problems = read(arguments, tree)
    choices = Choices(
        arguments.seed, arguments.detail, arguments.jobs, arguments.scheduler, arguments.per_tile, tuple(arguments.only)
    )
    work = arguments.work or results[0].with_name(f"{results[0].stem}.tiles")
    job = generate(tree, scene, work, choices, progress)
    said = [*problems, *(p for key in job.keys for p in job.facts.get(key, {}).get("problems", ()))]
    if not job.finished:
        done = f"{len(job.facts)} of {len(job.tiles)} tiles are finished, in {work}; nothing is written yet"
        return "\n".join([*dict.fromkeys(said), done])
    record = _manifest(arguments, trees, job, problems)
    # Where one of the results cannot be written, the manifest still says what the earlier ones are.
    with ready(manifest_path(results[0]), manifest_bytes(record)) if results else nullcontext():
        if meshes_only:
            obj.write(_meshes(job), arguments.output)
        if drawn:
            wanted = buildings.Results(
                None if meshes_only else arguments.output, arguments.render, arguments.library, arguments.tiles
            )
            properties = {"ga_offset": list(scene.offset), "ga_manifest": json.dumps(record["settings"])}
            said += buildings.write(scene, _products(job), wanted, properties, progress).problems
    if arguments.work is None:
        job.store.forget()
    made = _made(record)
    return "\n".join([*dict.fromkeys(said), made, *(f"wrote {path}" for path in results)])


def read(arguments: argparse.Namespace, tree: OperationsTree) -> tuple[Scene, list[str]]:
    """The parcels of a file, or of the .blend that is open, and what is wrong with them.

    Parameters
    ----------
    arguments : argparse.Namespace
    tree : OperationsTree
        Whose parcels are not to overlap, nor to have outlines of very many vertices.

    Returns
    -------
    Scene
    list of str

    Raises
    ------
    InputError
        Where the parcels cannot be read, or none of them can be used.
    """
    if arguments.parcels is None:
        from .blender.open_parcels import open_parcels

        scene, problems = open_parcels()
    else:
        scene, problems = read_parcels(arguments.parcels, label=arguments.label, table=arguments.labels)
    if not scene.polygons and problems:
        more = f", and {len(problems) - 1} more like this" if len(problems) > 1 else ""
        raise InputError(f"no polygon can be used: {problems[0]}{more}")
    built_on = wanted_labels(tree)
    return without_overlaps(of_few_vertices(scene, built_on, problems), built_on, problems), problems


def manifest_path(result: Path) -> Path:
    """Where the manifest of a result is written.

    Parameters
    ----------
    result : Path

    Returns
    -------
    Path
        Beside it: "city.manifest.json" for "city.blend".
    """
    return result.with_name(f"{result.stem}.manifest.json")


def _manifest(
    arguments: argparse.Namespace, trees: Sequence[tuple[Path, OperationsTree]], job: Job, problems: Sequence[str]
) -> dict[str, Any]:
    parcels = {"file": "(the open file)"} if arguments.parcels is None else file_of(arguments.parcels)
    choices = {"seed": arguments.seed, "detail": arguments.detail, "label": arguments.label}
    return manifest(
        [{**file_of(path), "operations": len(tree.nodes)} for path, tree in trees],
        {**parcels, "offset": list(job.scene.offset), "polygons": len(job.scene)},
        {**choices, "per_tile": arguments.per_tile},
        [(tile, key, job.facts[key]) for tile, key in zip(job.tiles, job.keys, strict=True)],
        problems,
    )


def _products(job: Job) -> Iterator[tuple[str, Product]]:
    return ((tile.name, product) for tile, product in job.products())


def _meshes(job: Job) -> Iterator[tuple[str, Mesh]]:
    for _, product in job.products():
        for k, name in enumerate(product.masses.names):
            yield name, product.masses.single(k)


def _made(record: dict[str, Any]) -> str:
    counts = record["counts"]
    known = counts["known surfaces"] / counts["surfaces"] if counts["surfaces"] else 0.0
    return f"{counts['elements']} elements on {counts['parcels']} parcels; {known:.0%} of all surfaces were known"
