"""Surfaces of the shell: regions of Gaussian curvature, plates, how they are formed.

From the bottom up: `zero_band` (what counts as no curvature), `region_options`, `region_areas`,
`region_component` and `region_result` (what is found), `solving` (one batch of patches),
`region_parts` and `previous` (what is kept, and taken from an earlier result), `region_notes`,
`curvature_regions` (the face of all these); plates rest on them.
"""
