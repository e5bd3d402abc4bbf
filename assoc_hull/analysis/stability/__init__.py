"""Stability: righting levers, cross curves, equilibrium, and criteria of intact stability."""
