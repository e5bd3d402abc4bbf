"""Resistance in calm water, by Holtrop's regression.

`holtrop_ship` says what it is computed from, `holtrop` holds the formulas and for what ships they
are, `calm_water_resistance` what they give; `hull_resistance` takes the numbers of a hull.
"""
