"""The studies of section 4.9: small scenes as plain data, the engine run on them, and what came out.

A file per figure of the thesis. `furnishing` and `heat` are what they share; nothing here draws: that is
`benchmarks.figures`.
"""
