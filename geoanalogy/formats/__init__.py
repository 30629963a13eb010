"""Files: GeoJSON, SVG and DXF in, labelled polygons out."""
