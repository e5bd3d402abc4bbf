"""Many variants of one hull: designs, samples, and what becomes of each."""
