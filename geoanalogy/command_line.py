"""The batch program: its commands, its progress lines and its exit codes.

The same program is reached in four ways: ``blender -b FILE.blend --python batch.py -- COMMAND``, ``python batch.py
COMMAND`` with the bpy module, ``geoanalogy COMMAND`` where pip installed the engine, and ``blender -b --command
geoanalogy COMMAND`` where the add-on is enabled. Commands that work on a .blend import `geoanalogy.blender` when they
run, so that the others need no Blender.
"""

import argparse
import enum
import glob
import math
import os
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, NoReturn

from .applying import add_options, apply, results_of
from .batch.generation import Stopped
from .errors import Cancelled, InputError


class ExitCode(enum.IntEnum):
    """What the program's exit status means; a farm may rely on it."""

    DONE = 0
    INTERNAL_ERROR = 1
    USAGE = 2
    BAD_INPUT = 3
    CANCELLED = 4
    WRITE_FAILED = 5


# What to do about a module that is missing.
REMEDIES = {
    "manifold3d": "enable the GeoAnalogy extension, which brings it, or install it (pip install manifold3d)",
    "bpy": "install the bpy module (pip install 'geoanalogy[bpy]') or run batch.py inside Blender",
    "numpy": "install it (pip install numpy)",
    "scipy": "enable the GeoAnalogy extension, which brings it, or install it (pip install scipy)",
    "shapely": "enable the GeoAnalogy extension, which brings it, or install it (pip install shapely)",
}


#: Seconds in which a signal has to be noticed. Python looks at signals between two of its own steps, and Blender draws
#: a picture, or saves a large file, in one.
PATIENCE = 3.0


class ProgressLines:
    """Progress as lines on the error stream, and the place where a cancellation is asked for.

    Attributes
    ----------
    noticed : int
        Number of signals; after one, the next report stops the work between two of its steps.
    """

    def __init__(self, quiet: bool = False) -> None:
        self.noticed = 0
        self._quiet = quiet
        self._last = ""

    def __call__(self, fraction: float, text: str) -> bool:
        """Report a step; False asks the caller to stop."""
        line = f"[{round(100 * min(max(fraction, 0.0), 1.0)):3d}%] {text}"
        if not self._quiet and line != self._last:
            print(line, file=sys.stderr, flush=True)
            self._last = line
        return not self.noticed


SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def _signals_cancel(progress: ProgressLines, unfinished: Sequence[Path]) -> Iterator[None]:
    """Let Ctrl-C and the farm's SIGTERM ask for a cancellation; a second one insists, and one that goes unnoticed too.

    Blender replaces Python's own handler by one of its own in background mode, which no Python code sees.

    Parameters
    ----------
    progress : ProgressLines
    unfinished : sequence of Path
        The files that are written.
    """

    def ask(number: int, frame: object) -> None:
        progress.noticed += 1
        if progress.noticed > 1:
            raise KeyboardInterrupt

    def watch(received: int) -> None:
        count = 0
        while number := os.read(received, 1):
            count += number[0] in SIGNALS
            time.sleep(PATIENCE)
            if progress.noticed < count:
                _remove_parts(unfinished)
                os._exit(_failed(ExitCode.CANCELLED, "cancelled; what was not finished is not written"))
        os.close(received)

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    received, sent = os.pipe()
    os.set_blocking(sent, False)
    threading.Thread(target=watch, args=(received,), daemon=True).start()
    before = {number: signal.signal(number, ask) for number in SIGNALS}
    watched = signal.set_wakeup_fd(sent, warn_on_full_buffer=False)
    try:
        yield
    finally:
        signal.set_wakeup_fd(watched)
        for number, handler in before.items():
            signal.signal(number, handler if handler is not None else signal.SIG_DFL)
        os.close(sent)


def _remove_parts(paths: Sequence[Path]) -> None:
    """Remove what this process had begun to write beside files that take their places when they are whole."""
    for path in paths:
        for part in path.parent.glob(f"{glob.escape(path.stem)}.{os.getpid()}.part*"):
            part.unlink(missing_ok=True)


def _path_with_suffix(*suffixes: str) -> Callable[[str], Path]:
    def convert(text: str) -> Path:
        path = Path(text)
        if path.suffix.lower() not in suffixes:
            raise argparse.ArgumentTypeError(f"{text} should end in {' or '.join(suffixes)}")
        return path.absolute()

    return convert


def _fraction(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"{text} should be a number between 0 and 1")
    return value


def _check_writable(paths: Sequence[Path]) -> None:
    """Find out before the long work, not after it, that a result has nowhere to go."""
    for path in paths:
        if not path.parent.is_dir():
            raise OSError(f"cannot write {path}: its folder does not exist.")
        if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
            raise OSError(f"cannot write {path}: it may not be written.")


def _last_written(path: Path) -> int | None:
    return path.stat().st_mtime_ns if path.is_file() and path.stat().st_size else None


def _check_written(paths: Sequence[Path], before: Sequence[int | None]) -> None:
    """Blender reports some failed writes on its console only."""
    for path, written in zip(paths, before, strict=True):
        if _last_written(path) in (None, written):
            raise OSError(f"cannot write {path}: Blender left no file there.")


def _replay(arguments: argparse.Namespace, progress: ProgressLines) -> str:
    results = [path for path in (arguments.output, arguments.render) if path is not None]
    if not results:
        raise argparse.ArgumentTypeError("replay needs --output, --render or both: it would do nothing")
    _check_writable(results)
    from .blender.tree.replay import replay_file

    before = [_last_written(path) for path in results]
    report = replay_file(
        arguments.file,
        output=arguments.output,
        render=arguments.render,
        seed=arguments.seed,
        threshold=arguments.threshold,
        progress=progress,
    )
    _check_written(results, before)
    made = f"{report.operations} operations replayed, {report.objects} objects made"
    return "\n".join([made, *report.problems, *(f"wrote {path}" for path in results)])


