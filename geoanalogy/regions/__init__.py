"""Chapter 3: partial non-rigid matching of the lines of a drawing.

Reading order: `query` (what is matched), `alignment` (courses of whole lines), `transformation` (functions that vary
slowly over the region), `fitting` and `evidence` (verification), `matching` (algorithm 3.1).
"""
