"""The update engine: what is evaluated, in what order, and why; it knows no hull word."""
