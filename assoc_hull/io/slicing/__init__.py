"""From meshes, surfaces and digitised lines to a net."""
