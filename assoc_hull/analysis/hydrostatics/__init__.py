"""Hydrostatics of a hull: records, tables, accuracy, areas of sections, draughts from weights."""
