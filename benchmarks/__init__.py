"""Benchmarks: figures side by side in one run; see docs/benchmarks.md and benchmarks/figures.md."""
