"""The kernel's curve: make, evaluate, intersect planes, closest point, length, curvature, order."""
