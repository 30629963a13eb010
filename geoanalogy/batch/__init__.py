"""Applying operations trees at the scale of a city: in tiles, by several processes or on a cluster (section 5.7)."""
