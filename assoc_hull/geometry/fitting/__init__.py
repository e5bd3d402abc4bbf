"""Spline surfaces fitted to points: penalised least squares, foot points, knots, joints.

Knows no ship: points with parameters and weights come in, a `SplineSurface` goes out.
"""
