"""Direct manipulation: a curve goes through places, its points change least."""
