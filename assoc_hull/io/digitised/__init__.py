"""Digitised lines of a hull from text files and drawings."""
