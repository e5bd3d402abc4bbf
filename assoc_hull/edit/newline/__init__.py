"""A line cut from those that are there: added, shifted, removed."""
