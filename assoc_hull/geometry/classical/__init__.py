"""Classical curves and sections, each as its author defined it, errors of print corrected."""
