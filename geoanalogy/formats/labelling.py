"""Labels from the tags of maps: a table that may be edited, or replaced by another."""

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..errors import InputError

#: The table that is used where no other is given.
TABLE = Path(__file__).with_name("labels.json")

SCHEMA = "geoanalogy.labels/1"

#: A property, its value ("*": any but "no"), and the label that it stands for ("*": the value itself).
Rule = tuple[str, str, str]


def read_table(path: str | os.PathLike[str] = TABLE) -> tuple[Rule, ...]:
    """The rules of a table.

    Parameters
    ----------
    path : str or path-like
        JSON: ``{"schema": "geoanalogy.labels/1", "rules": [[property, value, label], …]}``.

    Returns
    -------
    tuple of (str, str, str)

    Raises
    ------
    InputError
        Names the file and what is wrong with it.
    """
    path = Path(path)
    try:
        plain = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path} cannot be read ({error.strerror}); check the name and the folder") from None
    except ValueError as error:
        raise InputError(f"{path.name} is not valid JSON ({error}); correct it") from None
    if not isinstance(plain, dict) or plain.get("schema") != SCHEMA:
        raise InputError(f'{path.name} is no table of labels; it should begin with "schema": "{SCHEMA}"')
    rules: Any = plain.get("rules")
    if not isinstance(rules, list):
        raise InputError(f'{path.name} has no list of "rules"; give rows of [property, value, label]')
    for k, rule in enumerate(rules):
        if not isinstance(rule, list) or len(rule) != 3 or not all(isinstance(text, str) for text in rule):
            raise InputError(f"{path.name}, rule {k + 1}: it is no row of three texts; give [property, value, label]")
    return tuple((name, value, label) for name, value, label in rules)


def label_by(rules: Sequence[Rule], properties: Mapping[str, Any]) -> str:
    """The label that the first rule that fits gives.

    Parameters
    ----------
    rules : sequence of (str, str, str)
    properties : mapping
        Of a feature.

    Returns
    -------
    str
        "" where none fits.
    """
    for name, value, label in rules:
        given = properties.get(name)
        if given is None or isinstance(given, bool | list | dict) or str(given) in ("", "no"):
            continue
        if value in ("*", str(given)):
            return str(given) if label == "*" else label
    return ""
