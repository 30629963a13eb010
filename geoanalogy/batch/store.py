"""Finished tiles on disk: what a job that was stopped goes on from."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import InputError
from .product import Product


def ensure_folder(folder: Path) -> None:
    """Make a folder where it is not there.

    Parameters
    ----------
    folder : Path

    Raises
    ------
    OSError
        Where it cannot be made, naming it.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OSError(f"cannot make the folder {folder}: {error.strerror or error}") from None


class Store:
    """A folder with the jobs and products of tiles, by what they depend on.

    Several processes may share it; what has a name in it is complete.

    Parameters
    ----------
    folder : Path
        Made where it is not there.

    Raises
    ------
    OSError
        Where it cannot be made.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        ensure_folder(folder)

    def path(self, key: str) -> Path:
        """Where the product of a tile is kept.

        Parameters
        ----------
        key : str

        Returns
        -------
        Path
        """
        return self.folder / f"{key}.npz"

    def find(self, key: str) -> Product | None:
        """A finished tile.

        Parameters
        ----------
        key : str

        Returns
        -------
        Product or None
            None where it is not there, or damaged.
        """
        try:
            return Product.from_bytes(self.path(key).read_bytes())
        except (OSError, InputError):
            return None

    def keep(self, key: str, product: bytes) -> None:
        """Keep a finished tile.

        Parameters
        ----------
        key : str
        product : bytes

        Raises
        ------
        OSError
            Where it cannot be written; a part of it is never left under its name.
        """
        write_whole(self.path(key), product)

    def forget(self) -> None:
        """Remove all tiles and what stopped processes have left, and the folder where nothing else is in it."""
        for pattern in ("*.npz", "*.npz.*.part", "*.json"):
            for path in self.folder.glob(pattern):
                path.unlink(missing_ok=True)
        if not any(self.folder.iterdir()):
            self.folder.rmdir()


@contextmanager
def ready(path: Path, content: bytes) -> Iterator[None]:
    """Write a file that takes its place when all that is done meanwhile has gone well.

    Parameters
    ----------
    path : Path
        One of that name stays as it was until then.
    content : bytes

    Yields
    ------
    None
        When it is written, beside its name.

    Raises
    ------
    OSError
        Where it cannot be written, naming it.
    """
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        try:
            part.write_bytes(content)
        except OSError as error:
            raise OSError(f"cannot write {path}: {error.strerror or error}") from None
        yield
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def write_whole(path: Path, content: bytes) -> None:
    """Write a file that is there whole or not at all.

    Parameters
    ----------
    path : Path
        One of that name stays as it was until the new one is complete.
    content : bytes

    Raises
    ------
    OSError
        Where it cannot be written, naming it.
    """
    with ready(path, content):
        pass
