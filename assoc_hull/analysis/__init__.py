"""What is computed from a hull: hydrostatics, form parameters, stability curves, panels."""
