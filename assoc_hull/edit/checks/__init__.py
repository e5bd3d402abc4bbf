"""Findings on a hull: after an update, and of the whole."""
