"""Pictures of surfaces: plates, curvature maps, developments, panels, the whole hull."""
