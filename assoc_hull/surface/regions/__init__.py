"""Regions of Gaussian curvature of surfaces: search, level lines, areas, result."""
