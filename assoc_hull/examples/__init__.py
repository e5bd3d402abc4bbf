"""Hulls that ship with the package."""
