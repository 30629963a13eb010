"""The command line that the scripts with figures of the documentation share."""

import argparse
from collections.abc import Callable, Mapping
from pathlib import Path

from matplotlib.figure import Figure

from . import drawing as draw

FOLDER = Path(__file__).resolve().parent.parent / "docs" / "figures"


def draw_those_named(description: str, definitions: Mapping[str, object]) -> None:
    """Draw the figures that the command line names, or all, and say where they are.

    Parameters
    ----------
    description : str
        Of the script: the first line is shown by ``--help``.
    definitions : mapping of str to object
        What the script defines: its functions ``figure_NAME`` draw the figures.
    """
    figures: dict[str, Callable[[], Figure]] = {
        name.removeprefix("figure_"): made
        for name, made in definitions.items()
        if name.startswith("figure_") and callable(made)
    }
    parser = argparse.ArgumentParser(description=description.split("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(figures)}")
    names = parser.parse_args().names
    unknown = set(names) - set(figures)
    if unknown:
        parser.error(f"no figure is called {', '.join(sorted(unknown))}; choose from {', '.join(figures)}")
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in names or figures:
        target = FOLDER / f"figure_{name}.png"
        figure = figures[name]()
        figure.savefig(target)
        draw.plt.close(figure)
        print(target.relative_to(FOLDER.parent.parent))
