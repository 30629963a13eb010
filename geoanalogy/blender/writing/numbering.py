"""Names of results: what they are results of, and a number."""

import bpy


def name_result(made: bpy.types.Object, base: str, number: int, count: int) -> None:
    """Name one of several results.

    Blender keeps objects in the order of their names and goes through them from the last one on; and it looks for an
    object among all when its name is assigned, though not when it is renamed. With names that come in their order, each
    of ten thousand takes no longer than each of ten.

    Parameters
    ----------
    made : bpy.types.Object
    base : str
        What the results are called.
    number : int
        Its own, from 1 on.
    count : int
        How many results there are.
    """
    digits = max(3, len(str(count)))
    made.rename(f"{base} {number:0{digits}d}")
