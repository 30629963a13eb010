"""Labels with numbers as a user types them into one line: "door 0.9, coffee table 0.3"."""

import math

from ..errors import InputError

#: What stands between two pairs, and may stand between a label and its number.
BETWEEN_PAIRS = ","
BEFORE_NUMBER = ":="


def read_pairs(text: str, what: str) -> dict[str, float]:
    """The numbers by their labels.

    Parameters
    ----------
    text : str
        Pairs with commas between them; a pair is a label, which may have spaces, and a number of at least 0.
    what : str
        What the line holds, for the message.

    Returns
    -------
    dict of str to float

    Raises
    ------
    InputError
        For a pair without a label or a number, a negative number, and a label that comes twice.
    """
    found: dict[str, float] = {}
    for pair in filter(None, map(str.strip, text.split(BETWEEN_PAIRS))):
        *words, last = pair.translate(dict.fromkeys(map(ord, BEFORE_NUMBER), " ")).split()
        label = " ".join(words)
        try:
            number = float(last)
        except ValueError:
            number = math.nan
        if not label or not 0 <= number < math.inf:
            raise InputError(f"the {what} '{pair}' cannot be read; write a label and a number, as in 'door 0.9'")
        if label in found:
            raise InputError(f"the {what} of '{label}' is given twice; keep one of them")
        found[label] = number
    return found


def read_counts(text: str, what: str) -> dict[str, int]:
    """The whole numbers by their labels.

    Parameters
    ----------
    text : str
        As in `read_pairs`.
    what : str
        What the line holds, for the message.

    Returns
    -------
    dict of str to int

    Raises
    ------
    InputError
        As in `read_pairs`, and for a number that is not whole.
    """
    found = read_pairs(text, what)
    for label, number in found.items():
        if number != int(number):
            raise InputError(f"the {what} of '{label}' is {number:g}; give a whole number")
    return {label: int(number) for label, number in found.items()}
