"""Derivatives of hydrostatics by position, points and deformations."""
