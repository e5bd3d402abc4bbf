"""What the property tests share."""

from collections.abc import Iterator

import pytest

from assoc_hull.geometry.splines.backend import backend, set_backend


@pytest.fixture(params=["numpy", "numba"])
def backend_in_use(request: pytest.FixtureRequest) -> Iterator[str]:
    """The tests that ask for it hold for both kinds of arithmetic."""
    if request.param == "numba":
        pytest.importorskip("numba")
    before = backend()
    set_backend(request.param)
    yield request.param
    set_backend(before)
