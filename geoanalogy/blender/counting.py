"""How many there are of something, as it is told."""


def counted(count: int, noun: str) -> str:
    """A number and what is counted.

    Parameters
    ----------
    count : int
    noun : str
        Of one of them.

    Returns
    -------
    str

    Examples
    --------
    >>> counted(1, "result"), counted(0, "result"), counted(2, "similar region")
    ('1 result', '0 results', '2 similar regions')
    """
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
