"""From the lines of a hull to a surface through them, for everything that is integrated.

`gather` takes curves and crossings from the tables, `slabs` cuts the boundary curves where
sections stand, `loops` finds what bounds the hull between two sections, `anchors` the lines that
run along it, and `cells` puts strips together for `assoc_hull.geometry.surfaces.coons`.
"""
