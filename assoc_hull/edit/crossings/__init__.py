"""Crossings of lines: how they come, go and touch, and the points that stand in for them."""
