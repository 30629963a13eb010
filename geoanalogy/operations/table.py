"""THE table of operations: their names in files and menus, and their classes. Another kind becomes a row here."""

from .array_placement import ArrayPlacement
from .boolean import Boolean
from .choice_placement import ChoicePlacement
from .extrusion import Extrusion
from .group_placement import GroupPlacement
from .operation import Operation
from .pose_placement import PosePlacement
from .rectangle_placement import RectanglePlacement
from .region_transfer import RegionTransfer
from .scatter_placement import ScatterPlacement
from .selection import Selection

#: Every kind of operation by its name.
OPERATIONS: dict[str, type[Operation]] = {
    kind.type: kind
    for kind in (
        PosePlacement,
        ArrayPlacement,
        GroupPlacement,
        ScatterPlacement,
        ChoicePlacement,
        RectanglePlacement,
        Extrusion,
        Boolean,
        Selection,
        RegionTransfer,
    )
}
