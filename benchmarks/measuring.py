"""What benchmarks measure with, and the tables they report."""

from __future__ import annotations

import gc
import os
import platform
import statistics
import time
import tracemalloc
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

#: Runs of which the median is reported.
RUNS = 5

#: Seconds after which a median is taken of the runs there are: all benchmarks together take minutes.
ENOUGH = 3.0


@dataclass(frozen=True)
class Table:
    """One table of a report.

    Attributes
    ----------
    title : str
    header : tuple of str
    rows : sequence of tuple
    note : str
        What was measured, and against what.
    """

    title: str
    header: tuple[str, ...]
    rows: Sequence[tuple[object, ...]]
    note: str = ""

    def markdown(self) -> str:
        """The table as Markdown, columns aligned."""
        cells = [[str(c) for c in row] for row in (self.header, *self.rows)]
        widths = [max(len(row[k]) for row in cells) for k in range(len(self.header))]
        lines = ["| " + " | ".join(c.ljust(w) for c, w in zip(row, widths, strict=True)) + " |" for row in cells]
        lines.insert(1, "|" + "|".join("-" * (w + 2) for w in widths) + "|")
        return "\n".join([f"### {self.title}", "", *([self.note, ""] if self.note else []), *lines, ""])


def seconds(work: Callable[[], object], runs: int = RUNS, prepare: Callable[[], object] | None = None) -> float:
    """Median time of some runs, in seconds; `prepare` runs before each, unmeasured.

    No further run starts once they have taken `ENOUGH` together, with what is not measured.
    """
    taken: list[float] = []
    # What was measured before leaves objects that are none of this work's garbage.
    gc.collect()
    gc.freeze()
    try:
        begin = time.perf_counter()
        while len(taken) < runs and not (taken and time.perf_counter() - begin > ENOUGH):
            if prepare is not None:
                prepare()
            gc.collect()
            start = time.perf_counter()
            work()
            taken.append(time.perf_counter() - start)
    finally:
        gc.unfreeze()
    return statistics.median(taken)


def peak_megabytes(work: Callable[[], object]) -> float:
    """Most memory that one run allocates beyond what was there, in megabytes (millions of bytes)."""
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1] / 1e6
    finally:
        tracemalloc.stop()


def duration(value: float) -> str:
    """Seconds, readable: milliseconds below one second."""
    if value < 1:
        return f"{1e3 * value:.0f} ms" if value >= 0.01 else f"{1e3 * value:.2g} ms"
    return f"{value:.1f} s" if value < 10 else f"{value:.0f} s"


def times(slow: float, fast: float) -> str:
    """How many times as long the first takes."""
    ratio = slow / fast
    return f"{ratio:.0f} ×" if ratio >= 10 else f"{ratio:.1f} ×"


def machine() -> str:
    """One sentence about where the figures were taken."""
    return (
        f"Python {platform.python_version()}, numpy {np.__version__}, {os.cpu_count()} cores of {platform.machine()}; "
        f"medians of {RUNS} runs, of fewer where they take more than {ENOUGH:g} s together."
    )
