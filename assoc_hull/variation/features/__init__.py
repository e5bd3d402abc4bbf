"""Circles and bilge arcs that are drawn again after a map."""
