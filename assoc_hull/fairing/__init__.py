"""Fairing of whole hulls: what is done, what came of it, and windows for the hand."""