def _apply(arguments: argparse.Namespace, progress: ProgressLines) -> str:
    _check_writable(results_of(arguments))
    return apply(arguments, progress)


def build_parser() -> argparse.ArgumentParser:
    """The program's command-line parser.

    Returns
    -------
    argparse.ArgumentParser
        With one sub-command per job; each sets `run`, a function of the arguments and the progress lines that returns
        what to print.
    """
    try:
        release = version("geoanalogy")
    except PackageNotFoundError:
        release = "(not installed: run from its folder)"
    codes = ", ".join(f"{code.value} {code.name.lower().replace('_', ' ')}" for code in ExitCode)
    parser = argparse.ArgumentParser(
        prog="geoanalogy", description="Edit propagation by geometric analogy.", epilog=f"Exit codes: {codes}."
    )
    parser.add_argument("--version", action="version", version=f"GeoAnalogy {release}")
    silence = "no progress lines"
    parser.add_argument("--quiet", action="store_true", help=silence)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    replay = commands.add_parser("replay", help="replay the operations of a .blend from its examples")
    blend = _path_with_suffix(".blend")
    replay.add_argument("file", nargs="?", type=blend, metavar="FILE.blend", help="the scene (the open file)")
    replay.add_argument("--output", type=blend, metavar="OUT.blend", help="write the replayed scene here")
    replay.add_argument("--render", type=_path_with_suffix(".png"), metavar="OUT.png", help="draw a picture of it here")
    replay.add_argument("--seed", type=int, metavar="N", help="seed of the operations that draw lots (their own)")
    replay.add_argument("--threshold", type=_fraction, metavar="T", help="least importance of a result (their own)")
    replay.set_defaults(run=_replay)

    city = commands.add_parser("apply", help="apply operations trees to parcels, in tiles")
    tree = _path_with_suffix(".json")
    city.add_argument(
        "--tree", type=tree, action="append", required=True, metavar="TREE.json", help="several, by repeating it"
    )
    city.add_argument("--parcels", type=Path, metavar="FILE.geojson", help="labelled polygons (the open file's)")
    either = _path_with_suffix(".blend", ".obj")
    city.add_argument("--output", type=either, metavar="OUT.blend", help="write the scene here, or its meshes (.obj)")
    city.add_argument("--render", type=_path_with_suffix(".png"), metavar="OUT.png", help="draw a picture of it here")
    city.add_argument("--library", type=blend, metavar="LIB.blend", help="where library objects are, by their names")
    add_options(city)
    city.set_defaults(run=_apply)
    for command in (replay, city):  # before the command or among its options
        command.add_argument("--quiet", action="store_true", default=argparse.SUPPRESS, help=silence)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command.

    Parameters
    ----------
    arguments : sequence of str, optional
        The command and its options; those of the process where None.

    Returns
    -------
    int
        An `ExitCode`. No exception leaves this function: Blender's background mode would end with status 0 after one.
    """
    parser = build_parser()
    try:
        parsed = parser.parse_args(arguments)
    except SystemExit as request:
        return request.code if isinstance(request.code, int) else ExitCode.USAGE
    run: Callable[[Any, ProgressLines], str] = parsed.run
    progress = ProgressLines(parsed.quiet)
    try:
        with _signals_cancel(progress, [value for value in vars(parsed).values() if isinstance(value, Path)]):
            print(run(parsed, progress), flush=True)
        return ExitCode.DONE
    except argparse.ArgumentTypeError as error:
        return _failed(ExitCode.USAGE, error)
    except InputError as error:
        return _failed(ExitCode.BAD_INPUT, error)
    except ModuleNotFoundError as error:
        if error.name not in REMEDIES:
            traceback.print_exc()
            return ExitCode.INTERNAL_ERROR
        return _failed(ExitCode.BAD_INPUT, missing_module(error))
    except Stopped as kept:
        return _failed(ExitCode.CANCELLED, kept)
    except (Cancelled, KeyboardInterrupt):
        return _failed(ExitCode.CANCELLED, "cancelled; nothing was written")
    except OSError as error:
        return _failed(ExitCode.WRITE_FAILED, error)
    except Exception:
        traceback.print_exc()
        return _failed(ExitCode.INTERNAL_ERROR, "internal error, see above; please report it")


def missing_module(error: ModuleNotFoundError) -> str:
    """One sentence about a library that is not there, with what to do.

    Parameters
    ----------
    error : ModuleNotFoundError
        As raised by the import.

    Returns
    -------
    str
        The sentence.
    """
    return f"the module {error.name} is missing: {REMEDIES.get(str(error.name), 'install it')}."


def _failed(code: ExitCode, reason: object) -> int:
    print(f"geoanalogy: {reason}", file=sys.stderr, flush=True)
    return code


def leave(code: int) -> NoReturn:
    """End the process with this code.

    The bpy module may crash while Python shuts down, after all work is done, and would replace the code by the
    crash's; so Python does not shut down there. A complete Blender ends as always.

    Parameters
    ----------
    code : int
        What `main` returned.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    blender: Any = sys.modules.get("bpy")
    if blender is not None and blender.app.module:
        os._exit(code)
    sys.exit(code)


def run() -> NoReturn:
    """The console script: run a command, and end the process with its code."""
    leave(main())
