"""Chapter 3: partial non-rigid matching of the lines of a drawing.

Reading order: `query` (what is matched), `descriptors` and `correspondences` (appendix A), `refinement` (3.4),
`linkage` (3.5), `alignment` and `groups` (further candidates: whole courses of lines, groups that stand by
themselves), `transformation` (functions that vary slowly over the region), `fitting` and `evidence` (verification on
the lines), `matching` (algorithm 3.1), `view` (appendix B).
"""
