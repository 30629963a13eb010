"""Run the benchmarks and write their tables to docs/benchmarks.md.

    python -m benchmarks [--full] [NAME …]

Without names, all of them. A benchmark is a module of this folder with a function `tables`, which yields what
`benchmarks.measuring.Table` describes. Those that need data which is not there say so in one sentence.
"""

from __future__ import annotations

import argparse
import importlib
import re
from pathlib import Path

from .measuring import machine

FOLDER = Path(__file__).resolve().parent
REPORT = FOLDER.parent / "docs" / "benchmarks.md"
HEAD = """# Benchmarks

Written by `make bench`. Every figure was taken in the same run as what it is compared with.

"""


def names() -> list[str]:
    """The modules of this folder that have tables, by name."""
    return sorted(p.stem for p in FOLDER.glob("*.py") if re.search(r"^def tables\(", p.read_text("utf-8"), re.M))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(names())}")
    parser.add_argument("--full", action="store_true", help="the long ones too")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - set(names())
    if unknown:
        parser.error(f"no benchmark is called {', '.join(sorted(unknown))}; choose from {', '.join(names())}")
    sections = sections_of(REPORT)
    for name in arguments.names or names():
        module = importlib.import_module(f"benchmarks.{name}")
        text = f"## {name}\n\n{(module.__doc__ or '').splitlines()[0]}\n\n{machine()}\n"
        print(text, flush=True)
        for table in module.tables(full=arguments.full):
            print(table.markdown(), flush=True)
            text += f"\n{table.markdown()}"
        sections[name] = text
    REPORT.write_text(HEAD + "\n".join(sections[name] for name in sorted(sections)), encoding="utf-8")


def sections_of(report: Path) -> dict[str, str]:
    """The sections of the last report by the benchmarks' names; those that are not run again stay."""
    if not report.is_file():
        return {}
    parts = re.split(r"^## (\w+)\n", report.read_text("utf-8"), flags=re.M)[1:]
    known = names()
    return {n: f"## {n}\n{body.rstrip()}\n" for n, body in zip(parts[::2], parts[1::2], strict=True) if n in known}


if __name__ == "__main__":
    main()
