"""DXF drawings: lines in space, lines plans in three views, and their entities."""
