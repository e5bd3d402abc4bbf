"""Files: the hull file, and reading and writing the formats of others."""
