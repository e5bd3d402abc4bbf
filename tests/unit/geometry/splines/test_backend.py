"""The choice between numpy and numba."""

import os
import subprocess
import sys

import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.splines.backend import backend, set_backend

LOFT = """
import sys
import numpy as np
from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.splines.loft import loft
loft(CurveData.single(np.array([[0.0, 0, 0], [3, 4, 0]])))
"""


def run(program: str, fast: str) -> subprocess.CompletedProcess[str]:
    """Run a program in a Python of its own, with or without the wish for speed."""
    environment = {**os.environ, "ASSOC_HULL_FAST": fast}
    return subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True
    )


def test_numba_is_not_imported_unless_chosen() -> None:
    """Lofting with numpy leaves numba alone."""
    done = run(LOFT + "assert 'numba' not in sys.modules", "")
    assert done.returncode == 0, done.stderr


def test_the_environment_chooses_numba() -> None:
    """With ASSOC_HULL_FAST=1 the first loft is compiled."""
    pytest.importorskip("numba")
    done = run(LOFT + "assert 'numba' in sys.modules", "1")
    assert done.returncode == 0, done.stderr


def test_a_missing_numba_is_named_with_its_extra() -> None:
    """Without numba the error says what to install."""
    done = run("import sys; sys.modules['numba'] = None" + LOFT, "1")
    assert "MissingExtraError: numba is not installed" in done.stderr
    assert "assoc-hull[fast]" in done.stderr


def test_an_unknown_backend_is_refused() -> None:
    """Only numpy and numba can be chosen; a refusal changes nothing."""
    before = backend()
    with pytest.raises(BadInputError, match="'cupy'"):
        set_backend("cupy")  # type: ignore[arg-type]
    assert backend() == before
