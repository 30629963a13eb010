"""Skyscrapers as in New York (figures 5.1 and 5.6): mass, base, middle and top recorded apart and grown together."""
