"""Plates of a hull: what lies between butts and seams, with what is sure of its curvature."""
