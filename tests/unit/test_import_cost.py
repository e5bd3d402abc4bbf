"""Importing the package is cheap: heavy libraries wait until they are needed."""

import subprocess
import sys

import pytest

HEAVY = ["dask", "matplotlib", "networkx", "numba", "scipy.interpolate", "starlette"]


@pytest.fixture(scope="module")
def loaded() -> set[str]:
    """The modules that a fresh Python holds after `import assoc_hull`."""
    script = "import assoc_hull, sys; print(*sys.modules, sep='\\n')"
    command = [sys.executable, "-c", script]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_the_package_itself_is_loaded(loaded: set[str]) -> None:
    """The list is that of a Python which did import the package."""
    assert "assoc_hull" in loaded


@pytest.mark.parametrize("library", HEAVY)
def test_importing_the_package_leaves_heavy_libraries_alone(library: str, loaded: set[str]) -> None:
    """Only the command that needs a heavy library pays for it."""
    assert library not in loaded
