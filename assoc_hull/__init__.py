"""Associative ship hull forms: lines that follow one another when one is changed."""

__all__ = ["__version__"]

__version__ = "0.1.0"
