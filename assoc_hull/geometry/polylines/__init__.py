"""Features of digitised curves: corners, straight runs, arcs, noise, smoothing."""
