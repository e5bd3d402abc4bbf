"""The long forms of tests: more ships, finer steps and more draws, of contracts tested in short.

`make test` leaves them out, `make test-long` runs them.
"""

import os

import pytest

LONG = bool(os.environ.get("ASSOC_HULL_LONG"))
"""Whether the long forms are run."""

long_form = pytest.mark.skipif(not LONG, reason="a long form: make test-long")
"""A test, or a parameter of one, that is run with the long forms only."""
