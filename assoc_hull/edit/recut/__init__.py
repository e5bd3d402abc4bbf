"""Drivers carried by a mapping of space, and followers cut again."""
