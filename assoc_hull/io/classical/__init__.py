"""Texts of classical definitions: cards, and a reader for each of the three kinds."""
