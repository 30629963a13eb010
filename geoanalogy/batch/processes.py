"""Tiles built by several processes of this machine."""

import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Generator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from .release import ENGINE
from .store import Store

#: How often a tile is tried whose process ended without an answer: killed for want of memory, or by somebody.
TRIES = 2

#: Seconds between two looks at whether to stop.
PATIENCE = 0.2

#: Which copy of the engine a process is to use, and nothing else of the installation it was started from.
PROGRAM = "import sys; sys.path[:0] = {paths!r}; from {package}.batch.worker import main; main()"


@dataclass(frozen=True)
class Work:
    """One tile to build.

    Attributes
    ----------
    key : str
        Name of the product.
    scene : str
        As `tiles.scene_text` wrote it.
    """

    key: str
    scene: str


def build_here(
    job: str, work: Sequence[Work], store: Store, count: int
) -> Generator[tuple[str, str] | None, None, None]:
    """Build tiles by several processes, which end when the iteration is left.

    Parameters
    ----------
    job : str
    work : sequence of Work
    store : Store
        Takes the products.
    count : int
        Processes.

    Yields
    ------
    (key, reason) or None
        Each tile when it is done, "" for the reason, or what it failed by; None where nothing happened for a while.

    Raises
    ------
    OSError
        Where a file cannot be written, by whichever process; other tiles would fail alike.
    """
    job_file = store.folder / f"job-{os.getpid()}.json"
    job_file.write_text(job, encoding="utf-8")
    waiting: queue.SimpleQueue[tuple[Work, int] | None] = queue.SimpleQueue()
    answers: queue.SimpleQueue[tuple[str, str | OSError]] = queue.SimpleQueue()
    for one in work:
        waiting.put((one, TRIES))
    crew = [_Crew(job_file, store, waiting, answers) for _ in range(min(count, len(work)))]
    try:
        for member in crew:
            member.start()
        left = len(work)
        while left:
            try:
                key, reason = answers.get(timeout=PATIENCE)
            except queue.Empty:
                yield None
                continue
            if isinstance(reason, OSError):
                raise reason
            left -= 1
            yield key, reason
    finally:
        for _ in crew:
            waiting.put(None)  # whichever thread takes it
        for member in crew:
            member.stop()
        for member in crew:
            if member.ident is not None:
                member.join()
        job_file.unlink(missing_ok=True)


class _Crew(threading.Thread):
    """A thread that keeps one process busy, and replaces it where it ends."""

    def __init__(
        self,
        job: Path,
        store: Store,
        waiting: "queue.SimpleQueue[tuple[Work, int] | None]",
        answers: "queue.SimpleQueue[tuple[str, str | OSError]]",
    ) -> None:
        super().__init__(daemon=True)
        self._job, self._store = job, store
        self._waiting, self._answers = waiting, answers
        self._process: subprocess.Popen[str] | None = None
        self._stopped = threading.Event()

    def run(self) -> None:
        while not self._stopped.is_set():
            item = self._waiting.get()
            if item is None:
                return
            work, tries = item
            reason: str | OSError | None
            scene = self._store.folder / f"{work.key}.json"
            try:
                scene.write_text(work.scene, encoding="utf-8")
                reason = self._ask([str(self._job), str(scene), str(self._store.path(work.key))])
            except OSError as error:
                reason = error
            finally:
                scene.unlink(missing_ok=True)
            if self._stopped.is_set():
                return
            if reason is None and tries > 1:
                self._waiting.put((work, tries - 1))
                continue
            self._answers.put((work.key, "its process ended without a result" if reason is None else reason))

    def stop(self) -> None:
        """End the process; the thread ends when it next looks."""
        self._stopped.set()
        if self._process is not None:
            self._process.kill()
            _let_go(self._process)

    def _ask(self, files: list[str]) -> str | None:
        """Have a tile built: what it failed by, "" where it did not; None where the process has ended.

        Raises OSError where the process could not write the product.
        """
        if self._process is not None and self._process.poll() is not None:
            _let_go(self._process)
            self._process = None
        if self._process is None:
            self._process = _started()
        process = self._process
        assert process.stdin is not None and process.stdout is not None
        try:
            process.stdin.write(json.dumps(files) + "\n")
            process.stdin.flush()
            answer = process.stdout.readline()
        except (OSError, ValueError):
            return None
        if not answer:
            process.wait()
            return None
        reason, unwritten = json.loads(answer)
        if unwritten:
            raise OSError(unwritten)
        return str(reason)


def _let_go(process: "subprocess.Popen[str]") -> None:
    """Close what connects to a process that ends."""
    process.wait()
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            with suppress(OSError, ValueError):
                stream.close()


def _started() -> "subprocess.Popen[str]":
    paths = [str(ENGINE.parent), *(path for path in sys.path if path)]
    environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}
    # One thread each: as many processes as processors are asked for.
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        environment.setdefault(name, "1")
    hidden = getattr(subprocess, "CREATE_NO_WINDOW", 0)
    return subprocess.Popen(
        [sys.executable, "-c", PROGRAM.format(paths=paths, package=ENGINE.name)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        encoding="utf-8",
        env=environment,
        creationflags=hidden,
    )
