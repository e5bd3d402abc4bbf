"""A net made from given lines."""
