"""Chapter 3: partial non-rigid matching of the lines of a drawing.

Reading order: `query` (what is matched), `descriptors` and `correspondences` (appendix A), `refinement` (3.4),
`linkage` (3.5), `chains` (with the dynamic programme in `chords`), `alignment` and `groups` (further candidates:
corners and courses of lines, groups that stand by themselves), `candidates` (all of them), `transformation` (functions
that vary slowly over the region), `least_squares` and `fitting` (to the lines, whose counterparts `growing` continues),
`guides`, `retraced` and `evidence` (what speaks for a fit), `consensus` (what fits of one place agree on), `marks`
(drawings without lines to follow), `standing` (what is shown), `matching` (algorithm 3.1), `view` (appendix B).
"""
