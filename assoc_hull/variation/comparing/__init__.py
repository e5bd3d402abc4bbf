"""A parent and a variant side by side: lines, numbers, fairness, features."""
