"""The named parameters of a hull: measured, laid out as fields, limited."""
