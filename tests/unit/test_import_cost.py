"""Importing the package is cheap: heavy libraries wait until they are needed."""

import subprocess
import sys

import pytest

import assoc_hull

HEAVY = [
    "OCP",
    "dask",
    "distributed",
    "ezdxf",
    "matplotlib",
    "networkx",
    "numba",
    "pandas",
    "pyarrow",
    "scipy.interpolate",
    "scipy.sparse",
    "starlette",
    "threadpoolctl",
    "trimesh",
]


LATE = [
    "edit.adoption",
    "edit.checks.hull_findings",
    "edit.explain.causes",
    "edit.explain.preview",
    "io",
    "plot",
]


def modules_after(statement: str) -> set[str]:
    """The modules that a fresh Python holds after a statement."""
    script = f"{statement}; import sys; print(*sys.modules, sep='\\n')"
    command = [sys.executable, "-c", script]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    return set(run.stdout.split())


@pytest.fixture(scope="module")
def loaded() -> set[str]:
    """The modules that a fresh Python holds after `import assoc_hull`."""
    return modules_after("import assoc_hull; assoc_hull.Hull")


def test_the_package_itself_is_loaded(loaded: set[str]) -> None:
    """The list is that of a Python which did import the package."""
    assert "assoc_hull" in loaded


@pytest.mark.parametrize("library", HEAVY)
def test_importing_the_package_leaves_heavy_libraries_alone(library: str, loaded: set[str]) -> None:
    """Only the command that needs a heavy library pays for it."""
    assert library not in loaded


@pytest.mark.parametrize("module", LATE)
def test_a_hull_loads_what_few_sessions_need_when_they_do(module: str, loaded: set[str]) -> None:
    """Making nets, explaining and previewing wait until they are asked for."""
    assert f"assoc_hull.{module}" not in loaded


def test_a_variation_waits_for_nothing_that_it_does_not_need() -> None:
    """Studies, surfaces, plates and scipy are loaded by who asks for them."""
    ship = "import assoc_hull as ah; ah.examples.wigley().vary(set={'breadth': 11.0})"
    found = modules_after(ship)
    assert "assoc_hull.variation.vary" in found
    late = ("assoc_hull.study.", "assoc_hull.surface.", "assoc_hull.io.tables.")
    assert not [name for name in found if name.startswith(late)]
    assert not [name for name in found if name.startswith("scipy.")]


def test_lofting_loads_geometry_only() -> None:
    """Whoever lofts and cuts curves does not wait for the modules of whole hulls."""
    found = modules_after("from assoc_hull.geometry.splines.loft import loft")
    units = {name.split(".")[1] for name in found if name.startswith("assoc_hull.")}
    packages = {name for name in assoc_hull._PUBLIC if name}  # made at once, empty
    assert units == {"arguments", "errors", "geometry", "tolerance"} | packages
    below = tuple(f"assoc_hull.{name}." for name in packages)
    assert not [name for name in found if name.startswith(below)]


def test_the_examples_stay_what_they_are() -> None:
    """Importing the modules behind them does not bind the name to the subpackage."""
    script = "import assoc_hull.shipped.wigley; print(assoc_hull.examples.wigley.__self__)"
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert "Examples" in run.stdout
