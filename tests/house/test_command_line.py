"""The batch program without Blender: its arguments, its exit codes, its progress lines."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from geoanalogy import Cancelled, InputError
from geoanalogy.command_line import ExitCode, ProgressLines, main

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def replay(monkeypatch, tmp_path):
    """A replay that records how it was called and does what the test says."""
    calls = []

    def replay_file(source, **options):
        calls.append((source, options))
        record.action(options)
        return SimpleNamespace(operations=3, objects=17, problems=("the library lacks a door",))

    def write(options):
        for key in ("output", "render"):
            if options[key]:
                options[key].write_bytes(b"written")

    record = SimpleNamespace(calls=calls, action=write, write=write)
    monkeypatch.setitem(sys.modules, "geoanalogy.blender.tree.replay", SimpleNamespace(replay_file=replay_file))
    monkeypatch.chdir(tmp_path)
    return record


def test_a_replay_says_what_it_made_and_where(replay, tmp_path, capsys):
    arguments = [
        "replay",
        "in.blend",
        "--output",
        "out.blend",
        "--render",
        "out.png",
        "--seed",
        "7",
        "--threshold",
        "0.4",
    ]
    assert main(arguments) == ExitCode.DONE
    ((source, options),) = replay.calls
    assert source == tmp_path / "in.blend"
    assert options.pop("progress")(0.5, "half") is True
    assert options == {"output": tmp_path / "out.blend", "render": tmp_path / "out.png", "seed": 7, "threshold": 0.4}
    said = capsys.readouterr()
    assert said.out.splitlines() == [
        "3 operations replayed, 17 objects made",
        "the library lacks a door",
        f"wrote {tmp_path / 'out.blend'}",
        f"wrote {tmp_path / 'out.png'}",
    ]
    assert said.err == "[ 50%] half\n"


def test_without_a_file_the_open_one_is_replayed(replay):
    assert main(["replay", "--output", "out.blend"]) == ExitCode.DONE
    assert replay.calls[0][0] is None
    assert replay.calls[0][1]["seed"] is None
    assert replay.calls[0][1]["threshold"] is None


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "the following arguments are required: COMMAND"),
        (["replya"], "invalid choice: 'replya'"),
        (["replay", "in.blend"], "replay needs --output, --render or both"),
        (["replay", "in.obj", "--output", "out.blend"], "in.obj should end in .blend"),
        (["replay", "in.blend", "--output", "out.png"], "out.png should end in .blend"),
        (["replay", "in.blend", "--render", "out.blend"], "out.blend should end in .png"),
        (["replay", "in.blend", "--output", "o.blend", "--threshold", "1.5"], "1.5 should be a number between 0 and 1"),
        (
            ["replay", "in.blend", "--output", "o.blend", "--threshold", "high"],
            "high should be a number between 0 and 1",
        ),
        (["replay", "in.blend", "--output", "o.blend", "--seed", "x"], "invalid int value: 'x'"),
    ],
)
def test_wrong_usage_is_code_2(replay, capsys, arguments, message):
    assert main(arguments) == ExitCode.USAGE == 2
    assert message in capsys.readouterr().err
    assert replay.calls == []


def test_help_is_no_error(capsys):
    assert main(["--help"]) == ExitCode.DONE == 0
    assert "3 bad input" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("error", "code", "message"),
    [
        (InputError("rooms.blend holds no operations."), 3, "rooms.blend holds no operations."),
        (Cancelled("placing"), 4, "cancelled; nothing was written"),
        (KeyboardInterrupt(), 4, "cancelled; nothing was written"),
        (OSError("cannot write out.blend: the disk is full."), 5, "the disk is full"),
        (ZeroDivisionError("division by zero"), 1, "ZeroDivisionError: division by zero"),
        (ModuleNotFoundError("No module named 'bpy'", name="bpy"), 3, "the module bpy is missing: install the bpy"),
        (ModuleNotFoundError("No module named 'own'", name="own"), 1, "No module named 'own'"),
    ],
)
def test_every_failure_has_its_code_and_says_why(replay, capsys, error, code, message):
    def fail(options):
        raise error

    replay.action = fail
    assert main(["replay", "in.blend", "--output", "out.blend"]) == code
    said = capsys.readouterr()
    assert message in said.err
    assert said.out == ""


def test_a_missing_folder_is_found_before_the_work(replay, capsys):
    assert main(["replay", "in.blend", "--output", "nowhere/out.blend"]) == ExitCode.WRITE_FAILED == 5
    assert "nowhere/out.blend: its folder does not exist." in capsys.readouterr().err
    assert replay.calls == []


def test_a_folder_in_the_way_is_found_before_the_work(replay, tmp_path, capsys):
    (tmp_path / "out.png").mkdir()
    assert main(["replay", "in.blend", "--render", "out.png"]) == ExitCode.WRITE_FAILED
    assert "out.png: it may not be written." in capsys.readouterr().err
    assert replay.calls == []


def test_a_result_that_blender_did_not_write_is_a_failure(replay, tmp_path, capsys):
    (tmp_path / "out.blend").write_bytes(b"of the run before")
    replay.action = lambda options: None
    assert main(["replay", "in.blend", "--output", "out.blend"]) == ExitCode.WRITE_FAILED
    assert "out.blend: Blender left no file there." in capsys.readouterr().err


def test_the_scene_may_be_replayed_onto_itself(replay, tmp_path):
    (tmp_path / "in.blend").write_bytes(b"scene")

    def read_then_write(options):
        assert (tmp_path / "in.blend").read_bytes() == b"scene"
        replay.write(options)

    replay.action = read_then_write
    assert main(["replay", "in.blend", "--output", "in.blend"]) == ExitCode.DONE


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_cancels_between_two_steps(replay, number):
    before = signal.getsignal(number)

    def work(options):
        assert options["progress"](0.1, "first step") is True
        os.kill(os.getpid(), number)
        if not options["progress"](0.2, "second step"):
            raise Cancelled("second step")
        replay.write(options)

    replay.action = work
    assert main(["replay", "in.blend", "--output", "out.blend"]) == ExitCode.CANCELLED == 4
    assert signal.getsignal(number) is before


def test_a_second_signal_insists(replay):
    def stuck(options):
        os.kill(os.getpid(), signal.SIGINT)
        os.kill(os.getpid(), signal.SIGINT)
        raise AssertionError("the second signal should have ended this")

    replay.action = stuck
    assert main(["replay", "in.blend", "--output", "out.blend"]) == ExitCode.CANCELLED


STUCK = """
import hashlib, os, sys, threading, types
from pathlib import Path
def replay_file(source, **options):
    Path(f"out.{os.getpid()}.part.blend").write_bytes(b"begun")
    threading.Timer(1.0, os.kill, (os.getpid(), int(sys.argv[1]))).start()
    hashlib.pbkdf2_hmac("sha256", b"", b"", 10**8)
