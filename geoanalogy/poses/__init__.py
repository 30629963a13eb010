"""Single-example propagation of poses (chapter 4).

Reading order: `pose` and `options`; `query`, what the example says; `matching`, which features answer it;
`importance`, how well a pose answers it; `candidates` (the accumulation on grids), `refinement`, `validation`;
`propagate`, which puts them together; then the applications of sections 4.7 and 4.8: `offset_path` and `arrays`;
`local_coordinates`, `correspondence`, `local_mapping` and `group_transfer`; `selection`; `scatter`.
"""
