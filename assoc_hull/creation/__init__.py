"""Hulls without a parent: made of definitions by form parameters."""
