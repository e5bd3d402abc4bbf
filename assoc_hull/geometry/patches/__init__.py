"""Bezier patches: their algebra, their Gaussian curvature, where it changes sign, areas.

From the bottom up: `bernstein_polynomials`, `bezier_patches` and `spline_surface` (the surfaces),
`curvature_functions` (polynomials that have the sign of the curvature), `cells` (parts of a patch
where this sign is known, or changes once), `arcs`, `components` (arcs joined), `areas_by_sign`.
"""
