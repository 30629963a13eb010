"""The manifest: what was made, of what, by which version, in JSON."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from .product import added
from .release import digest, version
from .tiles import Tile

SCHEMA = "geoanalogy.manifest/1"


def file_of(path: Path) -> dict[str, str]:
    """What is noted of a file that was read.

    Parameters
    ----------
    path : Path

    Returns
    -------
    dict
        Its name and the SHA-256 of its content.
    """
    return {"file": path.name, "sha256": hashlib.sha256(path.read_bytes()).hexdigest()}


def manifest(
    trees: Sequence[Mapping[str, Any]],
    parcels: Mapping[str, Any],
    settings: Mapping[str, Any],
    tiles: Sequence[tuple[Tile, str, Mapping[str, Any]]],
    problems: Sequence[str],
) -> dict[str, Any]:
    """The manifest of a job.

    Parameters
    ----------
    trees : sequence of mapping
        What `file_of` says of each, and its number of operations.
    parcels : mapping
        The same of the parcels' file, with their offset.
    settings : mapping
        "seed", "detail", "label" and further choices.
    tiles : sequence of (Tile, str, mapping)
        With each the key and the facts of its product.
    problems : sequence of str
        What was wrong with the file of parcels; those of the tiles are added.

    Returns
    -------
    dict
        Plain data. All times are under names that begin with "seconds".
    """
    whole = added(facts for _, _, facts in tiles)
    return {
        "schema": SCHEMA,
        "version": version(),
        "engine": digest(),
        "trees": [dict(tree) for tree in trees],
        "parcels": dict(parcels),
        "settings": dict(settings),
        "counts": {
            "parcels": len(whole["parcels"]),
            "elements": whole["elements"],
            "surfaces": whole["surfaces"],
            "known surfaces": whole["known"],
            "tiles": len(tiles),
        },
        "seconds": {kind: round(value, 3) for kind, value in sorted(whole["seconds"].items())},
        "tiles": [
            {
                "name": tile.name,
                "key": key,
                "parcels": list(tile.parcels),
                "elements": facts["elements"],
                "seconds": round(facts["seconds"].get("all", 0.0), 3),
            }
            for tile, key, facts in tiles
        ],
        "problems": list(dict.fromkeys([*problems, *whole["problems"]])),
    }


def manifest_bytes(plain: Mapping[str, Any]) -> bytes:
    """A manifest as it is written to a file.

    Parameters
    ----------
    plain : mapping

    Returns
    -------
    bytes
    """
    return (json.dumps(plain, indent=1, ensure_ascii=False) + "\n").encode()
