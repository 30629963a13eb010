"""Which engine made something: its version, and a digest of its source."""

import hashlib
import tomllib
from functools import cache
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as installed_version
from pathlib import Path

ENGINE = Path(__file__).resolve().parents[1]

#: Subpackages that what is computed for a parcel does not depend on.
APART = ("blender", "batch")


@cache
def version() -> str:
    """The version of this engine: of the extension that it is in, else of the package that pip installed.

    Returns
    -------
    str
        "unknown" where neither says.
    """
    manifest = ENGINE.parent / "blender_manifest.toml"
    if manifest.is_file():
        return str(tomllib.loads(manifest.read_text(encoding="utf-8"))["version"])
    try:
        return installed_version("geoanalogy")
    except PackageNotFoundError:
        return "unknown"


@cache
def digest() -> str:
    """A digest of the source that results depend on, so that what another engine has computed is not taken for ours.

    Returns
    -------
    str
        16 hexadecimal digits.
    """
    found = hashlib.sha256(version().encode())
    for path in sorted(ENGINE.rglob("*.py")):
        place = path.relative_to(ENGINE)
        if place.parts[0] not in APART or place.name in ("product.py", "computing.py", "detail.py"):
            found.update(place.as_posix().encode())
            found.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return found.hexdigest()[:16]