sys.modules["geoanalogy.blender.tree.replay"] = types.SimpleNamespace(replay_file=replay_file)
from geoanalogy import command_line
command_line.PATIENCE = 0.2
sys.exit(command_line.main(["replay", "in.blend", "--output", "out.blend"]))
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_that_one_long_step_keeps_from_being_noticed_ends_it(tmp_path, number):
    program = [sys.executable, "-c", STUCK, str(int(number))]
    paths = {**os.environ, "PYTHONPATH": str(ROOT)}
    ended = subprocess.run(program, cwd=tmp_path, env=paths, capture_output=True, text=True)
    assert ended.returncode == ExitCode.CANCELLED
    assert "cancelled; what was not finished is not written" in ended.stderr
    assert list(tmp_path.iterdir()) == []


def test_progress_repeats_no_line_and_stays_within_the_scale(capsys):
    progress = ProgressLines()
    for fraction in (-0.1, 0.0, 0.001, 0.5, 1.2):
        progress(fraction, "placing")
    assert capsys.readouterr().err.splitlines() == ["[  0%] placing", "[ 50%] placing", "[100%] placing"]


@pytest.mark.parametrize(("before", "after"), [(["--quiet"], []), ([], ["--quiet"])])
def test_quiet_prints_no_progress(replay, capsys, before, after):
    replay.action = lambda options: (options["progress"](0.5, "half"), replay.write(options))
    assert main([*before, "replay", "in.blend", "--output", "out.blend", *after]) == ExitCode.DONE
    assert capsys.readouterr().err == ""


def test_batch_py_passes_the_exit_code_on(tmp_path):
    done = subprocess.run(
        [sys.executable, str(ROOT / "batch.py"), "replay", "in.blend", "--output", "nowhere/out.blend"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 5
    assert "its folder does not exist" in done.stderr


def test_batch_py_takes_what_follows_two_dashes(tmp_path):
    done = subprocess.run(
        [sys.executable, str(ROOT / "batch.py"), "ignored", "--", "replay", "in.blend"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2
    assert "replay needs --output, --render or both" in done.stderr
