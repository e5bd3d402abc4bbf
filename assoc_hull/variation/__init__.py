"""Variation of a parent hull: fields, maps, named parameters, features, shifts."""
