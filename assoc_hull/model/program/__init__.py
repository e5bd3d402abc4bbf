"""The program of a net: its structure compiled to flat arrays, and runs of numbers through it."""
