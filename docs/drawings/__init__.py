"""The drawings of the documentation, one module per subject."""
