"""THE table of operations: their names in files and menus, and their classes. Another kind becomes a row here."""

from .operation import Operation
from .pose_placement import PosePlacement

#: Every kind of operation by its name.
OPERATIONS: dict[str, type[Operation]] = {kind.type: kind for kind in (PosePlacement,)}
