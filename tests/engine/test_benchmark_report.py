"""The report of the benchmarks: tables are put where they belong, and nothing else is touched."""

import pytest

from benchmarks.__main__ import REPORT, names, with_tables
from benchmarks.measuring import Table, duration, peak_megabytes, seconds, times

TEXT = "# Report\n\nProse.\n\n<!-- a -->\nold\n<!-- /a -->\n\nMore.\n\n<!-- b -->\nkept\n<!-- /b -->\n"


def test_tables_replace_those_between_the_marks():
    report = with_tables(TEXT, "a", "| new \\1 |\n")
    assert report == TEXT.replace("<!-- a -->\nold\n", "<!-- a -->\n\n| new \\1 |\n\n")
    assert with_tables(report, "a", "| new \\1 |") == report


def test_tables_without_a_place_come_last():
    assert with_tables(TEXT, "c", "| c |").endswith("kept\n<!-- /b -->\n\n## c\n\n<!-- c -->\n\n| c |\n\n<!-- /c -->\n")
    assert with_tables("", "c", "| c |") == "## c\n\n<!-- c -->\n\n| c |\n\n<!-- /c -->\n"


def test_every_benchmark_has_a_place_in_the_report():
    text = REPORT.read_text("utf-8")
    assert {"poses_grid", "poses_growth", "poses_quality", "poses_speed"} <= set(names())
    for name in names():
        assert text.count(f"<!-- {name} -->") == text.count(f"<!-- /{name} -->") == 1


def test_a_table_is_written_with_aligned_columns():
    table = Table("Title", ("name", "n"), [("a", 10), ("longer", 2)], "Note.")
    assert table.markdown().splitlines() == [
        "### Title",
        "",
        "Note.",
        "",
        "| name   | n  |",
        "|--------|----|",
        "| a      | 10 |",
        "| longer | 2  |",
    ]


def test_runs_are_prepared_and_end_early_where_they_take_long(monkeypatch):
    clock = iter(range(1000))
    monkeypatch.setattr("benchmarks.measuring.time.perf_counter", lambda: float(next(clock)))
    done = []
    assert seconds(lambda: done.append("work"), runs=5, prepare=lambda: done.append("prepare")) == 1.0
    assert done == ["prepare", "work"] * 2


@pytest.mark.parametrize(
    ("value", "text"), [(0.0012, "1.2 ms"), (0.0834, "83 ms"), (0.9, "900 ms"), (1.234, "1.2 s"), (61.7, "62 s")]
)
def test_durations_are_readable(value, text):
    assert duration(value) == text


def test_ratios_and_memory():
    assert times(3.0, 2.0) == "1.5 ×"
    assert times(30.0, 1.0) == "30 ×"
    assert peak_megabytes(lambda: bytearray(3_000_000)) == pytest.approx(3.0, rel=0.01)
