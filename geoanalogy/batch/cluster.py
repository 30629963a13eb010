"""Tiles built on a Dask cluster. Dask is asked for only here."""

import hashlib
import importlib
import time
from collections.abc import Generator, Iterator, Sequence
from typing import Any

from ..errors import InputError
from .processes import PATIENCE, Work
from .release import digest

#: Seconds to wait for the scheduler.
REACHED = 10


def build_there(job: str, work: Sequence[Work], address: str) -> Generator[tuple[str, str, bytes] | None, None, None]:
    """Build tiles on a cluster.

    A worker that is lost loses its tile to another one: a tile has a name, its content depends on nothing else, and so
    each is taken once, whoever built it.

    Parameters
    ----------
    job : str
    work : sequence of Work
    address : str
        Of the scheduler, "tcp://10.0.0.1:8786".

    Yields
    ------
    (key, reason, product) or None
        Each tile when it is done, "" for the reason, or what it failed by; None where nothing happened for a while.

    Raises
    ------
    InputError
        Where Dask is not installed, the scheduler cannot be reached, or a worker has no engine or another one.
    """
    try:
        distributed = importlib.import_module("distributed")
        pickles = importlib.import_module("cloudpickle")
    except ModuleNotFoundError as error:
        raise InputError(
            f"the module {error.name} is missing, which --scheduler needs: install it (pip install distributed)"
        ) from None
    from . import remote

    # Inside an extension this module has a name that no worker knows, so that it travels itself.
    pickles.register_pickle_by_value(remote)
    try:
        client = distributed.Client(address, timeout=REACHED, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(
            f"no Dask scheduler answers at {address} ({error}); start one, or give another address"
        ) from None
    try:
        yield from _futures(client, job, work, remote)
    finally:
        client.close()
        pickles.unregister_pickle_by_value(remote)


def _futures(client: Any, job: str, work: Sequence[Work], remote: Any) -> Iterator[Any]:
    # What workers share is a result, not data: whichever of them is lost, the scheduler has it made again. Its name
    # begins otherwise than those of tiles: from the first word the scheduler tells what a task will take, and took
    # tiles for as brief as this one, not worth to be given to a worker that waits.
    shared = client.submit(remote.shared, job, key=f"geoanalogy_job-{hashlib.sha256(job.encode()).hexdigest()[:32]}")
    futures = {
        client.submit(remote.build, shared, one.scene, digest(), key=f"geoanalogy_tile-{one.key}", retries=1): one.key
        for one in work
    }
    try:
        left = set(futures)
        while left:
            done = [future for future in left if future.done()]
            if not done:
                time.sleep(PATIENCE)
                yield None
            for future in sorted(done, key=lambda f: futures[f]):
                if future.status in ("pending", "lost"):
                    continue  # the worker that had its result has been lost meanwhile: another one builds it
                left.discard(future)
                gathered = client.gather([future], errors="skip")
                if not gathered:
                    yield futures[future], f"{type(future.exception()).__name__}: {future.exception()}", b""
                    continue
                ((refused, product),) = gathered
                if refused:
                    raise InputError(refused)
                yield futures[future], "", product
    finally:
        client.cancel([shared, *futures])
