"""Plain data (what JSON can hold) as nested custom properties, and back.

Custom properties know neither None, nor lists of unlike things, nor long keys: such parts are kept as JSON text behind
a mark. Everything else can be read, and changed, by anybody who looks at the properties.
"""

import json
from typing import Any

#: What text begins with that is JSON.
MARK = "json:"

#: Longest key of a custom property in bytes.
LONGEST_KEY = 60

#: Whole numbers of custom properties have 32 bits.
LARGEST_WHOLE = 2**31 - 1


def to_property(value: Any) -> Any:
    """A value as a custom property takes it.

    Parameters
    ----------
    value : object
        Plain data.

    Returns
    -------
    object
    """
    if isinstance(value, dict) and value and all(0 < len(str(key).encode()) <= LONGEST_KEY for key in value):
        return {str(key): to_property(part) for key, part in value.items()}
    if isinstance(value, bool | float):
        return value
    if isinstance(value, int) and abs(value) <= LARGEST_WHOLE:
        return value
    if isinstance(value, str) and not value.startswith(MARK):
        return value
    if isinstance(value, list) and value and all(isinstance(part, float) for part in value):
        return value
    return MARK + json.dumps(value, ensure_ascii=False, allow_nan=False)


def from_property(value: Any) -> Any:
    """The inverse of `to_property`.

    Parameters
    ----------
    value : object
        A custom property.

    Returns
    -------
    object
    """
    if hasattr(value, "items"):
        return {key: from_property(part) for key, part in value.items()}
    if isinstance(value, str):
        return json.loads(value[len(MARK) :]) if value.startswith(MARK) else value
    if hasattr(value, "to_list"):
        return value.to_list()
    return value
