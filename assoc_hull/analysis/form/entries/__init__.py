"""Entries of the catalogue of form parameters, by subject."""
