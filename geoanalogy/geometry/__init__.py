"""Polygons, segments and corners, the containment hierarchy of a scene, rectangles, the contours of drawings."""
