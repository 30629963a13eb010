"""Files that are there whole or not at all."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import bpy


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A name beside a file, which takes the file's place where all goes well.

    Parameters
    ----------
    path : Path

    Yields
    ------
    Path
        Where to write.

    Raises
    ------
    OSError
        Where nothing was written there.
    """
    part = path.with_name(f"{path.stem}.{os.getpid()}.part{path.suffix}")
    try:
        yield part
        if not part.is_file() or not part.stat().st_size:
            raise OSError(f"cannot write {path}: Blender left no file there.")
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def save_copy(path: Path) -> None:
    """Save the open file under a name that it does not keep.

    Parameters
    ----------
    path : Path
        One of that name stays as it was until the new one is complete.

    Raises
    ------
    OSError
        Where it cannot be written.
    """
    with whole(path) as part:
        try:
            bpy.ops.wm.save_as_mainfile(filepath=str(part), copy=True, compress=True, check_existing=False)
        except RuntimeError as error:
            raise OSError(f"cannot write {path}: {str(error).strip()}") from None
        try:  # Blender does not notice a disk that is full; what the end of the file says is missing then
            with bpy.data.libraries.load(str(part)):
                pass
        except OSError:
            raise OSError(f"cannot write {path}: it is cut off; make room on the disk.") from None
