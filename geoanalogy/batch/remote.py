"""What runs on a worker of a cluster: it travels there by value, and knows the engine by the name it has there."""


def shared(job: str) -> str:
    """What all tiles have in common, as a result that the workers hand to each other.

    Parameters
    ----------
    job : str

    Returns
    -------
    str
    """
    return job


def build(job: str, scene: str, digest: str) -> tuple[str, bytes]:
    """Build a tile.

    Parameters
    ----------
    job, scene : str
        As `computing.job_text` and `tiles.scene_text` wrote them.
    digest : str
        Of the engine that asks.

    Returns
    -------
    str
        Why this worker cannot build anything, in a sentence; "" where it can.
    bytes
        The product.
    """
    import importlib
    import socket

    try:
        computing = importlib.import_module("geoanalogy.batch.computing")
        release = importlib.import_module("geoanalogy.batch.release")
        if release.digest() != digest:
            reason = f"the worker on {socket.gethostname()} has another GeoAnalogy ({release.version()})"
            return f"{reason}; install the same version everywhere", b""
        return "", computing.compute(job, scene).to_bytes()
    except ModuleNotFoundError as error:
        reason = f"the worker on {socket.gethostname()} lacks the module {error.name}: install geoanalogy there"
        return f"{reason} (pip install .)", b""
