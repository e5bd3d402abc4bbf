"""Bezier patches: their algebra, their Gaussian curvature, where it changes sign, areas.

From the bottom up: `algebra` (polynomials of two parameters), `patches` (the surfaces),
`curvature_functions` (polynomials that have the sign of the curvature), `cells` (parts of a patch
where this sign is known, or changes once), arcs, their joining, areas.
"""
