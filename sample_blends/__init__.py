"""The scenes of the thesis (figures 4.10 to 4.12): their plans, their assets and the scripts that build them."""
