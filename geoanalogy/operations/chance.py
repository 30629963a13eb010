"""Chance that depends on names alone, so that it does not matter what is evaluated when, or beside what."""

import hashlib


def share(seed: int, name: str) -> float:
    """A number drawn for a name.

    Parameters
    ----------
    seed : int
    name : str

    Returns
    -------
    float
        From 0 up to 1, all equally likely.
    """
    digest = hashlib.sha256(f"{seed}\0{name}".encode()).digest()
    return int.from_bytes(digest[:7], "big") / (1 << 56)
