"""Blocks of a hull, each the part of it that one smooth surface is fitted to.

In the order of the work: `block_plan` parts the half hull (`cell_regions`, `end_cuts`), `block_map`
lays each block out on a rectangle, `block_layout` adds its points; `fit_net` fits and joins the
blocks (`fit_options`, `fit_block`), but for what stayed since an earlier surface, and measures them
(`fit_quality`). The result is a `fitted_surface`.
"""
