"""Furnished interiors on demand: a storey of a building that an operations tree has made is divided and furnished."""
