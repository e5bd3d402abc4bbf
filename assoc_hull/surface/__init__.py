"""Surfaces of a hull: from the net to cells, fitted blocks, regions of curvature and plates.

`cells` divides the net into faces and closes the mesh; `blocks` fits spline surfaces to its lines;
`regions` finds where the Gaussian curvature of surfaces has which sign; `plating` cuts surfaces and
hulls into shell plates and says how each may be formed. What the package offers to users is filled
in by `assoc_hull`.
"""
