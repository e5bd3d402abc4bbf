"""Fairing: what looks at a hull or a table of offsets before, while and after it is faired."""
