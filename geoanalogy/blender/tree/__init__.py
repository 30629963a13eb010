"""The operations tree of a Blender scene: its nodes, what is recorded into them, and what evaluating them gives."""
