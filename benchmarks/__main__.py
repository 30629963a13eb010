"""Run the benchmarks and write their tables into docs/benchmarks.md.

    python -m benchmarks [--full] [--print] [NAME …]

Without names, all of them. A benchmark is a module of this folder with a function `tables(full)`, which yields what
`benchmarks.measuring.Table` describes. Its tables replace what stands between ``<!-- NAME -->`` and ``<!-- /NAME -->``
in the report; the prose around is left alone. One that needs data which is not there says so in one sentence.
"""

from __future__ import annotations

import argparse
import importlib
import os
import re
import time
from pathlib import Path

# Processor time is that of one processor: threads of linear algebra wait busily. Read when numpy is imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from .measuring import machine

FOLDER = Path(__file__).resolve().parent
REPORT = FOLDER.parent / "docs" / "benchmarks.md"


def names() -> list[str]:
    """The modules of this folder that have tables, by name."""
    return sorted(p.stem for p in FOLDER.glob("*.py") if re.search(r"^def tables\(", p.read_text("utf-8"), re.M))


def with_tables(report: str, name: str, text: str) -> str:
    """A report with the tables of a benchmark in their place; at its end, where it has none for them."""
    block = f"<!-- {name} -->\n\n{text.strip()}\n\n<!-- /{name} -->"
    pattern = re.compile(rf"<!-- {re.escape(name)} -->.*?<!-- /{re.escape(name)} -->", re.S)
    if pattern.search(report):
        return pattern.sub(lambda _: block, report, count=1)
    return f"{report.rstrip()}\n\n## {name}\n\n{block}\n".lstrip()


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(names())}")
    parser.add_argument("--full", action="store_true", help="the long ones too")
    parser.add_argument("--print", action="store_true", help="leave the report as it is")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - set(names())
    if unknown:
        parser.error(f"no benchmark is called {', '.join(sorted(unknown))}; choose from {', '.join(names())}")
    for name in arguments.names or names():
        start = time.perf_counter()
        written = [f"{machine()}\n"]
        print(f"# {name}\n\n{written[0]}", flush=True)
        for table in importlib.import_module(f"benchmarks.{name}").tables(full=arguments.full):
            written.append(table.markdown())
            print(written[-1], flush=True)
        print(f"{name}: {time.perf_counter() - start:.0f} s", flush=True)
        if not arguments.print:
            # After each: what has been measured is kept where a later one is stopped.
            report = REPORT.read_text("utf-8") if REPORT.is_file() else ""
            REPORT.write_text(with_tables(report, name, "\n".join(written)), encoding="utf-8")


if __name__ == "__main__":
    main()
