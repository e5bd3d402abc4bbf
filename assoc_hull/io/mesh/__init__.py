"""Triangle meshes: read, repaired, put into ship axes, made a shell, and written."""
