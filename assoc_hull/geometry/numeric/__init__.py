"""Numerics without geometry: roots, banded systems, quadrature, dual numbers, intervals."""
