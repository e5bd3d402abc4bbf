"""Plane curves by form parameters: a cubic B-spline of 7 vertices."""
