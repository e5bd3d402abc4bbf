"""Plates of single surfaces and plates of a hull: class, roll axis, development."""
