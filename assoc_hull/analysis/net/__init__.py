"""From the lines of a hull to a surface through them, for everything that is integrated.

`curve_net` takes curves and crossings from the tables, `strip_boundaries` finds what bounds the
hull between two sections, `strip_anchors` the lines that run along such a strip, and
`surface_layout` puts both together for `assoc_hull.geometry.surfaces.coons`.
"""
