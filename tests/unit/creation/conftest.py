"""Created hulls, made once."""

import pytest

from assoc_hull.hull import Hull
from tests.conftest import Shipped


@pytest.fixture(scope="session")
def plain_ship(shipped: Shipped) -> Hull:
    """The plain ship; nobody edits it."""
    return shipped("plain_ship")
