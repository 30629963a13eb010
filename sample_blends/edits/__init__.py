"""The edits of the sample scenes as data: which asset is put where by hand, and how it is propagated."""
