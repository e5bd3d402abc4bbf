"""Resistance in calm water, by Holtrop's regression.

`holtrop_ship` says what it is computed from, `holtrop` holds the formulas, `calm_water_resistance`
what they give, `validity` for what ships they are; `hull_resistance` takes the numbers of a hull.
"""
