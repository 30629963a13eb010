"""Chapter 5: rectangles placed by a rule that is learned from a few examples.

Reading order: `examples` (what the user gives), `arrangement` (what surrounds a rectangle), `signature` (its relations,
sections 5.2 and 5.3), `similarity` (adapted SL0 similarity with one-to-one assignment), `regression` (section 5.4),
`candidates` (section 5.5), `evidence` and `calibration` (how sure a candidate is), `selection` (filters of section
5.5), `model` (the public face), `arrays` (section 5.6) and `rule` (the learned rule in words).
"""
