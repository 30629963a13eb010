"""Options: values that a user may set, each with its default and the one rule by which it is read.

A class of options is a frozen dataclass derived from `Options` whose fields are made by `option`. What is given is read
when the options are made, so that the engine finds plain numbers, texts and lists; what cannot be used is named in one
sentence: the option, what was given, what is wanted.
"""

from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, ClassVar, Self

from .arguments import given
from .errors import InputError

#: Reads a value: takes it, what it is called in messages, and limits; returns it as plain data or raises InputError.
Reader = Callable[..., Any]


def option(default: Any, read: Reader, *limits: Any) -> Any:
    """A field of a class of options.

    Parameters
    ----------
    default : object
    read : callable
        Such as `geoanalogy.arguments.number`, or what `optional` and `each` make.
    *limits : object
        What `read` takes after the value and its name.

    Returns
    -------
    dataclasses.Field
    """
    metadata = {"read": lambda value, name: read(value, name, *limits)}
    if isinstance(default, dict):
        return field(default_factory=default.copy, metadata=metadata)
    return field(default=default, metadata=metadata)


def optional(read: Reader, *limits: Any) -> Reader:
    """The reader of an option that may be None.

    Parameters
    ----------
    read : callable
        Reads it where it is not.
    *limits : object
        What `read` takes after the value and its name.

    Returns
    -------
    callable
    """
    return lambda value, name: None if value is None else read(value, name, *limits)


def each(remedy: str, read: Reader, *limits: Any) -> Reader:
    """The reader of an option that maps names to values.

    Parameters
    ----------
    remedy : str
        What to give, in messages.
    read : callable
        Reads each value.
    *limits : object
        What `read` takes after the value and its name.

    Returns
    -------
    callable
    """

    def read_all(value: Any, name: str) -> dict[str, Any]:
        plain = given(value, Mapping, name, remedy)
        return {str(key): read(one, f"{name} of {key!r}", *limits) for key, one in plain.items()}

    return read_all


@dataclass(frozen=True)
class Options:
    """What classes of options have in common.

    Raises
    ------
    InputError
        For a value that an option cannot take.
    """

    #: What the options are of, in messages.
    subject: ClassVar[str]

    def __post_init__(self) -> None:
        for f in fields(self):
            object.__setattr__(self, f.name, f.metadata["read"](getattr(self, f.name), f"the option {f.name}"))

    def to_dict(self) -> dict[str, Any]:
        """What differs from the defaults, as plain data.

        Returns
        -------
        dict
        """
        plain = {}
        for f in fields(self):
            default = f.default if f.default_factory is MISSING else f.default_factory()
            if (value := getattr(self, f.name)) != default:
                plain[f.name] = _plain(value)
        return plain

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> Self:
        """The options that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        Options
            Of the class that is asked.

        Raises
        ------
        InputError
            For a name that is no option, and for a value that it cannot take.
        """
        given(plain, Mapping, f"what is stored as options of {cls.subject}", "names and values")
        unknown = ", ".join(sorted(str(k) for k in set(plain) - {f.name for f in fields(cls)}))
        if unknown:
            raise InputError(f"{unknown} is no option of {cls.subject}; it may come from a newer version")
        return cls(**plain)


def _plain(value: Any) -> Any:
    """A value as JSON has it."""
    if isinstance(value, Mapping):
        return {key: _plain(one) for key, one in value.items()}
    return [_plain(one) for one in value] if isinstance(value, list | tuple) else value
