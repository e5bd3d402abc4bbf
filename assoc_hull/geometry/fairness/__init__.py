"""Fairness of curves: criteria, inflections, curvature combs."""
