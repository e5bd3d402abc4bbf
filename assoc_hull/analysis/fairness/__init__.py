"""How fair lines are."""
