"""Plane areas and moments, integrals over stations, series of curves."""
