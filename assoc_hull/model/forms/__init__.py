"""Definitions by form parameters, and the lines whose points they generate."""
