"""Targets of outputs reached by free parameters: Newton's method on hulls."""
