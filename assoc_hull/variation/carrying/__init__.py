"""A map carried out on the net of a hull: drivers, followers, rates of all points."""
