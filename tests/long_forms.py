"""The long forms of tests: more ships, finer steps and more draws, of contracts tested in short.

`make test` leaves them out, `make test-long` runs them.
"""

import os

import pytest

LONG = bool(os.environ.get("ASSOC_HULL_LONG"))
"""Whether the long forms are run."""

long_form = pytest.mark.skipif(not LONG, reason="a long form: make test-long")
"""A test, or a parameter of one, that is run with the long forms only."""


def draws(count: int) -> int:
    """Give how many random draws a property makes: all of them in the long form, else half."""
    return count if LONG else (count + 1) // 2
