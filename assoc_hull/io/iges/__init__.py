"""IGES files by our own hands: the file, its curves and surfaces, read and written."""
