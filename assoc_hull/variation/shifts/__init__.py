"""Sections shifted along the ship, and hulls swung, at asked coefficients."""
