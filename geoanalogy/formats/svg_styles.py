"""The little of CSS that decides what a drawing shows: what is hidden, and what is filled."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_RULE = re.compile(r"([^{}]+)\{([^{}]*)\}")
_SELECTOR = re.compile(r"([a-zA-Z]*|\*)(?:([.#])([\w-]+))?")
_PROPERTIES = ("display", "visibility", "fill")


@dataclass(frozen=True)
class Style:
    """What an element inherits.

    Attributes
    ----------
    gone : bool
        Whether neither it nor anything in it is shown.
    hidden : bool
        Whether it is not shown; what is in it may say otherwise.
    filled : bool
        Whether its shapes are areas; unfilled ones are lines.
    """

    gone: bool = False
    hidden: bool = False
    filled: bool = True


class StyleSheet:
    """The rules of a file's style elements, as far as they name elements, classes and ids.

    Parameters
    ----------
    texts : iterable of str
        Their contents.
    """

    def __init__(self, texts: Iterable[str]) -> None:
        rules: list[tuple[int, int, str, str | None, str | None, dict[str, str]]] = []
        for text in texts:
            for selectors, body in _RULE.findall(_COMMENT.sub("", text)):
                declared = _declarations(body)
                for selector in selectors.split(","):
                    match = _SELECTOR.fullmatch(selector.strip())
                    if match and declared:
                        rank = ("", ".", "#").index(match[2] or "")
                        rules.append((rank, len(rules), match[1], match[2], match[3], declared))
        self._rules = sorted(rules, key=lambda rule: rule[:2])

    def style(self, tag: str, attributes: Mapping[str, str], inherited: Style) -> Style:
        """The style of an element.

        Parameters
        ----------
        tag : str
        attributes : mapping
        inherited : Style
            Of the group around it.

        Returns
        -------
        Style
        """
        values = {name: attributes[name].strip() for name in _PROPERTIES if name in attributes}
        classes = attributes.get("class", "").split()
        for _, _, name, kind, key, declared in self._rules:
            named = key in classes if kind == "." else key == attributes.get("id") if kind == "#" else True
            if name in ("", "*", tag) and named:
                values |= declared
        values |= _declarations(attributes.get("style", ""))
        style = inherited
        if values.get("display") == "none":
            style = replace(style, gone=True)
        if values.get("visibility", "inherit") != "inherit":
            style = replace(style, hidden=values["visibility"] in ("hidden", "collapse"))
        if values.get("fill", "inherit") != "inherit":
            style = replace(style, filled=values["fill"] not in ("none", "transparent"))
        return style


def _declarations(text: str) -> dict[str, str]:
    pairs = (part.partition(":") for part in text.split(";"))
    values = {name.strip(): value.replace("!important", "").strip() for name, _, value in pairs}
    return {name: values[name] for name in _PROPERTIES if name in values}
