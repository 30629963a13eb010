"""Open a file in a Blender that has no add-on, look at it, and save it again.

python tests/blender/without_the_add_on.py IN.blend OUT.blend RESULT.json
"""

import json
import os
import sys
from pathlib import Path

import bpy

source, target, said = sys.argv[-3:]
bpy.ops.wm.open_mainfile(filepath=source)
(tree,) = [group for group in bpy.data.node_groups if "operation" in (group.nodes[0] if len(group.nodes) else {})]
result = {
    "registered": hasattr(bpy.types.Scene, "geoanalogy"),
    "types": sorted(node["operation"]["type"] for node in tree.nodes),
    "links": len(tree.links),
    "objects": sorted(item.name for item in bpy.data.objects if "ga_key" in item),
}
bpy.ops.wm.save_as_mainfile(filepath=target)
Path(said).write_text(json.dumps(result))
sys.stdout.flush()
# The bpy module may crash while Python shuts down, when all is done.
os._exit(0)
