"""The tags of ASCII DXF: a file as its header, layers, blocks and entities."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from ..errors import InputError

Tag = tuple[int, str]

#: The last version whose files are known (AutoCAD 2018 and later).
_NEWEST = "AC1032"

#: A letter by its number; halves of pairs are none.
_NUMBERED_LETTER = re.compile(r"\\U\+(?![dD][89a-fA-F])([0-9a-fA-F]{4})")


@dataclass
class Entity:
    """One entity.

    Attributes
    ----------
    kind : str
        "LINE", "LWPOLYLINE" …
    tags : list of (int, str)
    vertices : list of Entity
        Those of a POLYLINE.
    """

    kind: str
    tags: list[Tag] = field(default_factory=list)
    vertices: list["Entity"] = field(default_factory=list)

    def text(self, code: int, default: str = "") -> str:
        """The first value of a group code.

        Parameters
        ----------
        code : int
        default : str

        Returns
        -------
        str
        """
        return next((value for c, value in self.tags if c == code), default)

    def number(self, code: int, default: float = 0.0) -> float:
        """The first value of a group code, as a number.

        Parameters
        ----------
        code : int
        default : float

        Returns
        -------
        float

        Raises
        ------
        ValueError
            Where it is none.
        """
        text = self.text(code, "")
        return as_number(text) if text.strip() else default

    def numbers(self, code: int) -> list[float]:
        """All values of a group code, as numbers.

        Parameters
        ----------
        code : int

        Returns
        -------
        list of float

        Raises
        ------
        ValueError
            Where one is none.
        """
        return [as_number(value) for c, value in self.tags if c == code]

    @property
    def layer(self) -> str:
        """The layer that the entity is on."""
        return self.text(8, "0")


@dataclass
class Drawing:
    """What a file holds.

    Attributes
    ----------
    header : dict
        The first value of each variable: ``header["$INSUNITS"]``.
    hidden_layers : set of str
        Layers that are off or frozen, in small letters: names count whatever the case of their letters.
    blocks : dict
        Name in small letters to the block's BLOCK entity and its entities.
    entities : list of Entity
    """

    header: dict[str, str] = field(default_factory=dict)
    hidden_layers: set[str] = field(default_factory=set)
    blocks: dict[str, tuple[Entity, list[Entity]]] = field(default_factory=dict)
    entities: list[Entity] = field(default_factory=list)


def as_number(text: str) -> float:
    """A number of a tag.

    Parameters
    ----------
    text : str

    Returns
    -------
    float

    Raises
    ------
    ValueError
        For text that is none.
    """
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{text.strip()[:30]!r} is no number")
    return number


def parse(content: bytes, file: str) -> Drawing:
    """The drawing of a DXF file.

    Parameters
    ----------
    content : bytes
    file : str
        The file's name, for messages.

    Returns
    -------
    Drawing

    Raises
    ------
    InputError
        For files that are binary, cut off, too new, or no DXF.
    """
    if content.startswith(b"AutoCAD Binary DXF"):
        raise InputError(f"{file} is a binary DXF; save it as an ASCII DXF")
    if content.startswith(b"AC10"):
        raise InputError(f"{file} is a DWG drawing; save it as an ASCII DXF")
    drawing = Drawing()
    section = ""
    ended = False
    variable = ""
    block: list[Entity] | None = None
    for entity in _entities(content, file):
        if entity.kind == "SECTION":
            section = entity.text(2).strip()
            if section == "HEADER":
                for code, value in entity.tags:
                    if code == 9:
                        variable = value.strip()
                    elif variable:
                        drawing.header.setdefault(variable, value.strip())
        elif entity.kind == "ENDSEC":
            section = ""
        elif entity.kind == "EOF":
            ended = True
        elif section == "TABLES" and entity.kind == "LAYER":
            _note_layer(entity, drawing, file)
        elif section == "BLOCKS" and entity.kind == "BLOCK":
            block = drawing.blocks.setdefault(entity.text(2).casefold(), (entity, []))[1]
        elif section == "BLOCKS" and entity.kind == "ENDBLK":
            block = None
        elif section == "BLOCKS" and block is not None:
            _add(entity, block)
        elif section == "ENTITIES":
            _add(entity, drawing.entities)
    if not ended:
        raise InputError(f"{file} ends without EOF, so it is cut off or no DXF; export it again")
    version = drawing.header.get("$ACADVER", _NEWEST)
    if version.startswith("AC") and version > _NEWEST:
        raise InputError(f"{file} has the DXF version {version}, newer than {_NEWEST}; save it as DXF of 2018 or older")
    return drawing


def _entities(content: bytes, file: str) -> Iterator[Entity]:
    """Everything that starts with a tag 0, with the tags up to the next."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = content.decode("cp1252", errors="replace")  # before 2007 each country had its own
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    entity = None
    for at in range(0, len(lines) - 1, 2):
        try:
            code = int(lines[at])
        except ValueError:
            raise InputError(
                f"{file}, line {at + 1}: {lines[at].strip()[:30]!r} is no group code of an ASCII DXF; export it again"
            ) from None
        if code == 0:
            if entity is not None:
                yield entity
            entity = Entity(lines[at + 1].strip())
        elif entity is not None:
            entity.tags.append((code, _spelled(lines[at + 1])))
    if entity is not None:
        yield entity


def _spelled(text: str) -> str:
    r"""A value with its letters in place of their numbers: before 2007 ``\U+00FC`` stood for what a country lacked."""
    return _NUMBERED_LETTER.sub(lambda found: chr(int(found[1], 16)), text) if "\\U+" in text else text


def _note_layer(entity: Entity, drawing: Drawing, file: str) -> None:
    try:
        if int(entity.number(70)) & 1 or entity.number(62) < 0:
            drawing.hidden_layers.add(entity.text(2).casefold())
    except (ValueError, OverflowError) as error:
        raise InputError(f"{file}, layer {entity.text(2)!r}: {error}; export it again") from None


def _add(entity: Entity, entities: list[Entity]) -> None:
    """Put an entity where it belongs: the vertices of a polyline follow it."""
    if entity.kind == "VERTEX" and entities and entities[-1].kind == "POLYLINE":
        entities[-1].vertices.append(entity)
    elif entity.kind != "SEQEND":
        entities.append(entity)
