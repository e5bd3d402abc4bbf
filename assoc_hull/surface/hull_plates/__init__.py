"""Plates of a hull: what lies between butts and seams, with what is sure of its curvature.

`hull_plates` is what is called. `hull_seams` says where to cut, `shell` makes the surface ready
(`girth`, `margins`, `level_table`), `tally` and `cut_areas` give areas, `plate_nodes` the nodes
within. `other_fits` makes other surfaces of the same net, `rivals` compares curvature with them,
`doubt` sums it up by the plate; `judging` puts a `hull_plate` together, a row of
`hull_plate_table`.
"""
