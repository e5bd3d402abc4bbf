"""Fields, layers of fields, and the maps that are composed of them; no hull."""
