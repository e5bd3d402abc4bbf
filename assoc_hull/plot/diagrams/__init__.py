"""Diagrams over numbers: hydrostatics, stability, form curves, form parameters, drivers."""
