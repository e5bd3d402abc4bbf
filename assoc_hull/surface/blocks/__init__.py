"""Blocks of a hull, each the part of it that one smooth surface is fitted to."""
