"""The operations tree: edits recorded as nodes and replayed on other scenes (section 5.6).

Reading order: `element`, what operations place; `layout`, what flows along a link; `keys` and `decisions`, corrections
by hand that survive a replay; `operation`, the interface of all operations, and `placing`, what those share that place
library objects; one file per operation; `table`, their names; `evaluation` and `tree`.
"""
