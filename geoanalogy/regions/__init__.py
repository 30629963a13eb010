"""Chapter 3: partial non-rigid matching of the lines of a drawing.

Reading order: `query` (what is matched), `descriptors` and `correspondences` (appendix A), `refinement` (3.4),
`linkage` (3.5), `chains` (with the dynamic programme in `chords`), `alignment` and `groups` (further candidates:
corners and courses of lines, groups that stand by themselves), `candidates` (all of them), `transformation` (functions
that vary slowly over the region), `fitting` and `evidence` (verification on the lines), `marks` (drawings without lines
to follow), `matching` (algorithm 3.1), `view` (appendix B).
"""
