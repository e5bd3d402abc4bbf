"""Variation of a parent hull: mappings of space that change little, and what they change."""
