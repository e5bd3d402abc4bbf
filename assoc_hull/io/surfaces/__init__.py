"""Spline surfaces in files: control nets, JSON, IGES, and the surface of a hull."""
