"""Applying a stored operations tree to a file of parcels: the batch program's work up to writing the results."""

import os

from .formats.files import read_parcels
from .operations.applied import Applied
from .operations.tree import OperationsTree
from .progress import Progress, Stepper, run


def apply_file(
    tree: str | os.PathLike[str],
    parcels: str | os.PathLike[str],
    *,
    seed: int = 0,
    label: str | None = None,
    progress: Progress | None = None,
) -> Applied:
    """Apply a stored tree to a file of parcels.

    Parameters
    ----------
    tree : path
        As `OperationsTree.save` writes it.
    parcels : path
        Any file that `read_scene` reads.
    seed : int
        Of all chance in the tree.
    label : str, optional
        Property that holds the labels of the parcels.
    progress : callable (fraction, text) -> bool, optional
        Returning False cancels.

    Returns
    -------
    Applied
        The elements; its problems name the parcels that were left out as well.

    Raises
    ------
    InputError
        Where one of the files cannot be used at all.
    Cancelled
        When `progress` returned False.
    """
    return run(apply_steps(tree, parcels, seed=seed, label=label), progress)


def apply_steps(
    tree: str | os.PathLike[str], parcels: str | os.PathLike[str], *, seed: int = 0, label: str | None = None
) -> Stepper[Applied]:
    """The stepper behind `apply_file`.

    Parameters
    ----------
    tree, parcels : path
    seed : int
    label : str, optional

    Returns
    -------
    generator of (float, str)
        Returns what was applied.
    """
    recorded = OperationsTree.load(tree)
    scene, problems = read_parcels(parcels, label=label)
    applied = yield from recorded.steps(scene, seed)
    applied.problems = (*problems, *applied.problems)
    return applied
