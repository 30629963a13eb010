"""A process that builds tiles: it reads lines with the names of files, and answers each when the tile is done.

It is started with the engine's folder on its path, whatever package the engine is in where it was started from, and
needs no Blender. A line is a JSON list: the file of the job, that of the tile's scene, that of the product. So is an
answer: what the tile failed by, "" where it did not; and why it could not be written, "" where it could.
"""

import json
import signal
import sys
from pathlib import Path

from .computing import compute
from .store import write_whole


def main() -> None:
    """Build what is asked for until the input ends."""
    # Ctrl-C reaches all processes of a terminal; the one that was asked decides.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    answers = sys.stdout
    sys.stdout = sys.stderr  # whatever is printed is no answer
    jobs: dict[str, str] = {}
    for line in sys.stdin:
        job, scene, product = json.loads(line)
        if job not in jobs:
            jobs = {job: Path(job).read_text(encoding="utf-8")}
        reason = unwritten = ""
        try:
            built = compute(jobs[job], Path(scene).read_text(encoding="utf-8")).to_bytes()
            write_whole(Path(product), built)
        except OSError as error:
            unwritten = str(error)
        except Exception as error:
            reason = f"{type(error).__name__}: {error}"
        answers.write(json.dumps([reason, unwritten]) + "\n")
        answers.flush()


if __name__ == "__main__":
    main()
