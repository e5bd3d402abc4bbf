"""Lines added, shifted and removed: a new line is cut from those that are there."""
