"""What the objects of a Blender scene are to the engine: planes, outlines, footprints, arrangements of polygons."""
