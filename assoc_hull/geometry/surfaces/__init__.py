"""Surfaces: Coons cells, curves across them, triangles, panels."""
