"""Surfaces for and from CAD programs through OpenCASCADE, the extra ``cad``."""
