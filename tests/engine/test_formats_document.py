"""docs/formats.md names every kind of operation, with all its settings."""

import dataclasses
import re
from pathlib import Path

import pytest

from geoanalogy.operations.table import OPERATIONS

DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "formats.md"
ROWS = {
    name: re.findall(r"`(\w+)`", settings)
    for name, settings in re.findall(r"^\| `([\w ]+)` \| ((?:`\w+`,? ?)+)\|$", DOCUMENT.read_text("utf-8"), re.M)
}


def test_every_kind_of_operation_is_described():
    assert sorted(ROWS) == sorted(OPERATIONS)


@pytest.mark.parametrize("name", OPERATIONS)
def test_all_settings_are_named(name):
    assert sorted(ROWS[name]) == sorted(f.name for f in dataclasses.fields(OPERATIONS[name]))
