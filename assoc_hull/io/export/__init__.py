"""A hull in the forms of other programs, each form written and, where it holds lines, read."""
