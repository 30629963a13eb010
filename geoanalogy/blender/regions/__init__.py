"""Similar regions of drawings in Blender: queries, what is carried over, results (chapter 3)."""
