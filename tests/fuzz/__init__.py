"""Changed and malformed inputs: no traceback, no hang, no half-written file."""
