"""Single-example propagation of poses (chapter 4).

Reading order: `pose` and `options`; `query`, what the example says; `matching`, which features answer it;
`importance`, how well a pose answers it; `candidates` (the accumulation on grids), `refinement`, `validation`;
`propagate`, which puts them together; then the applications of sections 4.7 and 4.8: `arrays`, `local_coordinates`,
`selection`, `scatter`.
"""
