"""The empty plans of the sample scenes as plain numbers: they import without Blender."""
